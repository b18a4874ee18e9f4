// Table 1 and Figure 4 of the source paper. Exact values: closed form of the symmetric motion,
// evaluated to 12 digits independently of this program (docs/theory.md derives it).
#include "planar_orthoglide.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace springfold {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

constexpr double p = 0.454;  // the value that the paper's Table 1 belongs to

StudyResult along_diagonal(double s, const model::SpringLaw& knee) {
  return run_study(planar_orthoglide(knee), diagonal_study(s));
}

struct ExactRow {
  double knee_stiffness;
  double rho_q1, stiffness_q1, rho_q2, stiffness_q2;
};

constexpr ExactRow exact_rows[] = {
    {0.00, 0.437001683500, 2.278707630609, 1.345001683500, 0.240552110109},
    {0.01, 0.433497973681, 2.289375275895, 1.355785384759, 0.271418201815},
    {0.05, 0.419483134407, 2.332045857042, 1.398920189796, 0.394882568639},
    {0.10, 0.401964585313, 2.385384083475, 1.452838696091, 0.549213027168}};

TEST(PlanarOrthoglide, CommandsAndStiffnessAgreeWithTheClosedForm) {
  for (const ExactRow& row : exact_rows) {
    const StudyResult q1 = along_diagonal(-p, linear_knee(row.knee_stiffness));
    const StudyResult q2 = along_diagonal(p, linear_knee(row.knee_stiffness));
    ASSERT_TRUE(complete(q1) && complete(q2)) << row.knee_stiffness;
    for (const char* rho : {"leg_x.drive.rho", "leg_y.drive.rho"}) {
      EXPECT_NEAR(at_start(q1, rho), row.rho_q1, 1e-9);
      EXPECT_NEAR(at_start(q2, rho), row.rho_q2, 1e-9);
    }
    EXPECT_NEAR(at_start(q1, "stiffness"), row.stiffness_q1, 1e-9);
    EXPECT_NEAR(at_start(q2, "stiffness"), row.stiffness_q2, 1e-9);
  }
}

TEST(PlanarOrthoglide, IsIsotropicInTheCentre) {
  for (const ExactRow& row : exact_rows) {
    const StudyResult q0 = along_diagonal(0, linear_knee(row.knee_stiffness));
    ASSERT_TRUE(q0.start.found);
    EXPECT_NEAR(at_start(q0, "leg_x.drive.rho"), 1, 1e-9);
    const Matrix expected = (1 + row.knee_stiffness) * Matrix::Identity(2, 2);
    EXPECT_LT((q0.start.stiffness - expected).norm(), 1e-9);
  }
}

TEST(PlanarOrthoglide, ExchangesItsStiffnessesBetweenTheTwoCorners) {
  const StudyResult q1 = along_diagonal(-p, linear_knee(0)), q2 = along_diagonal(p, linear_knee(0));
  const Vector across = Vector{{1, -1}} / std::numbers::sqrt2;
  EXPECT_NEAR(across.dot(q2.start.stiffness * across), 2.278707630609, 1e-9);
  EXPECT_NEAR(across.dot(q1.start.stiffness * across), 0.240552110109, 1e-9);
}

TEST(PlanarOrthoglide, AgreesWithThePrintedTable) {
  struct Printed {
    double knee_stiffness, rho_q1, stiffness_q1, rho_q2, stiffness_q2;
  };
  // Table 1. rho at Q1 is printed truncated and the stiffness at Q1 0.12 to 0.15 % low.
  constexpr Printed printed[] = {{0.00, 0.437, 2.276, 1.345, 0.24},
                                 {0.01, 0.433, 2.286, 1.356, 0.27},
                                 {0.05, 0.419, 2.329, 1.399, 0.39},
                                 {0.10, 0.402, 2.382, 1.453, 0.55}};
  for (const Printed& row : printed) {
    const StudyResult q1 = along_diagonal(-p, linear_knee(row.knee_stiffness));
    const StudyResult q2 = along_diagonal(p, linear_knee(row.knee_stiffness));
    EXPECT_NEAR(at_start(q1, "leg_x.drive.rho"), row.rho_q1, 0.001);
    EXPECT_NEAR(at_start(q1, "stiffness"), row.stiffness_q1, 0.002 * row.stiffness_q1);
    EXPECT_NEAR(at_start(q2, "leg_x.drive.rho"), row.rho_q2, 0.0005);
    EXPECT_NEAR(at_start(q2, "stiffness"), row.stiffness_q2, 0.005);
  }
}

