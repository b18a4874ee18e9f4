// Critical curves that begin at a row of another one.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::Event;
using analysis::EventKind;
using analysis::StudyResult;

const std::string pushed_orthoglide = std::string{"include = \"" SPRINGFOLD_SOURCE_DIR
                                                  "/cases/orthoglide-planar/mechanism.toml\"\n"} +
                                      R"([parameters]
L = 1
K = 1
Kv = 0.01
p = 0.454
)";

const std::string over_stiffness = R"([[study]]
name = "c1"
kind = "critical_curve"
control = "load"
direction = [1, 1]
start = { pose = ["p", "p"], solve = "actuators" }
until = { deflection = ["-0.05*L", "0.5*L"] }
mark = { Kv = [0.02] }
critical_curve = { of = "LP1", parameter = "Kv", range = [0, 0.06] }
)";

const std::string over_pose = R"([[study]]
name = "c2"
kind = "critical_curve"
until = { deflection = ["-0.05*L", "0.5*L"] }
mark = { p = [0.4] }
critical_curve = { of = "c1/UZ1", parameter = "p", range = [0.3, 0.5] }
)";

double value_in(const StudyResult& result, const analysis::Sample& row, const std::string& name) {
  const auto& all = result.quantities;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& q) { return q.name == name; });
  return found == all.end() ? std::nan("")
                            : row.values[static_cast<std::size_t>(found - all.begin())];
}

const Event& labelled(const StudyResult& result, const std::string& label) {
  for (const Event& event : result.branches.at(0).events)
    if (event.label == label) return event;
  throw std::out_of_range(label);
}

double value_at_label(const StudyResult& result, const std::string& label,
                      const std::string& name) {
  return value_in(result, result.branches.at(0).samples[labelled(result, label).row], name);
}

long count_of(const StudyResult& result, EventKind kind) {
  const auto& events = result.branches.at(0).events;
  return std::count_if(events.begin(), events.end(),
                       [kind](const Event& event) { return event.kind == kind; });
}

/// Along the diagonal, commands being those that balance (p, p): the force, and its rate by the tool's x, at x = q.
struct PushOnDiagonal {
  double L = 1, K = 1, Kv = 0.01, p = 0.454;
  double drive(double q) const {
    const auto reach = [this](double x) { return x + std::sqrt(L * L - x * x); };
    const double at = std::asin(p / L);
    return reach(q) - reach(p) - Kv * at / (K * L * std::cos(at) * (1 - std::tan(at)));
  }
  double force(double q) const {
    const double a = std::asin(q / L);
    return std::sqrt(2.0) * (K * drive(q) * (1 - std::tan(a)) + Kv * a / (L * std::cos(a)));
  }
  double slope(double q) const {
    const double a = std::asin(q / L), c = std::cos(a), t = std::tan(a);
    return K * ((1 - t) * (1 - t) - drive(q) / (L * c * c * c)) +
           Kv / (L * L) * (1 / (c * c) + a * t / (c * c));
  }
};

void expect_limit_points(const StudyResult& result) {
  ASSERT_TRUE(result.start.found) << result.start.message;
  EXPECT_TRUE(complete(result));
  ASSERT_GT(result.branches.at(0).samples.size(), 10U);
  for (const analysis::Sample& row : result.branches[0].samples) {
    PushOnDiagonal push;
    for (const auto& [name, number] : {std::pair{"L", &push.L}, {"Kv", &push.Kv}, {"p", &push.p}})
      if (const double now = value_in(result, row, name); std::isfinite(now)) *number = now;
    const double q = value_in(result, row, "tool.x");
    EXPECT_NEAR(push.force(q), value_in(result, row, "lambda"), 1e-12);
    EXPECT_NEAR(push.slope(q), 0, 1e-9);
  }
}

