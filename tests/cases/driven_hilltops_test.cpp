// Hilltops on curves of limit points of the force, and of branch points, under a driven displacement: they are those
// under the load.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "case_runs.hpp"
#include "small_structures.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

using analysis::Event;
using analysis::EventKind;
using analysis::StudyResult;

/// Two bars to an apex with a spring across.
const std::string swaying_truss = R"toml(
[parameters]
alpha = "72*deg"
h = "tan(alpha)"
[[body]]
name = "apex"
task_space = "xy"
pose = [0, "h"]
[[chain]]
name = "left"
from_at = [-1, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "alpha" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", initial = "1/cos(alpha)", spring = { law = "linear", stiffness = 1, free = "1/cos(alpha)" } },
]
[[chain]]
name = "right"
from_at = [1, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "pi - alpha" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", initial = "1/cos(alpha)", spring = { law = "linear", stiffness = 1, free = "1/cos(alpha)" } },
]
[[chain]]
name = "sway"
elements = [
  { joint = "prismatic", axis = "x", name = "spring", role = "virtual", stiffness = 0.2 },
  { joint = "prismatic", axis = "y", name = "guide", initial = "h" },
]
)toml";

/// A truss whose apex is pushed by a head through a link; the head is held across by what `fixed` says.
std::string truss_under_head(const std::string& fixed) {
  return R"toml(
[parameters]
alpha = "74*deg"
h = "tan(alpha)"
)toml" + supports_and_apex("apex", R"("h")") +
         R"toml([[node]]
name = "head"
at = [0, "h + 4"]
)toml" + fixed +
         R"toml(
[[bar]]
from = "l"
to = "apex"
stiffness = 1
[[bar]]
from = "r"
to = "apex"
stiffness = 1
[[bar]]
from = "apex"
to = "head"
stiffness = 20
[[chain]]
name = "sway"
to = "apex"
elements = [
  { joint = "prismatic", axis = "x", name = "spring", role = "virtual", stiffness = 0.8 },
  { joint = "prismatic", axis = "y", name = "guide", initial = "h" },
]
)toml";
}

/// A strut that gives way along itself, on a hinge that is relaxed at an angle at which branches cross for k = 4 cos^2
/// 0.2.
const std::string crooked_strut =
    "[parameters]\nt0 = \"0.2 - sin(0.4)/2\"\nk = 4\nc = 1\n" +
    strut_that_gives(R"({ law = "linear", stiffness = "c", free = "t0" })", R"("k")");
const double stiffness_of_crossing = 4 * std::pow(std::cos(0.2), 2);

std::string driven_study(const std::string& body, const std::string& control,
                         const std::string& kind, const std::string& more) {
  return "[[study]]\nname = \"s\"\nbody = \"" + body + "\"\ndirection = [0, -1]\ncontrol = \"" +
         control + "\"\nkind = \"" + kind + "\"\n" + more + "\n";
}

std::string followed_point(const std::string& point, const std::string& parameter,
                           const std::string& range) {
  return "critical_curve = { of = \"" + point + "\", parameter = \"" + parameter +
         "\", range = " + range + " }";
}

const std::string within_strut =
    "until = { lambda = [-0.3, 5], strut.along = [-0.98, inf], strut.hinge = [-3.1, 3.1] }\n";
const std::string within_truss = "until = { apex.y = [0.05, \"1.05*h\"] }\n";

/// The only event of a kind.
const Event* only_event_of(const StudyResult& result, EventKind kind) {
  const Event* found = nullptr;
  for (const Event& event : result.branches.at(0).events) {
    if (event.kind != kind) continue;
    if (found != nullptr) return nullptr;
    found = &event;
  }
  return found;
}

TEST(DrivenHilltops, OfATrussLieAtTheForceOfTheClosedForm) {
  // cos(alpha) = 2.1^(-3/2) for a spring across of a fifth of a bar's stiffness, with the apex at the height 1.1^(1/2).
  for (const std::string point : {"LP1", "BP1"}) {
    SCOPED_TRACE(point);
    const auto result =
        run(swaying_truss +
            driven_study("apex", "mixed", "critical_curve",
                         within_truss + followed_point(point, "alpha", "[\"60*deg\", \"80*deg\"]")))
            .of("s");
    const Event* hilltop = only_event_of(result, EventKind::hilltop);
    ASSERT_NE(hilltop, nullptr);
    EXPECT_EQ(hilltop->detail, "hilltop: limit point of the force");
    const double alpha = std::acos(std::pow(2.1, -1.5));
    EXPECT_NEAR(value(result, hilltop->row, "alpha"), alpha, 1e-9);
    EXPECT_NEAR(value(result, hilltop->row, "force"), 2.3073794659743, 1e-9);
    EXPECT_NEAR(value(result, hilltop->row, "lambda"), std::tan(alpha) - std::sqrt(1.1), 1e-9);
    EXPECT_TRUE(result.doubts.empty());
  }
}

