// Studies that begin on a special point, and quantities that do not change along a curve.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"
#include "number_text.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using testing::SizeIs;

/// Two bars of stiffness 1 from (-1, 0) and (1, 0) to an apex at height y on the axis: F(y) = 2 y (L0/L - 1) down, with
/// L^2 = 1 + y^2 and L0 = L(h). Its limit points are at L^3 = L0.
struct Truss {
  double h;
  double rest() const { return std::hypot(1, h); }
  double force(double y) const { return 2 * y * (rest() / std::hypot(1, y) - 1); }
  double limit_height() const { return std::sqrt(std::pow(rest(), 2.0 / 3) - 1); }
};

std::string truss_with(const Truss& of, const std::string& rest) {
  return "[[node]]\nname = \"a\"\nat = [0, " + number(of.h) + "]\n" +
         R"([[node]]
name = "l"
at = [-1, 0]
fixed = true
[[node]]
name = "r"
at = [1, 0]
fixed = true
[[bar]]
from = "l"
to = "a"
stiffness = 1
[[bar]]
from = "r"
to = "a"
stiffness = 1
)" + rest;
}

std::string press_under(const std::string& control, const std::string& keys) {
  return "[[study]]\nname = \"press\"\nbody = \"a\"\ncontrol = \"" + control +
         "\"\ndirection = [0, -1]\n" + keys;
}

/// Under the load at which y is in equilibrium, begun there.
std::string begun_at(const Truss& of, double y) {
  return "load = [0, " + number(-of.force(y)) + "]\nstart = { pose = [0, " + number(y) + "] }\n";
}

constexpr const char* heights_of_truss = "until = { a.y = [-1.2, 1.0] }\n";
const Truss shallow{0.8};

/// Limit points of the truss by their height.
void expect_both_limit_points(const analysis::StudyResult& result) {
  const double y = shallow.limit_height();
  std::vector<double> heights;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == EventKind::limit_point) heights.push_back(value(result, event.row, "a.y"));
  ASSERT_THAT(heights, SizeIs(2));
  EXPECT_NEAR(std::max(heights[0], heights[1]), y, 1e-9);
  EXPECT_NEAR(std::min(heights[0], heights[1]), -y, 1e-9);
}

TEST(StartOnALimitPoint, IsALimitPointOfTheCurve) {
  expect_both_limit_points(
      run(truss_with(shallow, press_under("load", heights_of_truss +
                                                      begun_at(shallow, shallow.limit_height()))))
          .of("press"));
}

TEST(StartOnALimitPoint, OfTheForceIsOneOfTheDrivenCurve) {
  expect_both_limit_points(
      run(truss_with(shallow, press_under("mixed", heights_of_truss +
                                                       begun_at(shallow, shallow.limit_height()))))
          .of("press"));
}

TEST(StartOnALimitPoint, OfAnotherStudyIsOneOfThisStudyToo) {
  const std::string first = press_under("load", heights_of_truss);
  std::string then =
      press_under("mixed", heights_of_truss) + "start = { from = \"press\", at = \"LP1\" }\n";
  then.replace(then.find("press"), 5, "then");
  expect_both_limit_points(run(truss_with(shallow, first + then)).of("then"));
}

