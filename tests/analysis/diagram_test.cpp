// Whole bifurcation diagrams of mechanisms: branches, junctions, searches.
#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "analysis/steep_truss.hpp"
#include "cases/planar_orthoglide.hpp"

namespace springfold {
namespace {

using analysis::Branch;
using analysis::EventKind;
using analysis::StudyResult;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

using std::numbers::pi;

std::vector<std::string> labels_on(const Branch& branch) {
  std::vector<std::string> labels;
  for (const auto& event : branch.events) labels.push_back(event.label);
  return labels;
}

TEST(Diagram, OfASteepTrussHasTheLoopThatLeavesItAndTheFourBranchesToTheFeet) {
  const SteepTruss truss;
  const StudyResult result = run_study(truss.mechanism(), truss.study(1));
  EXPECT_TRUE(complete(result));
  ASSERT_THAT(result.branches, SizeIs(6));
  EXPECT_THAT(labels_on(result.branches[0]),
              ElementsAre("EP1", "BP1", "LP1", "BP2", "BP3", "LP2", "BP4", "EP2"));
  EXPECT_THAT(labels_on(result.branches[1]), ElementsAre("BP1", "BP4", "BP1"));
  EXPECT_THAT(result.branches[1].forward.reason, HasSubstr("closed"));
  for (std::size_t b = 1; b < 6; ++b) {
    EXPECT_EQ(result.branches[b].depth, 1);
    EXPECT_EQ(result.branches[b].origin_branch, 1);
  }
  const Branch& sway = result.branches[1];
  const double reach = std::abs(value(result, sway, sway.samples.size() / 4, "apex.x"));
  EXPECT_GT(reach, 0.5);
}

TEST(Diagram, HasItsBranchPointsWhereTheClosedFormHasThem) {
  const SteepTruss truss;
  const StudyResult result = run_study(truss.mechanism(), truss.study(1));
  std::vector<double> heights;
  for (const auto& event : result.branches.front().events)
    if (event.kind == EventKind::branch_point) {
      const double y = at_event(result, event, "apex.y");
      heights.push_back(y);
      EXPECT_NEAR(at_event(result, event, "lambda"), truss.load(y), 1e-11);
    }
  const double first = truss.sway_height(0), second = truss.sway_height(1);
  ASSERT_THAT(heights, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(heights[i], (std::array{first, second, -second, -first}[i]), 1e-10);
}

TEST(Diagram, ListsAtEachJunctionWhichBranchRunsAlongEachWay) {
  const SteepTruss truss;
  const StudyResult result = run_study(truss.mechanism(), truss.study(1));
  ASSERT_THAT(result.junctions, SizeIs(4));
  EXPECT_THAT(result.junctions[0].ways, testing::UnorderedElementsAre(1, 1, 2, 2));
  EXPECT_EQ(result.junctions[0].branch, 1);
  EXPECT_EQ(result.junctions[0].label, "BP1");
}

TEST(Diagram, HasOneLabelForEverySpecialPoint) {
  const SteepTruss truss;
  const StudyResult result = run_study(truss.mechanism(), truss.study(1));
  std::map<std::string, std::pair<double, double>> places;
  for (const Branch& branch : result.branches)
    for (const auto& event : branch.events) {
      const std::pair here{value(result, branch, event.row, "apex.x"),
                           value(result, branch, event.row, "lambda")};
      const auto [at, is_new] = places.try_emplace(event.label, here);
      EXPECT_NEAR(at->second.first, here.first, 1e-9) << event.label;
      EXPECT_NEAR(at->second.second, here.second, 1e-9) << event.label;
    }
  EXPECT_THAT(places, SizeIs(12));  // 4 BP, 2 LP, 6 EP
}

TEST(Diagram, OfDepthZeroIsTheBranchOfTheStartAlone) {
  const SteepTruss truss;
  const StudyResult result = run_study(truss.mechanism(), truss.study(0));
  EXPECT_TRUE(complete(result));
  ASSERT_THAT(result.branches, SizeIs(1));
  EXPECT_THAT(events_of_kind(result, EventKind::branch_point), SizeIs(4));
}

TEST(Diagram, CountsWaysBeyondItsBoundsAndIsCompleteAllTheSame) {
  const SteepTruss truss;
  analysis::Study study = truss.study(4);
  study.branches.maximum = 2;
  const StudyResult result = run_study(truss.mechanism(), study);
  EXPECT_TRUE(complete(result));
  EXPECT_THAT(result.branches, SizeIs(2));
  EXPECT_EQ(ways_not_followed(result), 4);  // two at BP2, two at BP3
}

TEST(Diagram, HasNoLimitPointOfTheForceBesideABranchPointAtWhichItTurns) {
  // Driven down, the sway branch passes BP4 at its tip: displacement and force both turn there.
  const SteepTruss truss;
  analysis::Study study = truss.study(1);
  study.control = analysis::ControlMode::mixed;
  const StudyResult result = run_study(truss.mechanism(), study);
  ASSERT_GT(result.branches.size(), 1u);
  EXPECT_THAT(labels_on(result.branches[1]), ElementsAre("BP1", "BP4", "BP1"));
  EXPECT_THAT(result.branches[1].events[1].detail, HasSubstr("the force turns back"));
  for (const auto& sample : result.branches[1].samples) {
    const double x = sample.values[column(result, "apex.x")];
    const double y = sample.values[column(result, "apex.y")];
    const double left = std::hypot(x + truss.a, y), right = std::hypot(x - truss.a, y);
    if (std::abs(x) < 1e-12) continue;
    EXPECT_NEAR(x * (2 - 1 / left - 1 / right) + truss.a * (1 / right - 1 / left), 0, 1e-10);
  }
}

TEST(Diagram, EndsABranchWhereTheRangeEnds) {
  const SteepTruss truss;
  analysis::Study study = truss.study(1);
  study.until.push_back({"apex.x", -0.2, 0.3});
  const StudyResult result = run_study(truss.mechanism(), study);
  EXPECT_TRUE(complete(result));
  const std::size_t x = column(result, "apex.x");
  for (const Branch& branch : result.branches)
    for (const auto& sample : branch.samples) {
      EXPECT_GE(sample.values[x], -0.2 - 1e-12);
      EXPECT_LE(sample.values[x], 0.3 + 1e-12);
    }
}

TEST(Diagram, OnWhoseLimitTheStartLiesEndsThere) {
  const SteepTruss truss;
  analysis::Study study = truss.study(1);
  study.until.push_back({"lambda", 0, 1});
  const StudyResult result = run_study(truss.mechanism(), study);
  EXPECT_TRUE(complete(result));
  const std::size_t lambda = column(result, "lambda");
  for (const auto& sample : result.branches[0].samples) EXPECT_GE(sample.values[lambda], -1e-12);
  EXPECT_EQ(result.branches[0].start_row, 0u);
}

TEST(Diagram, TellsAKinematicSingularityFromABranchPoint) {
  // A bar that has shrunk to nothing may point anywhere: the apex is at its foot.
  const SteepTruss truss;
  analysis::Study study = truss.study(1);
  study.until = {{"apex.y", -1.2 * truss.height(), 1.2 * truss.height()}, {"lambda", -2, 2}};
  const StudyResult result = run_study(truss.mechanism(), study);
  int singular = 0;
  for (const Branch& branch : result.branches)
    for (const auto& event : branch.events) {
      if (event.kind != EventKind::kinematic_singularity) continue;
      ++singular;
      EXPECT_NEAR(std::abs(value(result, branch, event.row, "apex.x")), truss.a, 1e-10);
      EXPECT_NEAR(value(result, branch, event.row, "apex.y"), 0, 1e-10);
      EXPECT_THAT(event.detail, HasSubstr("loses rank"));
    }
  EXPECT_EQ(singular, 4);
  EXPECT_THAT(events_of_kind(result, EventKind::branch_point), SizeIs(4 + 3 + 4));
}

/// N bars from a ring of radius R to a point on the axis, free length 1.
model::Mechanism dome(int bars, double R, double stiffness = 1) {
  using namespace model;
  const double h = std::sqrt(1 - R * R);
  Mechanism m;
  m.bodies.push_back({"apex", TaskSpace::xyz, Vector{{0.0, 0.0, h}}});
  for (int i = 0; i < bars; ++i) {
    const double angle = 2 * pi * i / bars;
    Chain chain;
    chain.name = "bar" + std::to_string(i + 1);
    chain.from_attachment.p = {R * std::cos(angle), R * std::sin(angle), 0};
    chain.from_attachment.R = rotation_about<double>(Vec3<double>::UnitZ(), angle + pi);
    chain.elements.push_back(Joint{.name = "turn", .axis = Vec3<double>::UnitZ()});
    chain.elements.push_back(
        Joint{.name = "tilt", .axis = -Vec3<double>::UnitY(), .initial = std::atan2(h, R)});
    chain.elements.push_back(Joint{.name = "length",
                                   .kind = JointKind::prismatic,
                                   .axis = Vec3<double>::UnitX(),
                                   .role = JointRole::compliant,
                                   .spring = LinearSpring{stiffness, 0}});
    chain.elements.push_back(RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX()}});
    m.chains.push_back(std::move(chain));
  }
  return m;
}

TEST(Diagram, SaysInTheUnitsOfTheCaseWhereItHasDoubts) {
  // Where a bar stands upright its turn is undetermined; which curves leave such a point is not known.
  const double R = 0.4, h = std::sqrt(1 - R * R);
  analysis::Study study;
  study.name = "press";
  study.direction = Vector{{0.0, 0.0, -1.0}};
  study.until = {{"apex.z", -1.1 * h, 1.1 * h}};
  study.branches.depth = 1;
  const StudyResult result = run_study(dome(3, R, 1000), study);
  EXPECT_FALSE(complete(result));
  double upright = 0;
  for (const auto& event : events_of_kind(result, EventKind::kinematic_singularity))
    if (event.label == "KS1")
      upright = std::abs(value(result, result.branches[1], event.row, "lambda"));
  ASSERT_THAT(result.doubts, testing::Not(testing::IsEmpty()));
  for (const std::string& doubt : result.doubts) {
    const std::string words = "at lambda = ";
    ASSERT_THAT(doubt, HasSubstr(words));
    EXPECT_NEAR(std::abs(std::stod(doubt.substr(doubt.find(words) + words.size()))), upright,
                0.01 * upright);
  }
}

/// Three links of length 1; the hinge at the foot is twice as stiff when it turns to the left.
TEST(Diagram, OfAColumnOnAOneSidedHingeHasAHalfBranchForEveryModeOfEachSide) {
  using namespace model;
  Mechanism m;
  m.bodies.push_back({"tip", TaskSpace::xy, Vector{{3.0, 0.0}}});
  Chain column_;
  column_.name = "column";
  for (const char* name : {"a", "b", "c"}) {
    column_.elements.push_back(
        Joint{.name = name, .role = JointRole::preloaded, .spring = LinearSpring{1, 0}});
    column_.elements.push_back(RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX()}});
  }
  std::get<Joint>(column_.elements[0]).spring =
      PiecewiseLinearSpring{.breakpoints = {0}, .stiffnesses = {1, 2}};
  m.chains.push_back(column_);
  analysis::Study study;
  study.name = "press";
  study.direction = Vector{{-1.0, 0.0}};
  study.until = {{"lambda", -0.2, 4}, {"column.a", -1, 1}};
  study.branches.depth = 1;
  const StudyResult result = run_study(m, study);
  EXPECT_TRUE(complete(result));
  ASSERT_THAT(result.branches, SizeIs(7));
  const auto soft = [](int j) { return 4 * std::pow(std::sin((2 * j - 1) * pi / 14), 2); };
  const std::vector<double> loads{soft(1), 2 - std::sqrt(3), soft(2), 2, soft(3), 2 + std::sqrt(3)};
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Branch& branch = result.branches[i + 1];
    EXPECT_EQ(branch.origin, "KB" + std::to_string(i + 1));
    EXPECT_NEAR(value(result, branch, 0, "lambda"), loads[i], 1e-10);
    // The first, third and fifth bend to the soft side of the hinge.
    const double foot = value(result, branch, branch.samples.size() - 1, "column.a");
    EXPECT_EQ(foot < 0, i % 2 == 0) << branch.origin;
  }
}