struct LimitRow {
  double knee_stiffness, s_first, F_first, s_second, F_second;
};

constexpr LimitRow limit_rows[] = {
    {0.00, 0.575217068714, 0.020238288956, 0.831249809177, -0.029523906987},
    {0.01, 0.599576563137, 0.027008033908, 0.807668435885, 0.000837559006}};

TEST(PlanarOrthoglide, BucklesAtTheClosedFormForces) {
  for (const LimitRow& row : limit_rows) {
    const StudyResult q2 = along_diagonal(p, linear_knee(row.knee_stiffness));
    const auto limits = events_of_kind(q2, EventKind::limit_point);
    ASSERT_EQ(limits.size(), 2u) << row.knee_stiffness;
    EXPECT_NEAR(at_event(q2, limits[0], "force"), row.F_first, 1e-11);
    EXPECT_NEAR(at_event(q2, limits[0], "tool.x"), row.s_first, 1e-11);
    EXPECT_NEAR(at_event(q2, limits[1], "force"), row.F_second, 1e-11);
    EXPECT_NEAR(at_event(q2, limits[1], "tool.y"), row.s_second, 1e-11);
  }
}

TEST(PlanarOrthoglide, DoesNotBuckleWithStifferKnees) {
  for (const double knee_stiffness : {0.05, 0.1}) {
    const StudyResult q2 = along_diagonal(p, linear_knee(knee_stiffness));
    ASSERT_TRUE(complete(q2));
    EXPECT_TRUE(events_of_kind(q2, EventKind::limit_point).empty());
    const auto& last = q2.branches.front().samples.back();
    EXPECT_NEAR(last.values[column(q2, "leg_x.knee")], 80 * std::numbers::pi / 180, 1e-10);
  }
}

TEST(PlanarOrthoglide, ChangesItsForceControlledIndexExactlyBetweenTheLimitPoints) {
  const StudyResult q2 = along_diagonal(p, linear_knee(0));
  for (const auto& sample : q2.branches.front().samples) {
    const double s = sample.values[column(q2, "tool.x")];
    if (!sample.event.empty()) continue;
    const bool between = s > limit_rows[0].s_first && s < limit_rows[0].s_second;
    EXPECT_EQ(sample.values[column(q2, "index_force")], between ? 1 : 0) << "s = " << s;
    EXPECT_EQ(sample.values[column(q2, "index_pose")], 0) << "s = " << s;
  }
}

TEST(PlanarOrthoglide, FollowsTheClosedFormCurveAtEveryPoint) {
  for (const double k : {0.0, 0.01, 0.1}) {
    const StudyResult q2 = along_diagonal(p, linear_knee(k));
    const double rho = at_start(q2, "leg_x.drive.rho");
    for (const auto& sample : q2.branches.front().samples) {
      const double s = sample.values[column(q2, "tool.x")], c = std::sqrt(1 - s * s);
      // V(s) = (rho(s) - rho)^2 + k asin(s)^2 over both legs, displacement sqrt(2) s
      const double force =
          std::numbers::sqrt2 * ((s + c - rho) * (1 - s / c) + k * std::asin(s) / c);
      EXPECT_NEAR(sample.values[column(q2, "force")], force, 1e-10 * (1 + std::abs(force)));
      const double energy = std::pow(s + c - rho, 2) + k * std::pow(std::asin(s), 2);
      EXPECT_NEAR(sample.values[column(q2, "energy")], energy, 1e-10 * (1 + energy));
    }
  }
}