TEST(FurtherCurves, AreTheLimitPointsOfTheClosedFormInAChainOfThree) {
  const Ran ran = run(pushed_orthoglide + R"([[study]]
name = "c3"
kind = "critical_curve"
until = { deflection = ["-0.05*L", "0.5*L"] }
critical_curve = { of = "c2/UZ1", parameter = "L", range = [0.5, 2] }
)" + over_pose + over_stiffness);
  for (const char* name : {"c1", "c2", "c3"}) expect_limit_points(ran.of(name));
  for (const analysis::Sample& row : ran.of("c3").branches.at(0).samples) {
    EXPECT_EQ(value_in(ran.of("c3"), row, "p"), 0.4);
    EXPECT_EQ(value_in(ran.of("c3"), row, "Kv"), 0.02);
  }
  EXPECT_EQ(ran.of("c3").start.method, "at UZ1 of study \"c2\"");
}

TEST(FurtherCurves, AreThoseOfTheCaseThatHasTheHeldValue) {
  const Ran ran = run(pushed_orthoglide + over_stiffness + over_pose + R"([[study]]
name = "by hand"
kind = "critical_curve"
control = "load"
direction = [1, 1]
set = { Kv = 0.02 }
start = { pose = ["p", "p"], solve = "actuators" }
until = { deflection = ["-0.05*L", "0.5*L"] }
mark = { p = [0.4] }
critical_curve = { of = "LP1", parameter = "p", range = [0.3, 0.5] }
)");
  const StudyResult &ours = ran.of("c2"), &other = ran.of("by hand");
  ASSERT_EQ(ours.branches.at(0).events.size(), other.branches.at(0).events.size());
  for (const Event& event : other.branches[0].events)
    for (const char* name : {"p", "lambda", "tool.x", "leg_x.drive.rho", "energy"})
      EXPECT_NEAR(value_at_label(ours, event.label, name), value_at_label(other, event.label, name),
                  1e-12)
          << event.label << " " << name;
}

TEST(FurtherCurves, BeginAtADegeneracyThatIsTheSameForEveryParameter) {
  const Ran ran = run(pushed_orthoglide + over_stiffness + R"([[study]]
name = "cusp"
kind = "critical_curve"
until = { deflection = ["-0.05*L", "0.5*L"] }
critical_curve = { of = "c1/CP1", parameter = "p", range = [0.3, 0.5] }
)");
  const StudyResult& result = ran.of("cusp");
  expect_limit_points(result);
  EXPECT_EQ(count_of(result, EventKind::cusp), 1);
  EXPECT_EQ(labelled(result, "CP1").row, result.branches.at(0).start_row);
  EXPECT_NEAR(value_at_label(result, "CP1", "p"), 0.454, 1e-15);
  for (const analysis::Sample& row : result.branches[0].samples)
    EXPECT_LE(value_in(result, row, "p"), 0.454 + 1e-12);
}

TEST(FurtherCurves, GoBackAlongTheFirstOneInItsOwnParameter) {
  const Ran ran = run(pushed_orthoglide + over_stiffness + R"([[study]]
name = "again"
kind = "critical_curve"
until = { deflection = ["-0.05*L", "0.5*L"] }
critical_curve = { of = "c1/UZ2", parameter = "Kv", range = [0, 0.06] }
)");
  const StudyResult &first = ran.of("c1"), &again = ran.of("again");
  EXPECT_EQ(first.quantities.size(), again.quantities.size());
  // Behind its turn the parameter grows the other way.
  for (const auto& [label, same] : {std::pair{"EP1", "EP2"}, {"CP1", "CP1"}, {"EP2", "EP1"}})
    for (const char* name : {"Kv", "lambda", "tool.x"})
      EXPECT_NEAR(value_at_label(first, label, name), value_at_label(again, same, name), 1e-11);
}

