// Springs that act on a short stretch only: one step of the curve would span it.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "case_runs.hpp"
#include "cases/number_text.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

constexpr double strut_clearance = 0.5;  // of the struts' feet from the way of what passes them

std::vector<double> values_at_events(const StudyResult& result, EventKind kind,
                                     const std::string& name) {
  std::vector<double> list;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == kind) list.push_back(value(result, event.row, name));
  return list;
}

std::string touching_strut(const std::string& name, const std::string& foot, double stiffness,
                           double longer) {
  return "[[bar]]\nname = \"" + name + "\"\nfrom = \"base\"\nfrom_at = " + foot +
         "\nto = \"n\"\nstiffness = " + number(stiffness) +
         "\nfree = " + number(strut_clearance + longer) + "\ncompression_only = true\n";
}

/// A node that is pushed along y between two struts, longer than their strut_clearance by little, and held across (z)
/// by a spring of stiffness 1.
std::string node_between_struts(double stiffness, double longer) {
  return R"([[body]]
name = "n"
task_space = "xyz"
pose = [0, -0.7, 0]
[[chain]]
name = "g"
elements = [
  { joint = "prismatic", axis = "y", name = "y", initial = -0.7, role = "preloaded", spring = { law = "linear", stiffness = 1000, free = -0.7 } },
  { joint = "prismatic", axis = "z", name = "z", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
]
)" + touching_strut("s1", "[" + number(strut_clearance) + ", 0, 0]", stiffness, longer) +
         touching_strut("s2", "[" + number(-strut_clearance) + ", 0, 0]", stiffness, longer) +
         R"([[study]]
name = "push"
control = "mixed"
direction = [0, 1, 0]
until = { g.y = [-1, 1] }
)";
}

TEST(ShortContact, BranchPointsBetweenItsEndsAreFound) {
  // The stiffness across is 1 + 2 k (L - free)/L: zero where L = free/(1 + 1/(2 k)).
  for (const double longer : {1e-5, 1e-6, 1e-8})
    for (const double excess : {1.2, 5.0, 100.0}) {
      SCOPED_TRACE(number(longer) + ", " + number(excess));
      const double stiffness = excess * strut_clearance / (2 * longer), part = 1 / (2 * stiffness);
      const StudyResult result = run(node_between_struts(stiffness, longer)).of("push");
      const double above =
          (longer - strut_clearance * part) / (1 + part);  // L less the strut_clearance
      const double y = std::sqrt(above * (2 * strut_clearance + above));
      const auto places = values_at_events(result, EventKind::branch_point, "g.y");
      ASSERT_EQ(places.size(), 2u);
      EXPECT_NEAR(places[0], -y, 1e-9);
      EXPECT_NEAR(places[1], y, 1e-9);
    }
}

/// A slider that is pushed past a strut; a spring of stiffness 1 holds it at -0.7.
std::string slider_past_strut(double stiffness, double longer, const std::string& study) {
  return R"([[node]]
name = "n"
at = [-0.7, 0]
fixed = ["y"]
)" + touching_strut("s", "[0, " + number(-strut_clearance) + "]", stiffness, longer) +
         R"([[spring]]
name = "k"
shape = "line"
of = ["n", { on = "base", at = [-0.7, 1] }, { on = "base", at = [-0.7, -1] }]
stiffness = 1
[[study]]
name = "push"
control = "mixed"
direction = [1, 0]
)" + study;
}

struct Slider {
  double stiffness = 0, longer = 0;
  double push(double x) const {
    const double L = std::hypot(x, strut_clearance);
    return stiffness * std::min(0.0, L - strut_clearance - longer);
  }
  double force(double x) const { return x + 0.7 + push(x) * x / std::hypot(x, strut_clearance); }
};

