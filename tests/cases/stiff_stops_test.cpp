// Stops that are orders of magnitude stiffer than what moves before them: a mast on a foot whose law is broken, against
//     P = M(q) / sin q,   M(q) the torque of the foot, zero at the crooked mast's own angle.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

struct BrokenFoot {
  double crooked = 0;
  std::vector<double> at{}, stiffness{};  ///< breakpoints, and one stiffness more
  /// Force at a breakpoint.
  double force(std::size_t number) const {
    double torque = 0, from = crooked;
    for (std::size_t i = 0; i <= number; from = at[i++]) torque += stiffness[i] * (at[i] - from);
    return torque / std::sin(at[number]);
  }
};

std::string list_of_numbers(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "[" : ", ") + number(v);
  return text + "]";
}

StudyResult pressed_foot(const BrokenFoot& foot) {
  const std::string f = number(foot.crooked);
  return run("[parameters]\nf = " + f +
             "\n[[body]]\nname = \"n\"\ntask_space = \"xy\"\npose = [\"-sin(f)\", \"cos(f)\"]\n"
             "[[chain]]\nname = \"mast\"\nto = \"n\"\nelements = [{ joint = \"revolute\", axis = "
             "\"z\", name = \"foot\", role = \"preloaded\", initial = \"f\", spring = { law = "
             "\"piecewise_linear\", breakpoints = " +
             list_of_numbers(foot.at) + ", stiffnesses = " + list_of_numbers(foot.stiffness) +
             ", free = \"f\" } }, { rigid = [0, 1] }]\n[[study]]\nname = \"press\"\nbody = \"n\"\n"
             "control = \"load\"\ndirection = [0, -1]\nstart = { pose = [\"-sin(f)\", \"cos(f)\"] "
             "}\n"
             "until = { \"mast.foot\" = [\"0.9*f\", 2.5] }\n")
      .of("press");
}

std::vector<EventKind> kinds_at_breakpoints(const StudyResult& result) {
  std::vector<EventKind> kinds;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == EventKind::switching || event.kind == EventKind::corner_limit_point)
      kinds.push_back(event.kind);
  return kinds;
}

TEST(StiffStops, CriticalForcesAtTheirCornersAreExact) {
  const BrokenFoot feet[] = {{0.0212, {0.0217, 0.0225, 0.0273}, {0.296, 9.34e5, 3.15e-6, 162}},
                             {0.00332, {0.0034, 0.00347, 0.203}, {0.016, 1.66e4, 0.0551, 0.00617}},
                             {0.0422, {0.04224, 0.043, 0.0447}, {0.0179, 1.05e5, 59.7, 6.13e-6}}};
  for (const BrokenFoot& foot : feet) {
    const StudyResult result = pressed_foot(foot);
    EXPECT_TRUE(complete(result));
    const auto corners = lambdas(result, EventKind::corner_limit_point);
    ASSERT_EQ(corners.size(), 1u);
    // The angle itself is a number of 2e-2 with a rounding of 3e-18, and the torque rises by a million for one.
    EXPECT_NEAR(corners[0], foot.force(1), 1e-10 * foot.force(1));
  }
}

TEST(StiffStops, BeforeThemASoftSpringTurnsTheForceAtItsCorners) {
  // Behind the soft pieces the force rises a billion times as steeply: in its unit they look level.
  const BrokenFoot foot{
      0.000392, {0.962295, 0.963139, 0.963846}, {0.000403, 1.99e-5, 12.8, 1.69e5}};
  const StudyResult result = pressed_foot(foot);
  EXPECT_TRUE(complete(result));
  EXPECT_THAT(kinds_at_breakpoints(result),
              testing::ElementsAre(EventKind::corner_limit_point, EventKind::corner_limit_point,
                                   EventKind::switching));
}