TEST(Diagram, OfATripodHasThreeCurvesThroughEachDoublePoint) {
  const double R = 0.4, h = std::sqrt(1 - R * R);
  analysis::Study study;
  study.name = "press";
  study.direction = Vector{{0.0, 0.0, -1.0}};
  study.until = {{"apex.x", -0.1, 0.1}, {"apex.y", -0.1, 0.1}, {"apex.z", -1.1 * h, 1.1 * h}};
  study.branches.depth = 1;
  const StudyResult result = run_study(dome(3, R), study);
  EXPECT_TRUE(complete(result));
  ASSERT_THAT(result.junctions, SizeIs(2));
  EXPECT_EQ(result.junctions[0].multiplicity, 2);
  EXPECT_THAT(result.branches, SizeIs(1 + 2 * 6));
  std::set<long> directions;  // in degrees
  for (const Branch& branch : result.branches) {
    if (branch.origin != "BP1") continue;
    const std::size_t end = branch.samples.size() - 1;
    const double angle =
        std::atan2(value(result, branch, end, "apex.y"), value(result, branch, end, "apex.x"));
    directions.insert(std::lround(angle * 1800 / pi) % 3600);
  }
  std::set<long> expected{-1200, -600, 0, 600, 1200, 1800};
  if (directions.contains(-1800)) expected.erase(1800), expected.insert(-1800);
  EXPECT_EQ(directions, expected);
  const auto points = events_of_kind(result, EventKind::branch_point);
  const double z = at_event(result, points[0], "apex.z"), L = std::hypot(R, z);
  EXPECT_NEAR(L * L * L - L * L + R * R / 2, 0, 1e-10);
}