/// A slide under a spring of torque -u^n + u^(n+1), n even, begun at u = 0: a flat limit point, at which lambda turns
/// at 0; the way snaps from there to u = 1, and back from the other limit point at u = n / (n + 1).
std::string slide_with(const std::string& coefficients) {
  return R"([[body]]
name = "p"
task_space = "xy"
[[chain]]
name = "c"
elements = [{ joint = "prismatic", axis = "x", name = "x", role = "preloaded", spring = { law = "polynomial", falling = true, coefficients = )" +
         coefficients + R"( } }]
[[study]]
name = "press"
kind = "snap_through"
control = "load"
direction = [1, 0]
until = { p.x = [-1, 1.3] }
)";
}

TEST(StartOnAFlatLimitPoint, IsOneOfTheCurveAndJumps) {
  for (const int n : {4, 6}) {
    std::string coefficients = "[0";
    for (int power = 1; power < n; ++power) coefficients += ", 0";
    const auto result = run(slide_with(coefficients + ", -1, 1]")).of("press");
    const double other = -1.0 / n * std::pow(n / (n + 1.0), n + 1);
    EXPECT_THAT(
        lambdas(result, EventKind::limit_point),
        testing::ElementsAre(testing::DoubleNear(0, 1e-12), testing::DoubleNear(other, 1e-10)))
        << n;
    ASSERT_TRUE(result.snap) << n;
    const auto x = static_cast<std::size_t>(column(result, "p.x"));
    const auto from_start =
        std::count_if(result.snap->jumps.begin(), result.snap->jumps.end(), [x](const auto& jump) {
          return std::abs(jump.critical.values[x]) < 1e-9 &&
                 std::abs(jump.landing.values[x] - 1) < 1e-9;
        });
    EXPECT_EQ(from_start, 1) << n;
    EXPECT_THAT(result.snap->jumps, SizeIs(2)) << n;
  }
}

TEST(StartOnAFlatLimitPoint, IsUnresolvedWhereNothingBesideItCanBeTold) {
  const auto result = run(slide_with("[0, 0, 0, 0, 0, 0, 0, 0, -1, 1]")).of("press");
  EXPECT_THAT(lambdas(result, EventKind::unresolved),
              testing::ElementsAre(testing::DoubleNear(0, 1e-12)));
}

TEST(StartOnAnInflection, LosesNoSideOfTheCurve) {
  for (const std::string coefficients :
       {"[0, 0, 0, 1]", "[0, 0, 0, 0, 0, 1]", "[0, 0, 0, 0, 0, 0, 0, 1]"}) {
    const auto result = run(slide_with(coefficients)).of("press");
    ASSERT_THAT(result.branches, SizeIs(1)) << coefficients;
    const auto& branch = result.branches[0];
    EXPECT_NEAR(value(result, 0, "p.x"), -1, 1e-10) << coefficients;
    EXPECT_NEAR(value(result, branch.samples.size() - 1, "p.x"), 1.3, 1e-10) << coefficients;
    EXPECT_THAT(lambdas(result, EventKind::touch), SizeIs(1)) << coefficients;
    EXPECT_TRUE(branch.forward.complete && branch.backward.complete) << coefficients;
  }
}

TEST(StartOnALimitPoint, OfAHighTrussHasNothingUnresolvedBesideIt) {
  const Truss high{3};
  const std::string keys = "until = { a.y = [0.9, 3.1] }\n";
  std::string then = press_under("load", keys + "start = { from = \"press\", at = \"LP1\" }\n");
  then.replace(then.find("press"), 5, "then");
  const auto result = run(truss_with(high, press_under("load", keys) + then)).of("then");
  EXPECT_THAT(lambdas(result, EventKind::limit_point), SizeIs(1));
  EXPECT_THAT(lambdas(result, EventKind::unresolved), testing::IsEmpty());
}

TEST(StartOnABranchPoint, IsWhereTheBranchThroughItLosesStabilityAndJumps) {
  // The tall truss sways where its transverse stiffness vanishes: 1 - L0/L + L0/L^3 = 0.
  const Truss tall{2.5};
  double low = 1.5, high = 2.2;
  for (int i = 0; i < 200; ++i) {
    const double y = 0.5 * (low + high), L = std::hypot(1, y);
    (1 - tall.rest() / L + tall.rest() / (L * L * L) > 0 ? high : low) = y;
  }
  const std::string keys =
      "kind = \"snap_through\"\nuntil = { lambda = [-1, 0.3], a.y = [-4, 3], a.x "
      "= [-2, 2] }\n";
  const auto result =
      run(truss_with(tall, press_under("load", keys + begun_at(tall, low)))).of("press");
  std::vector<std::string> labels;
  for (const auto& event : result.branches.at(0).events) {
    if (event.kind != EventKind::branch_point) continue;
    labels.push_back(event.label);
    const double before = value(result, event.row - 1, "index"),
                 after = value(result, event.row + 1, "index");
    EXPECT_EQ(before + after, 1);
  }
  ASSERT_THAT(labels, SizeIs(1));
  ASSERT_TRUE(result.snap);
  ASSERT_THAT(result.snap->jumps, SizeIs(2));
  const auto height = static_cast<std::size_t>(column(result, "a.y"));
  for (const auto& jump : result.snap->jumps) {
    EXPECT_NEAR(jump.critical.values[height], low, 1e-9);
    // To the mirror side, under the same load.
    EXPECT_LT(jump.landing.values[height], 0);
    EXPECT_NEAR(tall.force(jump.landing.values[height]), tall.force(low), 1e-9);
  }
}

TEST(StartOnACorner, IsACornerOfTheCurve) {
  // A stop of stiffness 1 that acts above y = 0.3, where the force of the truss still rises with falling y.
  const std::string stop = R"([[spring]]
name = "stop"
shape = "line"
of = ["a", { on = "base", at = [0, 0] }, { on = "base", at = [1, 0] }]
law = { law = "one_sided", stiffness = 1, from = 0.3, side = "above" }
)";
  const auto result =
      run(truss_with(shallow,
                     stop + press_under("load", heights_of_truss + begun_at(shallow, 0.3))))
          .of("press");
  int corners = 0;
  for (const auto& event : result.branches.at(0).events) {
    if (event.kind != EventKind::corner_limit_point) continue;
    ++corners;
    EXPECT_NEAR(value(result, event.row, "a.y"), 0.3, 1e-10);
  }
  EXPECT_EQ(corners, 1);
}

