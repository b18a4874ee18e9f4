// Soft members beside stiff ones: a start that bears nothing is as regular as its softest member.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// A mast on a hinge, pressed from above.
std::string soft_mast(const std::string& foot, const std::string& rest, const std::string& top,
                      const std::string& load, const std::string& lambda) {
  return "[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, " + top +
         "]\n[[chain]]\nname = \"mast\"\nelements = [ { joint = \"revolute\", axis = \"z\", name = "
         "\"foot\", role = \"preloaded\", spring = { " +
         foot + " } }, " + rest +
         " ]\n[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\n" + load +
         "until = { lambda = " + lambda + ", mast.foot = [-1.2, 1.3] }\nbranches = { depth = 1 }\n";
}

/// One branch point on the first branch, index 0 before and 1 behind, and where it lies.
double buckling_load(const StudyResult& result) {
  const auto& branch = result.branches.at(0);
  double load = std::nan("");
  int count = 0;
  for (const auto& event : branch.events) {
    if (event.kind != EventKind::branch_point) continue;
    load = value(result, event.row, "lambda");
    EXPECT_EQ(value(result, event.row, "index"), 0);
    ++count;
  }
  EXPECT_EQ(count, 1);
  EXPECT_EQ(result.branches.size(), 3u);
  return load;
}

TEST(SoftMembers, BuckleBesideStopsThatAreNotReachedHoweverStiffTheseAre) {
  for (const char* stop : {"1e5", "1e6", "1e9", "1e12", "1e20"}) {
    const StudyResult result =
        run(soft_mast(std::string{"law = \"stops\", stiffness = 1, stop_stiffness = "} + stop +
                          ", low = -0.5, high = 1.4",
                      "{ rigid = [0, 1] }", "1", "", "[-1, 1.01]"))
            .of("press");
    EXPECT_TRUE(complete(result)) << stop;
    EXPECT_NEAR(buckling_load(result), 1, 1e-10) << stop;
  }
}

/// A clamped-free beam of one segment that turns by theta at its foot: lambda (1/k + L/(3 E I)) = 1 at first order,
/// less what the load does to the beam and its length: 1e-2 of that.
TEST(SoftMembers, BuckleUnderBeamsHoweverStiffTheseAre) {
  for (const double bending : {1e4, 1e6, 1e8}) {
    const std::string beam =
        "{ rigid = { rotate = { axis = \"z\", angle = \"90*deg\" } } }, { elastic = \"beam\", "
        "length = 1, E = 1, A = " +
        std::to_string(1e3 * bending) + ", Iz = " + std::to_string(bending) + ", segments = 1 }";
    const StudyResult result =
        run(soft_mast("law = \"linear\", stiffness = 1", beam, "1", "", "[-1, 2.5]")).of("press");
    EXPECT_TRUE(complete(result)) << bending;
    const double load = buckling_load(result);
    EXPECT_NEAR(1 - load, 1 / (3 * bending), 1e-2 / (3 * bending)) << bending;
  }
}

TEST(SoftMembers, BuckleUnderAConstantLoadBesideStiffStops) {
  const StudyResult result =
      run(soft_mast("law = \"stops\", stiffness = 1, stop_stiffness = 1e7, low = -0.5, high = 1.4",
                    "{ rigid = [0, 1] }", "1", "load = [0, -0.99]\n", "[-1, 0.02]"))
          .of("press");
  EXPECT_TRUE(complete(result));
  EXPECT_NEAR(buckling_load(result), 0.01, 1e-10);
}

/// A hinge of 1 under two stiff slides in a row: theta = -0.1412337 where the load (0.1, -0.3) is balanced, theta =
/// -(0.1 cos theta
/// - 0.3 sin theta), whatever their stiffness is.
TEST(SoftMembers, AreDeflectedHoweverStiffTheOthersAre) {
  double theta = -0.1;
  for (int i = 0; i < 100; ++i) theta = -(0.1 * std::cos(theta) - 0.3 * std::sin(theta));
  for (const char* stiffness : {"1e5", "1e8", "1e12"}) {
    const auto slide = [&](const std::string& name) {
      return "{ joint = \"prismatic\", axis = \"y\", name = \"" + name +
             "\", role = \"virtual\", stiffness = " + stiffness + " }, ";
    };
    const auto ran =
        run("[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1]\n[[chain]]\nname = "
            "\"mast\"\nelements = [ { joint = \"revolute\", axis = \"z\", name = \"foot\", role = "
            "\"preloaded\", spring = { law = \"linear\", stiffness = 1 } }, " +
            slide("a") + slide("b") +
            "{ rigid = [0, 1] } ]\n[[study]]\nname = \"e\"\nkind = \"equilibrium\"\nload = [0.1, "
            "-0.3]\n");
    const StudyResult& result = ran.of("e");
    EXPECT_TRUE(complete(result)) << stiffness;
    ASSERT_EQ(result.branches.size(), 1u) << stiffness;
    EXPECT_NEAR(value(result, 0, "top.x"), -std::sin(theta), 2e-10 + 2 / std::stod(stiffness))
        << stiffness;
  }
}

/// Two links of length 1, one on the other, pressed from above: stiffness 1 at the foot, s between them. Branch points
/// lie at the eigenvalues of [[1 + s, -s], [-s, s]].
std::string two_links(const std::string& s, const std::string& lambda, int depth = 0,
                      const std::string& foot = "1") {
  const auto link = [](const std::string& name, const std::string& stiffness) {
    return "{ joint = \"revolute\", axis = \"z\", name = \"" + name +
           "\", role = \"preloaded\", spring = { law = \"linear\", stiffness = " + stiffness +
           " } }, { rigid = [0, 1] }, ";
  };
  return "[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 2]\n[[chain]]\nname = \"a\"\n"
         "elements = [ " +
         link("q1", foot) + link("q2", s) +
         "]\n[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\nuntil = { "
         "lambda = " +
         lambda +
         ", top.x = [-1, 1], a.q2 = [-2, 2] }\nbranches = { depth = " + std::to_string(depth) +
         " }\n";
}