TEST(PlanarOrthoglide, WithOneSidedKneesIsStiffAtQ2AndSwitchesBothKneesAtOnce) {
  const StudyResult q2 = along_diagonal(p, one_sided_knee());
  ASSERT_TRUE(complete(q2));
  EXPECT_NEAR(at_start(q2, "leg_x.drive.rho"), 1.584646266767, 1e-9);
  EXPECT_NEAR(at_start(q2, "stiffness"), 1.276373927828, 1e-9);
  const auto switchings = events_of_kind(q2, EventKind::switching);
  ASSERT_EQ(switchings.size(), 1u);
  EXPECT_NEAR(at_event(q2, switchings[0], "leg_x.knee"), std::numbers::pi / 12, 1e-13);
  EXPECT_NEAR(at_event(q2, switchings[0], "leg_y.knee"), std::numbers::pi / 12, 1e-13);
  const std::size_t force = column(q2, "force");
  EXPECT_NE(switchings[0].rates_before[force], switchings[0].rates_after[force]);
}

TEST(PlanarOrthoglide, HasTheSameLimitPointsUnderLoadControl) {
  auto study = diagonal_study(p);
  study.control = analysis::ControlMode::load;
  const StudyResult load = run_study(planar_orthoglide(linear_knee(0)), study);
  ASSERT_TRUE(complete(load));
  const auto limits = events_of_kind(load, EventKind::limit_point);
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_NEAR(at_event(load, limits[0], "lambda"), limit_rows[0].F_first, 1e-11);
  EXPECT_NEAR(at_event(load, limits[1], "lambda"), limit_rows[0].F_second, 1e-11);
  EXPECT_NEAR(at_event(load, limits[1], "tool.x"), limit_rows[0].s_second, 1e-11);
}

TEST(PlanarOrthoglide, HasTheSameForceUnderPoseControl) {
  auto study = diagonal_study(p);
  study.control = analysis::ControlMode::pose;
  const StudyResult pose = run_study(planar_orthoglide(linear_knee(0.01)), study);
  ASSERT_TRUE(complete(pose));
  const auto limits = events_of_kind(pose, EventKind::limit_point);
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_NEAR(at_event(pose, limits[0], "force"), limit_rows[1].F_first, 1e-11);
  EXPECT_NEAR(at_event(pose, limits[1], "force"), limit_rows[1].F_second, 1e-11);
}

TEST(PlanarOrthoglide, DrivenByItsActuatorsMeetsABranchPointInTheFlatSingularity) {
  // On the diagonal dV/ds = 2 (rho(s) - rho) rho'(s): the unloaded branch rho(s) = rho turns back
  // where rho'(s) = 0, rho = sqrt(2), and is crossed there by the branch s = 1/sqrt(2).
  analysis::Study study;
  study.name = "actuators";
  study.control = analysis::ControlMode::actuator;
  study.actuators = {{"leg_x.drive", 1}, {"leg_y.drive", 1}};
  study.until = {{"tool.x", -0.5, 0.9}};
  const StudyResult result = run_study(planar_orthoglide(linear_knee(0)), study);
  const auto crossings = events_of_kind(result, EventKind::branch_point);
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_NEAR(at_event(result, crossings[0], "leg_x.drive.rho"), std::numbers::sqrt2, 1e-10);
  EXPECT_NEAR(at_event(result, crossings[0], "tool.x"), std::numbers::sqrt2 / 2, 1e-9);
  EXPECT_TRUE(events_of_kind(result, EventKind::limit_point).empty());
  EXPECT_TRUE(complete(result));
}

TEST(PlanarOrthoglide, FollowsAParameterOfTheCase) {
  analysis::Study study;
  study.name = "knee stiffness";
  study.control = analysis::ControlMode::parameter;
  study.parameter = "Kv";
  study.start.pose = Vector::Constant(2, p);
  study.until = {{"lambda", 0, 0.1}};
  analysis::ParameterFamily family;
  family.value = 0.05;
  family.at = [](double k) {
    analysis::Situation now{planar_orthoglide(linear_knee(k)), {}};
    for (auto& chain : now.mechanism.chains)
      std::get<model::Joint>(chain.elements[0]).command = 1.398920189796;
    return now;
  };
  const StudyResult result = run_study(family.at(0.05).mechanism, study, &family);
  ASSERT_TRUE(complete(result));
  for (const auto& sample : result.branches.front().samples) {
    const double s = sample.values[column(result, "tool.x")], c = std::sqrt(1 - s * s);
    const double k = sample.values[column(result, "lambda")];
    EXPECT_NEAR((s + c - 1.398920189796) * (1 - s / c) + k * std::asin(s) / c, 0, 1e-10)
        << "k = " << k;
  }
}