TEST(FurtherCurves, OfOneRunEachBelongTogether) {
  std::string first = over_stiffness;
  first.insert(first.find("mark"), "vary = { parameter = \"p\", values = [0.45, 0.4] }\n");
  const Ran ran = run(pushed_orthoglide + first + over_pose);
  std::vector<double> begun;
  for (const StudyResult& result : ran.results) {
    if (result.study != "c2") continue;
    const analysis::Branch& branch = result.branches.at(0);
    begun.push_back(value_in(result, branch.samples[branch.start_row], "p"));
    expect_limit_points(result);
  }
  EXPECT_THAT(begun, testing::ElementsAre(0.45, 0.4));
}

TEST(FurtherCurves, HaveTheLoadStepsOfTheFirstOne) {
  const std::string step = R"([[study]]
name = "pre"
kind = "equilibrium"
load = [0.001, 0.001]
start = { pose = ["p", "p"], solve = "actuators" }
)";
  std::string first = over_stiffness, by_hand = over_stiffness;
  const std::string own = "start = { pose = [\"p\", \"p\"], solve = \"actuators\" }";
  first.replace(first.find(own), own.size(), "start = { from = \"pre\", at = \"start\" }");
  by_hand = first;
  by_hand.replace(by_hand.find("c1"), 2, "by hand");
  by_hand.replace(by_hand.find("mark = { Kv = [0.02] }"), 22, "mark = { p = [0.4] }");
  by_hand.replace(by_hand.find("\"Kv\", range = [0, 0.06]"), 23, "\"p\", range = [0.3, 0.5]");
  const Ran ran = run(pushed_orthoglide + step + first + over_pose);
  std::string with = pushed_orthoglide;
  with.replace(with.find("Kv = 0.01"), 9, "Kv = 0.02");
  const Ran other = run(with + step + by_hand);
  for (const char* label : {"EP1", "UZ1", "CP1", "EP2"})
    for (const char* name : {"p", "lambda", "tool.x"})
      EXPECT_NEAR(value_at_label(ran.of("c2"), label, name),
                  value_at_label(other.of("by hand"), label, name), 1e-11)
          << label;
}

/// All forces grow with the stiffnesses of springs, where commands stay: twice the stiffness is half of the other one.
TEST(FurtherCurves, KeepTheCommandsOfTheFirstOneThatKeepsThem) {
  const Ran ran = run(pushed_orthoglide + R"([[study]]
name = "c1"
kind = "critical_curve"
control = "load"
direction = [1, 1]
start = { pose = ["p", "p"], solve = "actuators" }
until = { deflection = ["-0.15*L", "0.6*L"] }
mark = { Kv = [0.012, "0.012/1.1"] }
critical_curve = { of = "LP1", parameter = "Kv", range = [0, 0.06], tied = false }
[[study]]
name = "c2"
kind = "critical_curve"
until = { deflection = ["-0.15*L", "0.6*L"] }
mark = { K = [1.1] }
critical_curve = { of = "c1/UZ2", parameter = "K", range = [0.9, 1.1] }
)");
  ASSERT_NEAR(value_at_label(ran.of("c1"), "UZ2", "Kv"), 0.012, 1e-12);
  const StudyResult& result = ran.of("c2");
  EXPECT_NEAR(value_at_label(result, "EP2", "lambda"),
              1.1 * value_at_label(ran.of("c1"), "UZ1", "lambda"), 1e-11);
  for (const analysis::Sample& row : result.branches.at(0).samples)
    EXPECT_NEAR(value_in(result, row, "leg_x.drive.rho"),
                value_at_label(ran.of("c1"), "UZ2", "leg_x.drive.rho"), 1e-14);
}