TEST(QuantityThatStaysZero, NeitherEndsNorMarksTheCurve) {
  const auto plain = run(truss_with(shallow, press_under("load", heights_of_truss))).of("press");
  for (const std::string& keys : {std::string("until = { a.y = [-1.2, 1.0], a.x = [0, 1] }\n"),
                                  std::string("until = { a.y = [-1.2, 1.0], a.x = [-1, 0] }\n"),
                                  std::string(heights_of_truss) + "extrema = [\"a.x\"]\n"}) {
    const auto result = run(truss_with(shallow, press_under("load", keys))).of("press");
    EXPECT_EQ(result.branches.at(0).samples.size(), plain.branches.at(0).samples.size()) << keys;
    EXPECT_EQ(result.branches.at(0).events.size(), plain.branches.at(0).events.size()) << keys;
  }
}

TEST(QuantityThatStaysZero, IsMarkedAtTheStartAlone) {
  const auto result =
      run(truss_with(shallow,
                     press_under("load", heights_of_truss + std::string("mark = { a.x = [0] }\n"))))
          .of("press");
  int marks = 0;
  for (const auto& event : result.branches.at(0).events)
    marks += event.kind == EventKind::user_value ? 1 : 0;
  EXPECT_EQ(marks, 1);
}

TEST(LoadCycle, BegunOnALimitPointFollowsTheStableSide) {
  const double limit = shallow.force(shallow.limit_height());
  for (const double level : {-0.05, 0.05}) {
    const std::string keys = heights_of_truss +
                             std::string("kind = \"load_cycle\"\ncycle = { levels = [") +
                             number(level) + "] }\n";
    const auto result =
        run(truss_with(shallow,
                       press_under("load", keys + begun_at(shallow, shallow.limit_height()))))
            .of("press");
    ASSERT_TRUE(result.snap && result.snap->cycle) << level;
    const auto& cycle = *result.snap->cycle;
    EXPECT_EQ(cycle.end, analysis::LoadCycle::End::complete) << level;
    EXPECT_EQ(cycle.jumps, level > 0 ? 1 : 0) << level;
    const auto& values = cycle.steps.back().at.values;
    const double y = values[static_cast<std::size_t>(column(result, "a.y"))];
    EXPECT_EQ(values[static_cast<std::size_t>(column(result, "index"))], 0) << level;
    EXPECT_NEAR(shallow.force(y), limit + level, 1e-9) << level;
    EXPECT_EQ(y > shallow.limit_height(), level < 0) << level;
  }
}

/// Begun on the bent branch the straight one is met at its branch points, from which it begins to both sides.
TEST(BranchMetFromAnother, JumpsFromItsBranchPointsAllTheSame) {
  const auto jumps_from_straight = [](const std::string& start) {
    const std::string keys =
        "until = { a.y = [0.3, 3.2], a.x = [-0.7, 0.7] }\nbranches = { depth = "
        "2 }\nsnap = true\nmark = { a.x = [0.3] }\n";
    std::string then = press_under("load", keys + start);
    then.replace(then.find("press"), 5, "then");
    const auto result = run(truss_with(Truss{2.5}, press_under("load", keys) + then)).of("then");
    const auto x = static_cast<std::size_t>(column(result, "a.x"));
    return std::count_if(
        result.snap->jumps.begin(), result.snap->jumps.end(),
        [x](const auto& jump) { return std::abs(jump.critical.values[x]) < 1e-9; });
  };
  EXPECT_GE(jumps_from_straight(""), 2);
  EXPECT_EQ(jumps_from_straight("start = { from = \"press\", at = \"UZ1\" }\n"),
            jumps_from_straight(""));
}