TEST(PlanarOrthoglide, ReachesTheSameStartByThePapersIteration) {
  auto study = diagonal_study(p);
  study.start.solver = analysis::StartSolver::fixed_point;
  for (const double k : {0.0, 0.01, 0.1}) {
    const auto mechanism = planar_orthoglide(linear_knee(k));
    const StudyResult newton = run_study(mechanism, diagonal_study(p));
    const StudyResult paper = run_study(mechanism, study);
    ASSERT_TRUE(paper.start.found) << paper.start.message;
    EXPECT_NEAR(at_start(paper, "leg_x.drive.rho"), at_start(newton, "leg_x.drive.rho"), 1e-10);
    ASSERT_EQ(paper.start.chain_iterations.size(), 2u);
    EXPECT_GT(paper.start.chain_iterations[0], 0);
  }
}

/// The same study in other units: positions and forces of all special points in the old ones.
std::vector<double> special_points(const model::SpringLaw& knee, OrthoglideUnits u) {
  std::vector<double> values;
  const StudyResult result = run_study(planar_orthoglide(knee, u), diagonal_study(p, u));
  for (const auto& event : result.branches.front().events) {
    values.push_back(at_event(result, event, "tool.x") / u.length);
    values.push_back(at_event(result, event, "force") / u.force);
    values.push_back(at_event(result, event, "stiffness") / (u.force / u.length));
  }
  return values;
}

TEST(PlanarOrthoglide, HasTheSameSpecialPointsInMillimetres) {
  const OrthoglideUnits mm{1000, 1}, kN{1, 0.001};
  for (const OrthoglideUnits& u : {mm, kN}) {
    for (const bool one_sided : {false, true}) {
      const auto a = special_points(one_sided ? one_sided_knee() : linear_knee(0.01), {});
      const auto b = special_points(one_sided ? one_sided_knee(u) : linear_knee(0.01, u), u);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(a[i], b[i], 1e-9 * std::max(1.0, std::abs(a[i])));
    }
  }
}

TEST(PlanarOrthoglide, HasTheSameDigitsInUnitsThatArePowersOfTwo) {
  const OrthoglideUnits u{0x1p10, 0x1p-7};
  const StudyResult a = run_study(planar_orthoglide(linear_knee(0.01)), diagonal_study(p));
  const StudyResult b = run_study(planar_orthoglide(linear_knee(0.01, u), u), diagonal_study(p, u));
  ASSERT_EQ(a.branches[0].samples.size(), b.branches[0].samples.size());
  const std::pair<const char*, double> factors[] = {{"s", 1},
                                                    {"lambda", u.length},
                                                    {"force", u.force},
                                                    {"stiffness", u.force / u.length},
                                                    {"tool.x", u.length},
                                                    {"leg_x.knee", 1},
                                                    {"leg_y.Fx", u.force},
                                                    {"energy", u.force * u.length}};
  for (std::size_t i = 0; i < a.branches[0].samples.size(); ++i)
    for (const auto& [name, factor] : factors)
      EXPECT_EQ(a.branches[0].samples[i].values[column(a, name)] * factor,
                b.branches[0].samples[i].values[column(b, name)])
          << name << " in row " << i;
}

TEST(PlanarOrthoglide, FindsTheSameSpecialPointsWithOtherStepLengths) {
  const StudyResult reference = along_diagonal(p, linear_knee(0.01));
  for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
    auto study = diagonal_study(p);
    study.trace.initial_step *= factor;
    study.trace.maximum_step *= factor;
    const StudyResult other = run_study(planar_orthoglide(linear_knee(0.01)), study);
    ASSERT_EQ(other.branches[0].events.size(), reference.branches[0].events.size()) << factor;
    for (std::size_t i = 0; i < other.branches[0].events.size(); ++i)
      EXPECT_NEAR(at_event(other, other.branches[0].events[i], "force"),
                  at_event(reference, reference.branches[0].events[i], "force"), 1e-9);
  }
}

}  // namespace
}  // namespace springfold