TEST(StiffStops, BesideAFootThatIsAHundredMillionTimesStifferCablesAtRestHaveTheirOwnLoads) {
  // To each side the mast falls at the foot's stiffness and half of that of the cable across.
  for (const double foot : {1e5, 1e6, 1e8}) {
    SCOPED_TRACE(foot);
    std::string text =
        "[[body]]\nname = \"n\"\ntask_space = \"planar\"\npose = [0, 1, 0]\n[[chain]]\nname = "
        "\"mast\"\nto = \"n\"\nelements = [{ joint = \"revolute\", axis = \"z\", role = "
        "\"preloaded\", spring = { law = \"linear\", stiffness = " +
        number(foot) + " } }, { rigid = [0, 1] }]\n";
    for (const double side : {-1.0, 1.0})
      text +=
          "[[spring]]\nname = \"" + std::string(side < 0 ? "left" : "right") + "\"\nfrom_at = [" +
          number(side) +
          ", 0]\nto = \"n\"\nlaw = { law = \"one_sided\", stiffness = " + number(side < 0 ? 1 : 2) +
          ", from = " + number(std::sqrt(2.0)) + " }\n";
    const StudyResult result =
        run(text +
            "[[study]]\nname = \"press\"\nbody = \"n\"\ncontrol = \"load\"\ndirection = [0, "
            "-1, 0]\nuntil = { lambda = [0, " +
            number(1.5 * foot) + "] }\nbranches = { depth = 1 }\n")
            .of("press");
    const auto loads = lambdas(result, EventKind::branching_kink);
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_NEAR(loads[0], foot + 0.5, 1e-14 * foot);
    EXPECT_NEAR(loads[1], foot + 1, 1e-14 * foot);
  }
}

/// A strut of length 1 on a hinge of 1/2 between two level stops that just touch its top.
std::string strut_between_stops(double stop, const std::string& direction, double most) {
  std::string text =
      "[[body]]\nname = \"t\"\ntask_space = \"xy\"\npose = [0, 1]\n[[chain]]\nname = \"s\"\n"
      "elements = [{ joint = \"revolute\", axis = \"z\", name = \"q\", role = \"preloaded\", "
      "spring "
      "= { law = \"linear\", stiffness = 0.5 } }, { rigid = [0, 1] }]\n";
  for (const char* at : {"-0.5", "0.5"})
    text += std::string("[[spring]]\nname = \"s") + (at[0] == '-' ? "l" : "r") + "\"\nfrom_at = [" +
            at + ", 1]\nto = \"t\"\nlaw = { law = \"one_sided\", stiffness = " + number(stop) +
            ", from = 0.5, side = \"below\" }\n";
  return text + "[[study]]\nname = \"p\"\ncontrol = \"load\"\ndirection = " + direction +
         "\nbranches = { depth = 1 }\nuntil = { lambda = [-0.5, " + number(most) +
         "], s.q = [-1, 1] }\n";
}

TEST(StiffStops, ThatJustTouchLetAStrutBuckleToBothSides) {
  // Leaning by q presses one of them by sin q, to second order: P = 1/2 + K at q = 0.
  for (const double stop : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    SCOPED_TRACE(stop);
    const StudyResult result = run(strut_between_stops(stop, "[0, -1]", 2 * stop)).of("p");
    EXPECT_TRUE(complete(result));
    EXPECT_EQ(result.branches.size(), 3u);
    const auto loads = lambdas(result, EventKind::branching_kink);
    ASSERT_EQ(loads.size(), 1u);
    EXPECT_NEAR(loads[0], stop + 0.5, 1e-10 * stop);
  }
}

TEST(StiffStops, ThatJustTouchSwitchWhereALoadFromTheSideBegins) {
  for (const double stop : {1e3, 1e6, 1e7, 1e8, 1e9}) {
    SCOPED_TRACE(stop);
    const StudyResult result = run(strut_between_stops(stop, "[1, 0]", 0.1 * stop)).of("p");
    EXPECT_TRUE(complete(result));
    EXPECT_EQ(lambdas(result, EventKind::switching), std::vector<double>{0});
  }
}

}  // namespace
}  // namespace springfold::io