TEST(LoadCycle, UpToTheLimitLoadReleasesNothing) {
  // A level at the limit load, or as little below it as rounding tells, is reached without a jump.
  const double limit = shallow.force(shallow.limit_height());
  for (const double below : {0.0, 1e-12, 1e-9, 1e-6}) {
    const auto result =
        run(truss_with(shallow,
                       press_under("load", heights_of_truss +
                                               std::string("kind = \"load_cycle\"\ncycle = { "
                                                           "levels = [") +
                                               number(limit - below) + ", 0] }\n")))
            .of("press");
    ASSERT_TRUE(result.snap && result.snap->cycle) << below;
    EXPECT_THAT(result.doubts, testing::IsEmpty()) << below;
    EXPECT_EQ(result.snap->cycle->jumps, 0) << below;
    EXPECT_NEAR(result.snap->cycle->gap, 0, 1e-12) << below;
  }
}

TEST(StateAtTheLimitLoad, HasNoIndexThatRoundingDecides) {
  const double y = shallow.limit_height();
  const std::string at = "kind = \"equilibria\"\nuntil = { a.y = [-2, 2] }\nload = [0, " +
                         number(-shallow.force(y)) + "]\n";
  std::string text = press_under("load", at);
  text.erase(text.find("control"), text.find("kind") - text.find("control"));
  const auto result = run(truss_with(shallow, text)).of("press");
  ASSERT_TRUE(result.equilibria);
  int at_limit = 0;
  const auto index = static_cast<std::size_t>(column(result, "index"));
  const auto height = static_cast<std::size_t>(column(result, "a.y"));
  for (const auto& state : result.equilibria->list) {
    const bool is_limit = std::abs(state.sample.values[height] - y) < 1e-6;
    EXPECT_EQ(std::isnan(state.sample.values[index]), is_limit);
    at_limit += is_limit ? 1 : 0;
  }
  EXPECT_EQ(at_limit, 1);
}

/// A bar on a hinge of 1 under a constant load of 1 + d: the branch point lies at lambda = -d, not at the start.
TEST(StartBesideABranchPoint, HasItWhereItIs) {
  for (const double d : {1e-5, 1e-6, 1e-7, -1e-6, -1e-7}) {
    const auto ran =
        run("[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1]\n[[chain]]\nname = "
            "\"mast\"\nelements = [ { joint = \"revolute\", axis = \"z\", name = \"foot\", role = "
            "\"preloaded\", spring = { law = \"linear\", stiffness = 1 } }, { rigid = [0, 1] } ]\n"
            "[[study]]\nname = \"s\"\ncontrol = \"load\"\ndirection = [0, -1]\nload = [0, " +
            number(-1 - d) +
            "]\nuntil = { lambda = [-1, 1], mast.foot = [-1, 1] }\nbranches = { depth = 1 }\n");
    const auto& result = ran.of("s");
    EXPECT_TRUE(complete(result)) << d;
    EXPECT_THAT(result.branches, SizeIs(3)) << d;
    const auto loads = lambdas(result, EventKind::branch_point);
    ASSERT_THAT(loads, SizeIs(1)) << d;
    EXPECT_NEAR(loads[0], -d, 1e-10);
    EXPECT_EQ(
        result.branches[0].samples[result.branches[0].start_row].values[column(result, "index")],
        d > 0 ? 1 : 0);
  }
}

/// A cord that pulls also where its ends meet, but nowhere in particular: whether its point is in balance is not known.
TEST(SpecialStarts, AtACordOfNoLengthAreRefusedWithItsName) {
  const auto result = run(R"([[body]]
name = "p"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "guide"
elements = [
  { joint = "prismatic", axis = "x", name = "x", role = "virtual", stiffness = 1 },
  { joint = "prismatic", axis = "y", name = "y", role = "virtual", stiffness = 1 },
]
[[spring]]
name = "cord"
shape = "path"
of = [{ on = "base", at = [0, 0] }, "p"]
law = { law = "linear", stiffness = 3, free = -1 }
[[study]]
name = "pull"
control = "load"
direction = [1, 0]
until = { lambda = [-1, 1] }
)")
                          .of("pull");
  EXPECT_FALSE(result.start.found);
  EXPECT_THAT(result.start.message, testing::HasSubstr("spring cord has the length 0"));
  EXPECT_TRUE(result.branches.empty());
}

}  // namespace
}  // namespace springfold::io