TEST(DrivenHilltops, OfAHeldHeadAreThoseUnderTheLoadOfAGuidedOne) {
  const std::string more =
      within_truss + followed_point("LP1", "alpha", "[\"60*deg\", \"80*deg\"]");
  const auto loaded = run(truss_under_head("fixed = [\"x\"]") +
                          driven_study("head", "load", "critical_curve", more))
                          .of("s");
  const Event* truth = only_event_of(loaded, EventKind::hilltop);
  ASSERT_NE(truth, nullptr);
  for (const std::string point : {"LP1", "BP1"}) {
    SCOPED_TRACE(point);
    const auto held =
        run(truss_under_head("") +
            driven_study("head", "pose", "critical_curve",
                         within_truss + followed_point(point, "alpha", "[\"60*deg\", \"80*deg\"]")))
            .of("s");
    const Event* hilltop = only_event_of(held, EventKind::hilltop);
    ASSERT_NE(hilltop, nullptr);
    EXPECT_NEAR(value(held, hilltop->row, "alpha"), value(loaded, truth->row, "alpha"), 1e-9);
    EXPECT_NEAR(value(held, hilltop->row, "force"), value(loaded, truth->row, "force"), 1e-9);
  }
}

TEST(DrivenHilltops, AreToldOnCurvesOfFirstCriticalLoads) {
  const auto result =
      run(swaying_truss +
          driven_study("apex", "mixed", "critical_load",
                       within_truss +
                           "critical_load = { of = \"limit_point\", index = \"dead_load\", "
                           "parameter = \"alpha\", range = [\"66*deg\", \"76*deg\"], values = 5 }"))
          .of("s");
  const Event* hilltop = only_event_of(result, EventKind::hilltop);
  ASSERT_NE(hilltop, nullptr);
  EXPECT_NEAR(value(result, hilltop->row, "alpha"), std::acos(std::pow(2.1, -1.5)), 1e-9);
}

TEST(DrivenLimitPoints, CrossWhereTheirBranchesDoUnderTheLoad) {
  const auto result =
      run(crooked_strut + driven_study("tip", "mixed", "critical_curve",
                                       within_strut + followed_point("LP1", "k", "[3, 4.1]")))
          .of("s");
  const Event* crossing = only_event_of(result, EventKind::crossing);
  ASSERT_NE(crossing, nullptr);
  EXPECT_NEAR(value(result, crossing->row, "k"), stiffness_of_crossing, 1e-9);
  EXPECT_NEAR(value(result, crossing->row, "force"), 2 * std::cos(0.2), 1e-9);
}

TEST(DrivenLimitPoints, AreGoneFromTheirCrossingOn) {
  for (const std::string control : {"load", "mixed"}) {
    SCOPED_TRACE(control);
    const std::string index = control == "load" ? "control" : "dead_load";
    const auto result =
        run(crooked_strut +
            driven_study("tip", control, "threshold",
                         within_strut +
                             "threshold = { of = \"limit_point\", parameter = \"k\", "
                             "range = [3, 4.5], value = \"largest\", index = \"" +
                             index + "\" }"))
            .of("s");
    ASSERT_TRUE(result.threshold && result.threshold->found);
    EXPECT_NEAR(result.threshold->value, stiffness_of_crossing, 1e-9);
    EXPECT_EQ(result.threshold->decides, "crossing of branches");
  }
}

TEST(DrivenLimitPoints, AreLostByTheLeastChangeAtTheirCrossing) {
  for (const std::string control : {"load", "mixed"}) {
    SCOPED_TRACE(control);
    const std::string index = control == "load" ? "control" : "dead_load";
    const auto result =
        run(crooked_strut + driven_study("tip", control, "design",
                                         within_strut +
                                             "[study.design]\nparameters = { k = [3, 6] }\n"
                                             "no_limit_point = { index = \"" +
                                             index + "\" }"))
            .of("s");
    ASSERT_TRUE(result.design);
    EXPECT_EQ(result.design->status, analysis::DesignStatus::met);
    EXPECT_NEAR(result.design->parameters.at(0).after, stiffness_of_crossing, 1e-9);
    EXPECT_EQ(result.design->limits, std::vector<std::string>{"no_limit_point"});
    EXPECT_NE(result.design->message.find("where a requirement jumps"), std::string::npos);
    EXPECT_EQ(result.design->message.find("not shown"), std::string::npos);
  }
}

TEST(DrivenLimitPoints, AreLostByLeastChangesOfTwoParametersAtTheirCrossing) {
  // Branches cross at k/c = r, and (1 + u)/(1 + v) = r/4 with u^2 + v^2 least. By a smooth way there is another design,
  // at a cusp: more than four times as far.
  const auto result =
      run(crooked_strut + driven_study("tip", "load", "design",
                                       within_strut + "[study.design]\n"
                                                      "parameters = { k = [3, 6], c = [0.5, 2] }\n"
                                                      "no_limit_point = {}"))
          .of("s");
  ASSERT_TRUE(result.design);
  const double q = stiffness_of_crossing / 4, change = (1 - q) / std::hypot(1, q);
  EXPECT_EQ(result.design->status, analysis::DesignStatus::met);
  EXPECT_NEAR(result.design->change, change, 1e-7 * change);
  EXPECT_NEAR(result.design->parameters.at(1).after, 1 + q * (1 - q) / (1 + q * q), 1e-6);
  EXPECT_EQ(result.design->message.find("not shown"), std::string::npos);
}

}  // namespace
}  // namespace springfold::io