/// Pressed slightly aside: nothing is symmetric, and the loop comes loose from the start's branch.
analysis::Study aside(const SteepTruss& truss) {
  analysis::Study study = truss.study(2);
  study.direction = Vector{{0.02, -1.0}} / std::hypot(0.02, 1.0);
  return study;
}

TEST(Search, FindsTheBranchesThatAreNotConnectedAndTracesThem) {
  const SteepTruss truss;
  const StudyResult alone = run_study(truss.mechanism(), aside(truss));
  analysis::Study study = aside(truss);
  study.branches.search_at = {0};
  const StudyResult result = run_study(truss.mechanism(), study);
  EXPECT_TRUE(complete(result));
  ASSERT_THAT(result.searches, SizeIs(1));
  EXPECT_GE(result.searches[0].found, 1);
  EXPECT_EQ(result.searches[0].traced, result.searches[0].found);
  EXPECT_GT(result.branches.size(), alone.branches.size());
  // Unloaded, the apex stands above or below the feet, in between, or beside them at distance 1.
  std::set<std::pair<long, long>> unloaded;
  for (const Branch& branch : result.branches)
    for (std::size_t row = 0; row + 1 < branch.samples.size(); ++row) {
      const double p = value(result, branch, row, "lambda");
      const double q = value(result, branch, row + 1, "lambda");
      if (p * q > 0 || p == q) continue;
      const double t = p / (p - q);
      const auto at = [&](const char* name) {
        return std::lround(10 * ((1 - t) * value(result, branch, row, name) +
                                 t * value(result, branch, row + 1, name)));
      };
      unloaded.insert({at("apex.x"), at("apex.y")});
    }
  for (const auto& place : {std::pair{0L, 10L}, {0L, -10L}, {0L, 0L}, {10L, 0L}, {-10L, 0L}})
    EXPECT_THAT(unloaded, Contains(place));
}

TEST(Search, FindsNothingWhereEveryBranchIsKnown) {
  const SteepTruss truss;
  analysis::Study study = truss.study(1);
  study.branches.search_at = {0.1};
  const StudyResult result = run_study(truss.mechanism(), study);
  ASSERT_THAT(result.searches, SizeIs(1));
  EXPECT_EQ(result.searches[0].found, 0);
  EXPECT_THAT(result.branches, SizeIs(6));
}

TEST(BranchSettings, ThatCannotBeUsedAreSaid) {
  const SteepTruss truss;
  analysis::Study study = truss.study(1);
  study.path = analysis::Path::davidenko;
  study.branches.search_at = {3};
  study.until.push_back({"lambda", -1, 1});
  EXPECT_THAT(
      problems_in(study, truss.mechanism()),
      ElementsAre(HasSubstr("finds no branch points"), HasSubstr("outside the limits of lambda")));
}

}  // namespace
}  // namespace springfold