double bisected(const std::function<double(double)>& f, double a, double b) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (a + b);
    ((f(middle) < 0) == (f(a) < 0) ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

TEST(ShortContact, LimitsOfTheForceAndMarksWithinItAreFound) {
  const Slider slider{25e6, 1e-6};
  const StudyResult result =
      run(slider_past_strut(
              slider.stiffness, slider.longer,
              "until = { n.x = [-1, 1] }\nmark = { force = [0.71], s.force = [-20] }\n"))
          .of("push");
  EXPECT_TRUE(complete(result));
  const auto rate_of_force = [&slider](double x) {
    return slider.force(x + 1e-7) - slider.force(x - 1e-7);
  };
  const double upper_turn = bisected(rate_of_force, -0.0009, -0.0002),
               lower_turn = bisected(rate_of_force, 0.0002, 0.0009);
  const auto turns = values_at_events(result, EventKind::limit_point, "n.x");
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_NEAR(turns[0], upper_turn, 1e-8);
  EXPECT_NEAR(turns[1], lower_turn, 1e-8);
  const auto less_mark = [&slider](double x) { return slider.force(x) - 0.71; };
  const auto more_push = [&slider](double x) { return slider.push(x) + 20; };
  const std::vector<double> expected{
      bisected(less_mark, -0.001, upper_turn), bisected(more_push, -0.001, 0),
      bisected(less_mark, upper_turn, lower_turn), bisected(more_push, 0, 0.001), 0.01};
  const auto marks = values_at_events(result, EventKind::user_value, "n.x");
  ASSERT_EQ(marks.size(), expected.size());
  for (std::size_t i = 0; i < marks.size(); ++i) EXPECT_NEAR(marks[i], expected[i], 1e-9) << i;
}

TEST(ShortContact, ALimitThatIsPassedWithinItEndsTheBranch) {
  const Slider slider{25e6, 1e-6};
  const StudyResult result =
      run(slider_past_strut(slider.stiffness, slider.longer,
                            "until = { n.x = [-1, 1], force = [-1, 0.715] }\n"))
          .of("push");
  const auto ends = values_at_events(result, EventKind::end_of_range, "n.x");
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_NEAR(ends[1],
              bisected([&slider](double x) { return slider.force(x) - 0.715; }, -0.001, -0.0006),
              1e-9);
}

/// Half span 1, height 0.5, bars of stiffness 1; a stop below the apex.
std::string truss_with_stop(double stiffness, double from) {
  return R"([[node]]
name = "n"
at = [0, 0.5]
fixed = ["x"]
[[bar]]
name = "l"
from = "base"
from_at = [-1, 0]
to = "n"
stiffness = 1
[[bar]]
name = "r"
from = "base"
from_at = [1, 0]
to = "n"
stiffness = 1
[[spring]]
name = "s"
shape = "line"
of = ["n", { on = "base", at = [-1, 0] }, { on = "base", at = [1, 0] }]
law = { law = "one_sided", side = "below", stiffness = )" +
         number(stiffness) + ", from = " + number(from) + R"( }
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { n.y = [-0.8, 0.65] }
snap = true
branches = { depth = 1 }
)";
}

std::vector<std::string> jumps_in_words(const StudyResult& result) {
  std::vector<std::string> list;
  for (const auto& jump : result.snap->jumps)
    list.push_back(jump.from + (jump.loading > 0 ? " rising " : " falling ") + jump.towards);
  return list;
}

/// Height of the truss at its first limit point: L^3 = L0 with L0 = sqrt(1 + 1/4).
double height_at_limit() {
  const double L0 = std::sqrt(1.25), L = std::cbrt(L0);
  return std::sqrt(L * L - 1);
}

TEST(StopBehindALimitPoint, BringsNoJumpWhereItLeavesTheTrussUnstable) {
  for (const double behind : {1e-5, 1e-3, 1e-2}) {
    const StudyResult result =
        run(truss_with_stop(1e-4 * behind, height_at_limit() - behind)).of("press");
    EXPECT_THAT(jumps_in_words(result), testing::ElementsAre("LP1 rising -n.y", "LP2 falling +n.y"))
        << behind;
  }
}

TEST(StopBehindALimitPoint, IsLeftUpwardsWhereItMakesTheTrussStable) {
  // Stiffer than the truss is unstable there: a stable stretch from the corner to LP2.
  for (const double behind : {1e-3, 1e-2}) {
    const StudyResult result =
        run(truss_with_stop(4.5 * behind, height_at_limit() - behind)).of("press");
    EXPECT_THAT(jumps_in_words(result), testing::ElementsAre("LP1 rising -n.y", "CL1 falling +n.y",
                                                             "LP2 rising -n.y", "LP3 falling +n.y"))
        << behind;
  }
}

TEST(StopBehindALimitPoint, HoldsBehindABarrierNearerThanAPush) {
  // The stretch from the corner to LP2 is 2e-4 long.
  const StudyResult result =
      run(truss_with_stop(0.0018551716410433326, height_at_limit() - 1e-3)).of("press");
  EXPECT_THAT(jumps_in_words(result), testing::ElementsAre("LP1 rising -n.y", "CL1 falling +n.y",
                                                           "LP2 rising -n.y", "LP3 falling +n.y"));
}

}  // namespace
}  // namespace springfold::io