TEST(FurtherCurves, FollowExtremaOfTheForceAndMarkedValues) {
  std::string text = pushed_orthoglide + over_stiffness + over_pose;
  const auto put = [&text](const std::string& old, const std::string& with) {
    for (std::size_t at = text.find(old); at != std::string::npos;
         at = text.find(old, at + with.size()))
      text.replace(at, old.size(), with);
  };
  put("\"load\"", "\"mixed\"");
  put("deflection =", "lambda =");
  const Ran extrema = run(text);
  expect_limit_points(run(pushed_orthoglide + over_stiffness + over_pose).of("c2"));
  for (const analysis::Sample& row : extrema.of("c2").branches.at(0).samples) {
    const PushOnDiagonal push{.Kv = 0.02, .p = value_in(extrema.of("c2"), row, "p")};
    EXPECT_NEAR(push.slope(value_in(extrema.of("c2"), row, "tool.x")), 0, 1e-9);
  }
  put("\"mixed\"", "\"pose\"");
  put("\"LP1\"", "\"UZ1\"");
  put("mark = { Kv = [0.02] }", "mark = { force = [0.015], Kv = [0.02] }");
  const Ran marked = run(text);
  ASSERT_TRUE(marked.of("c2").start.found) << marked.of("c2").start.message;
  for (const analysis::Sample& row : marked.of("c2").branches.at(0).samples) {
    const PushOnDiagonal push{.Kv = 0.02, .p = value_in(marked.of("c2"), row, "p")};
    EXPECT_NEAR(push.force(value_in(marked.of("c2"), row, "tool.x")), 0.015, 1e-12);
  }
}

std::string library_case(const std::string& name) {
  std::ifstream file{SPRINGFOLD_SOURCE_DIR "/cases/critical-curves/" + name};
  std::string text, line;
  while (std::getline(file, line))
    if (!line.starts_with("expected")) text += line + "\n";
  return text;
}

TEST(FurtherCurves, OfTheCornerOfAToggleLoseItsReversalAtTheStiffnessOfTheClosedForm) {
  std::string text = library_case("case-stop.toml");
  text.insert(text.rfind("critical_curve ="), "mark = { gap = [0.6] }\n");
  const StudyResult result = run(text + R"([[study]]
name = "in ks"
kind = "critical_curve"
critical_curve = { of = "corner/UZ1", parameter = "ks", range = [0.1, 3] }
)")
                                 .of("in ks");
  // lambda = 4 k L (cos a - cos alpha) tan a; L sin a falls by the gap. A stop as stiff as it falls makes lambda rise.
  const double a = std::asin(std::sqrt(0.5) - 0.6), c = std::cos(a);
  const double by_angle = 4 * (-std::sin(a) * std::tan(a) + (c - std::sqrt(0.5)) / (c * c));
  ASSERT_EQ(count_of(result, EventKind::corner_loses_reversal), 1);
  EXPECT_NEAR(value_at_label(result, "CR1", "ks"), by_angle / c, 1e-9);
  for (const analysis::Sample& row : result.branches.at(0).samples)
    EXPECT_NEAR(value_in(result, row, "lambda"), 4 * (c - std::sqrt(0.5)) * std::tan(a), 1e-10);
}

const std::string strut_curves = R"([[study]]
name = "in c"
kind = "critical_curve"
until = { strut.hinge = [-3.1, 3.1], strut.along = ["-0.98*L", inf] }
mark = { c = [0.9] }
critical_curve = { of = "branch points/UZ1", parameter = "c", range = [0.5, 2] }
[[study]]
name = "broken"
kind = "critical_curve"
until = { strut.hinge = [-3.1, 3.1] }
mark = { t0 = [0.1] }
critical_curve = { of = "in c/UZ1", parameter = "t0", range = [-0.3, 0.3] }
[[study]]
name = "kept again"
kind = "critical_curve"
until = { strut.hinge = [-3.1, 3.1], strut.along = ["-0.98*L", inf] }
mark = { k = [5] }
critical_curve = { of = "broken/BP1", parameter = "k", range = [4.2, 6] }
[[study]]
name = "limit points in k"
kind = "critical_curve"
until = { strut.hinge = [-3.1, 3.1], strut.along = ["-0.98*L", inf] }
critical_curve = { of = "broken/UZ1", parameter = "k", range = [3, 6] }
[[study]]
name = "crossing"
kind = "critical_curve"
until = { strut.hinge = [-3.1, 3.1], strut.along = ["-0.98*L", inf] }
critical_curve = { of = "limit points/CX1", parameter = "t", range = [0, 0.3] }
)";