TEST(SoftMembers, OfAPerfectColumnAreResolvedWithinLimitsOfTheirOrder) {
  const double s = 1e-9, first = (1 + 2 * s - std::sqrt(1 + 4 * s * s)) / 2;
  const StudyResult result = run(two_links("1e-9", "[-1e-9, 1e-8]")).of("press");
  EXPECT_TRUE(complete(result));
  const auto loads = lambdas(result, EventKind::branch_point);
  ASSERT_EQ(loads.size(), 1u);
  EXPECT_NEAR(loads[0] / first, 1, 1e-6);
}

/// The smaller eigenvalue without cancellation: their product is s.
void expect_both_loads(const StudyResult& result, double s, double second, const char* text) {
  EXPECT_TRUE(complete(result)) << text;
  const auto loads = lambdas(result, EventKind::branch_point);
  ASSERT_EQ(loads.size(), 2u) << text;
  EXPECT_NEAR(loads[0] / (s / second), 1, 1e-10) << text;
  EXPECT_NEAR(loads[1] / second, 1, 1e-10) << text;
  EXPECT_EQ(result.branches.size(), 5u) << text;
}

TEST(SoftMembers, OfAPerfectColumnAreResolvedHoweverLongTheRangeIs) {
  for (const char* text : {"1e-5", "1e-7", "1e-9", "1e-12", "1e-15"}) {
    const double s = std::stod(text), second = (1 + 2 * s + std::sqrt(1 + 4 * s * s)) / 2;
    const StudyResult result = run(two_links(text, "[-0.1, 2]", 1)).of("press");
    expect_both_loads(result, s, second, text);
  }
}

/// The path of an imperfect column bends beside the first critical load of the perfect one, and stays stable.
TEST(SoftMembers, OfANearlyPerfectColumnBendItBesideItsFirstCriticalLoad) {
  for (const char* askew : {"1e-8", "1e-5"}) {
    std::string text = two_links("1e-9", "[-0.1, 2]");
    const std::string down = "direction = [0, -1]";
    text.replace(text.find(down), down.size(), std::string("direction = [") + askew + ", -1]");
    const StudyResult result = run(text).of("press");
    EXPECT_TRUE(complete(result)) << askew;
    EXPECT_TRUE(lambdas(result, EventKind::branch_point).empty()) << askew;
    EXPECT_TRUE(lambdas(result, EventKind::limit_point).empty()) << askew;
    const std::size_t rows = result.branches.at(0).samples.size();
    EXPECT_LT(value(result, 0, "lambda"), -0.09) << askew;
    EXPECT_LT(value(result, rows - 1, "lambda"), 1e-6) << askew;
    for (std::size_t i = 0; i < rows; ++i) ASSERT_EQ(value(result, i, "index"), 0) << askew;
  }
}

/// lambda^2 - (f + 2 s) lambda + f s = 0 with the stiffness f at the foot.
TEST(SoftMembers, OfAPerfectColumnMoveItsCriticalLoadsAsTheClosedFormSays) {
  for (const char* text : {"1e-4", "1e-8", "1e-11"}) {
    const double s = std::stod(text), second = (1 + 2 * s + std::sqrt(1 + 4 * s * s)) / 2;
    std::string with = two_links("\"soft\"", "[-0.1, 2]", 0, "\"foot\"");
    const std::string kind = "control = \"load\"";
    with.replace(
        with.find(kind), kind.size(),
        "kind = \"sensitivity\"\nsensitivity = { parameters = [\"soft\", \"foot\"] }\n" + kind);
    const StudyResult result =
        run(std::string("[parameters]\nfoot = 1\nsoft = ") + text + "\n" + with).of("press");
    EXPECT_TRUE(complete(result)) << text;
    std::vector<std::size_t> rows;
    for (const auto& event : result.branches.at(0).events)
      if (event.kind == EventKind::branch_point) rows.push_back(event.row);
    ASSERT_EQ(rows.size(), 2u) << text;
    // What a change of the whole parameter moves, to rounding.
    const auto slope = [s](double load) { return 2 * load - (1 + 2 * s); };
    const double first = s / second;
    EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(soft)"), (2 * first - 1) / slope(first), 1e-11)
        << text;
    EXPECT_NEAR(s * value(result, rows[1], "d(lambda)/d(soft)"),
                s * (2 * second - 1) / slope(second), 1e-12)
        << text;
    EXPECT_NEAR(value(result, rows[1], "d(lambda)/d(foot)"), (second - s) / slope(second), 1e-9)
        << text;
  }
}

/// Stiffness s at the foot and 1 between them: [[1 + s, -1], [-1, 1]].
TEST(SoftMembers, AtTheFootOfAPerfectColumnLeaveItsOtherCriticalLoadsWhereTheyAre) {
  for (const char* text : {"1e-5", "1e-7", "1e-10", "1e-14"}) {
    const double s = std::stod(text), second = (2 + s + std::sqrt(4 + s * s)) / 2;
    const StudyResult result = run(two_links("1", "[-0.1, 4]", 1, text)).of("press");
    expect_both_loads(result, s, second, text);
  }
}

}  // namespace
}  // namespace springfold::io