TEST(FurtherCurves, OfBranchPointsKeepTheBranchOrBreakItAsTheSecondParameterDoes) {
  const Ran ran = run(library_case("case-strut.toml") + strut_curves);
  const StudyResult& kept = ran.of("in c");
  EXPECT_EQ(kept.branches.at(0).forward.complete, true);
  // The compressed strut is L - lambda/k long: it buckles at c = lambda (L - lambda/k), k = 4.5, twice below c = k/4.
  for (const analysis::Sample& row : kept.branches[0].samples) {
    const double lambda = value_in(kept, row, "lambda");
    EXPECT_NEAR(value_in(kept, row, "c"), lambda * (1 - lambda / 4.5), 1e-11);
  }
  EXPECT_NEAR(value_at_label(kept, "BB1", "c"), 4.5 / 4, 1e-9);
  EXPECT_EQ(count_of(ran.of("broken"), EventKind::branch_point), 1);
  EXPECT_NEAR(value_at_label(ran.of("broken"), "BP1", "lambda"),
              2.25 * (1 + std::sqrt(1 - 3.6 / 4.5)), 1e-9);
  EXPECT_NEAR(value_at_label(ran.of("kept again"), "UZ1", "lambda"),
              2.5 * (1 + std::sqrt(1 - 3.6 / 5)), 1e-9);
}

/// Moments of the strut: c (a - t0) = lambda h sin a with h = L - lambda cos a / k; at a limit point its rate
/// by a is zero.
TEST(FurtherCurves, OfImperfectVersionsAreTheirLimitPoints) {
  const StudyResult result =
      run(library_case("case-strut.toml") + strut_curves).of("limit points in k");
  ASSERT_TRUE(result.start.found) << result.start.message;
  for (const analysis::Sample& row : result.branches.at(0).samples) {
    const double a = value_in(result, row, "strut.hinge"), k = value_in(result, row, "k");
    const double lambda = value_in(result, row, "lambda"), h = 1 - lambda * std::cos(a) / k;
    EXPECT_NEAR(0.9 * (a - 0.1), lambda * h * std::sin(a), 1e-10);
    EXPECT_NEAR(0.9, lambda * (h * std::cos(a) + lambda * std::sin(a) * std::sin(a) / k), 1e-9);
  }
}

TEST(FurtherCurves, BeginAtACrossingWhereTheParameterTurnsBackForBoth) {
  const StudyResult result = run(library_case("case-strut.toml") + strut_curves).of("crossing");
  const analysis::Branch& branch = result.branches.at(0);
  EXPECT_EQ(labelled(result, "CX1").row, branch.start_row);
  EXPECT_GT(value_in(result, branch.samples[branch.start_row - 1], "t"), 0.2);
  EXPECT_GT(value_in(result, branch.samples[branch.start_row + 1], "t"), 0.2);
}

TEST(FurtherCurves, SayWhyTheyDoNotBegin) {
  const auto why = [](const std::string& of, const std::string& range) {
    std::string second = over_pose;
    second.replace(second.find("c1/UZ1"), 6, of);
    second.replace(second.find("[0.3, 0.5]"), 10, range);
    const StudyResult result = run(pushed_orthoglide + over_stiffness + second).of("c2");
    EXPECT_FALSE(result.start.found);
    return result.start.where + ": " + result.start.message;
  };
  EXPECT_EQ(why("c1/UZ3", "[0.3, 0.5]"),
            "critical_curve.of: study \"c1\" has no UZ3; its special points: EP1, UZ1, CP1, UZ2, "
            "EP2");
  EXPECT_EQ(why("c1/UZ1", "[0.3, 0.4]"),
            "critical_curve.range: the value of \"p\" at UZ1 of study \"c1\" is 0.454, "
            "outside the range (0.3 to 0.4): the curve begins there");
}

}  // namespace
}  // namespace springfold::io
