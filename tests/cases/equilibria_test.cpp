// Studies of kind "equilibria": what is found, counted once, and said about others.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "io/case_files.hpp"
#include "io/result_tables.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two springs of free length 1.5 between (-1, 0), (1, 0) and a point: five equilibria.
const std::string two_springs = R"(
[parameters]
Fx = 0
Fy = 0
[[body]]
name = "point"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "left"
from_at = [-1, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "45*deg" },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", initial = 1.5, spring = { law = "linear", stiffness = 1, free = 1.5 } },
]
[[chain]]
name = "right"
from_at = [1, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "135*deg" },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", initial = 1.5, spring = { law = "linear", stiffness = 1, free = 1.5 } },
]
[[study]]
name = "all"
kind = "equilibria"
load = ["Fx", "Fy"]
until = { left.length = [1e-6, inf], right.length = [1e-6, inf] }
)";

class Equilibria : public CaseFiles {
 protected:
  StudyResult run(const std::string& text, const Overrides& overrides = {}) const {
    const Case c = load(text, overrides);
    StudyResult result = analysis::run_study(c.runs[0].mechanism, c.runs[0].plan);
    result.study = c.runs[0].study;
    return result;
  }
  static double value(const StudyResult& result, std::size_t row, const std::string& quantity) {
    for (std::size_t i = 0; i < result.quantities.size(); ++i)
      if (result.quantities[i].name == quantity)
        return result.equilibria->list[row].sample.values[i];
    return std::nan("");
  }
  static std::size_t with_index(const StudyResult& result, int index) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < result.equilibria->list.size(); ++i)
      count += value(result, i, "index") == index ? 1 : 0;
    return count;
  }
};

TEST_F(Equilibria, OfTwoSpringsAreFiveWhateverTheSeed) {
  for (const char* seed : {"1", "2", "3"}) {
    const auto result = run(two_springs + "search = { starts = 100, seed = " + seed + " }\n");
    ASSERT_TRUE(analysis::complete(result));
    EXPECT_EQ(result.equilibria->list.size(), 5u);
    EXPECT_EQ(with_index(result, 0), 2u);
    EXPECT_EQ(with_index(result, 1), 3u);
    EXPECT_TRUE(result.equilibria->morse.applies);
    EXPECT_EQ(result.equilibria->morse.expected, -1);
    EXPECT_EQ(result.equilibria->morse.found, -1);
  }
}

TEST_F(Equilibria, AreListedByTheirPotentialAndAreSolutions) {
  const auto result = run(two_springs, {{"Fx", "0.1"}, {"Fy", "0.05"}});
  ASSERT_EQ(result.equilibria->list.size(), 5u);
  double before = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& e = result.equilibria->list[i];
    const double x = value(result, i, "point.x"), y = value(result, i, "point.y");
    EXPECT_NEAR(e.potential, value(result, i, "energy") - 0.1 * x - 0.05 * y, 1e-14);
    EXPECT_GE(e.potential, before);
    before = e.potential;
    double fx = 0.1, fy = 0.05;  // what the springs and the load do to the point
    for (const double foot : {-1.0, 1.0}) {
      const double l = std::hypot(x - foot, y);
      fx -= (l - 1.5) * (x - foot) / l;
      fy -= (l - 1.5) * y / l;
    }
    EXPECT_NEAR(fx, 0, 1e-11);
    EXPECT_NEAR(fy, 0, 1e-11);
    EXPECT_EQ(e.label, "EQ" + std::to_string(i + 1));
    EXPECT_EQ(e.stiffness.rows(), 2);
  }
  EXPECT_NEAR(value(result, 0, "point.y"), 1.16338159, 1e-8);
}

TEST_F(Equilibria, CountOnlyTheFeetThatArePeaksOfTheEnergy) {
  // A load that outweighs the pressed spring at one foot: 1 - 1; at both: 1.
  EXPECT_EQ(run(two_springs, {{"Fx", "1.5"}}).equilibria->morse.expected, 0);
  const auto heavy = run(two_springs, {{"Fy", "-4"}});
  EXPECT_EQ(heavy.equilibria->morse.expected, 1);
  EXPECT_EQ(heavy.equilibria->morse.found, 1);
}

TEST_F(Equilibria, SayWhenTheMorseCountShowsThatSomeAreMissing) {
  const auto result = run(two_springs + "search = { starts = 20, maximum = 1 }\n");
  EXPECT_EQ(result.equilibria->list.size(), 1u);
  EXPECT_TRUE(result.equilibria->limit_reached);
  EXPECT_THAT(result.doubts, ElementsAre(HasSubstr("the search missed equilibria")));
  EXPECT_FALSE(analysis::complete(result));
}

/// A bar on a hinge about a horizontal axis, its weight P above it.
std::string open_chain(const std::string& spring, const std::string& load) {
  return R"(
[[body]]
name = "top"
task_space = "planar"
pose = [0, 1, 0]
[[chain]]
name = "bar"
elements = [{ joint = "revolute", axis = "z", name = "hinge", )" +
         spring + R"( }, { rigid = [0, 1] }]
[[study]]
name = "all"
kind = "equilibria"
load = )" +
         load + "\n";
}

TEST_F(Equilibria, OfAnOpenChainWithSpringsHaveTheSignedCountOne) {
  // t = P sin t has three solutions for P = 2.
  const auto result = run(open_chain(
      R"(role = "preloaded", spring = { law = "linear", stiffness = 1 })", "[0, -2, 0]"));
  EXPECT_EQ(result.equilibria->list.size(), 3u);
  EXPECT_TRUE(result.equilibria->morse.applies);
  EXPECT_EQ(result.equilibria->morse.expected, 1);
  EXPECT_EQ(result.equilibria->morse.found, 1);
}

TEST_F(Equilibria, OfAFreePendulumAreTwoAndCancel) {
  const auto result = run(open_chain(R"(role = "passive")", "[0, -2, 0]"));
  ASSERT_EQ(result.equilibria->list.size(), 2u) << "full turns are the same";
  EXPECT_NEAR(result.equilibria->list[0].potential, -2, 1e-12);
  EXPECT_NEAR(result.equilibria->list[1].potential, 2, 1e-12);
  EXPECT_EQ(result.equilibria->morse.expected, 0);
  EXPECT_EQ(result.equilibria->morse.found, 0);
}

TEST_F(Equilibria, SayWhyTheMorseCountDoesNotApply) {
  const auto turned = run(open_chain(R"(role = "passive")", "[0, -2, 0.5]"));
  EXPECT_THAT(turned.equilibria->morse.why, HasSubstr("a moment turns bar.hinge"));
  const auto stop = run(
      open_chain(R"(role = "preloaded", spring = { law = "one_sided", stiffness = 1, from = 1 })",
                 "[0, -2, 0]"));
  EXPECT_THAT(stop.equilibria->morse.why, HasSubstr("has no spring that holds it on both sides"));
}

/// A point in space on three bars with universal joints, above and below the plane of their feet.
const std::string tripod = [] {
  std::string text = R"(
[[body]]
name = "apex"
task_space = "xyz"
pose = [0, 0, 1]
)";
  for (const char* angle : {"0", "120", "240"})
    text += "[[chain]]\nname = \"bar" + std::string(angle) + "\"\nfrom_at = [\"cos(" + angle +
            "*deg)\", \"sin(" + angle + "*deg)\", 0]\nelements = [\n" +
            R"({ joint = "universal", axes = ["y", "z"] },
{ joint = "prismatic", axis = "x", name = "length", role = "virtual", initial = 1.4, spring = { law = "linear", stiffness = 1, free = 1.4 } }]
)";
  return text + R"([[study]]
name = "all"
kind = "equilibria"
until = { bar0.length = [1e-6, inf], bar120.length = [1e-6, inf], bar240.length = [1e-6, inf] }
)";
}();

TEST_F(Equilibria, InOtherCoordinatesOfTheSameJointsCountOnce) {
  const auto result = run(tripod);
  const auto& list = result.equilibria->list;
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      double distance = 0;
      for (const char* x : {"apex.x", "apex.y", "apex.z"})
        distance = std::max(distance, std::abs(value(result, i, x) - value(result, k, x)));
      EXPECT_GT(distance, 1e-6) << "a universal joint turned over is the same equilibrium";
    }
  // Above and below; 1 + 3 feet that are peaks.
  EXPECT_GE(list.size(), 2u);
  EXPECT_EQ(result.equilibria->morse.expected, 4);
  EXPECT_EQ(result.equilibria->morse.found, 4);
}

TEST_F(Equilibria, AreFoundWithoutAStartToo) {
  // The guess is so far off that the start is refused.
  const auto result = run(two_springs + "start = { pose = [0, 1.5], maximum_move = 1e-9 }\n");
  EXPECT_TRUE(result.start.found);
  EXPECT_THAT(result.start.method, HasSubstr("none near the guess"));
  EXPECT_EQ(result.equilibria->list.size(), 5u);
}

/// An arm of links 1 and 0.9 from the origin, its end between two springs whose feet lie at (+-1, 0.8).
const std::string sprung_arm = R"(
[[body]]
name = "tip"
task_space = "xy"
pose = [0.1, 0.8]
[[chain]]
name = "arm"
elements = [
  { joint = "revolute", axis = "z", initial = 0.3 },
  { rigid = [0, -1] },
  { joint = "revolute", axis = "z", initial = 2.5 },
  { rigid = [0, -0.9] },
]
[[spring]]
name = "a"
from_at = [1, 0.8]
to = "tip"
stiffness = 1
free = 2.5
[[spring]]
name = "b"
from_at = [-1, 0.8]
to = "tip"
stiffness = 1
free = 2.5
[[study]]
name = "all"
kind = "equilibria"
)";

TEST_F(Equilibria, OfAnArmThatItsSpringsStretchAreListedWhereverTheSearchBegins) {
  // Both springs are pressed at (0, 1.9) and push the tip away: along x they lose less than the arm's bending costs.
  for (const char* start : {"", "start = { pose = [0, 1.9] }\n"}) {
    const auto result = run(sprung_arm + start);
    EXPECT_EQ(result.equilibria->locked, 0);
    std::size_t stretched = 0;
    for (std::size_t i = 0; i < result.equilibria->list.size(); ++i)
      if (std::abs(value(result, i, "tip.y") - 1.9) < 1e-9) {
        EXPECT_NEAR(value(result, i, "tip.x"), 0, 1e-9);
        EXPECT_EQ(value(result, i, "index"), 0);
        ++stretched;
      }
    EXPECT_EQ(stretched, 1u);
  }
}

/// Two legs without springs that hold a point: links of length 1 from the origin, of length 2 from (1.5, 0).
const std::string two_legs = R"(
[[body]]
name = "tip"
task_space = "xy"
pose = [0.3, 1.6]
[[chain]]
name = "short"
elements = [
  { joint = "revolute", axis = "z", initial = 1 },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", initial = 0.5 },
  { rigid = [1, 0] },
]
[[chain]]
name = "long"
from_at = [1.5, 0]
elements = [
  { joint = "revolute", axis = "z", initial = 1 },
  { rigid = [2, 0] },
  { joint = "revolute", axis = "z", initial = 2 },
  { rigid = [2, 0] },
]
[[study]]
name = "all"
kind = "equilibria"
load = [0, 1]
)";

TEST_F(Equilibria, OfALegThatTheLoadStretchesWhileAnotherIsBentAreListed) {
  // The short leg hangs on the load, stretched: stable at (0, 2), unstable in its turn and its elbow at (0, -2).
  const auto result = run(two_legs);
  std::size_t hanging = 0, standing = 0;
  for (std::size_t i = 0; i < result.equilibria->list.size(); ++i) {
    if (std::abs(value(result, i, "tip.x")) > 1e-9) continue;
    if (std::abs(value(result, i, "tip.y") - 2) < 1e-9 && value(result, i, "index") == 0) ++hanging;
    if (std::abs(value(result, i, "tip.y") + 2) < 1e-9 && value(result, i, "index") == 2)
      ++standing;
  }
  EXPECT_EQ(hanging, 1u);
  EXPECT_EQ(standing, 1u);
}

TEST_F(Equilibria, OfBarsOfNoLengthAreCountedButNotListed) {
  // At its foot a bar balances what pushes across it, whatever that is: polar coordinates at their pole.
  std::string any_length = two_springs;
  any_length.erase(any_length.find("until"));
  const auto result = run(any_length, {{"Fx", "0.1"}, {"Fy", "0.05"}});
  EXPECT_GT(result.equilibria->locked, 0);
  for (std::size_t i = 0; i < result.equilibria->list.size(); ++i)
    for (const char* length : {"left.length", "right.length"})
      EXPECT_GT(std::abs(value(result, i, length)), 1e-3);
}

TEST_F(Equilibria, OfALineSpringWithABendNameItsLawWhereTheyAreNotCounted) {
  std::string bent = sprung_arm;
  bent.replace(bent.find("stiffness = 1\nfree = 2.5"), 24,
               "law = { law = \"one_sided\", stiffness = 1, from = 0.5 }");
  EXPECT_THAT(run(bent).equilibria->morse.why, HasSubstr("line springs are counted where their "
                                                         "law is a straight line, and that of a"));
}

TEST_F(Equilibria, AreLookedForFromMoreStartsWhereTheLastOneCameLate) {
  // No count tells whether some are missing where a spring acts on one side alone.
  std::string bent = sprung_arm;
  bent.replace(bent.find("stiffness = 1\nfree = 2.5"), 24,
               "law = { law = \"one_sided\", stiffness = 1, from = 0.5 }");
  for (const int asked : {2, 6}) {
    const auto result = run(bent + "search = { starts = " + std::to_string(asked) + " }\n");
    ASSERT_FALSE(result.equilibria->morse.applies);
    EXPECT_GT(result.equilibria->starts, asked);
    EXPECT_LE(result.equilibria->starts, 4 * asked);
  }
}

TEST_F(Equilibria, HaveATableAndStandInTheSummary) {
  const Case c = load(two_springs);
  StudyResult result = analysis::run_study(c.runs[0].mechanism, c.runs[0].plan);
  result.study = "all";
  const std::string csv = equilibria_csv(result);
  EXPECT_THAT(csv, testing::StartsWith("equilibrium,start,potential,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
  EXPECT_THAT(equilibria_files({result}), ElementsAre("equilibria/all-1.csv"));
  const std::string text = summary_table(c, {result});
  EXPECT_THAT(text, HasSubstr("at least 5 equilibria found, 200 starts"));
  EXPECT_THAT(text, HasSubstr("the sum of (-1)^index is -1, as it must be"));
  const auto json = nlohmann::json::parse(summary_json(c, {result}));
  const auto& report = json["runs"][0]["equilibria"];
  EXPECT_EQ(report["at_least"], 5);
  EXPECT_EQ(report["morse"]["expected"], -1);
  EXPECT_EQ(report["list"][4]["values"]["index"], 1);
}

TEST_F(Equilibria, GiveTheSameResultTwice) {
  EXPECT_EQ(equilibria_csv(run(two_springs)), equilibria_csv(run(two_springs)));
}

TEST_F(Equilibria, WithMistakesSayWhatIsNeeded) {
  EXPECT_THAT(messages(two_springs + "search = { starts = 0 }\n"),
              ElementsAre(HasSubstr("study[1].search.starts: got 0")));
  EXPECT_THAT(messages(two_springs + "search = { boxes = 1 }\n"),
              ElementsAre(HasSubstr("search.boxes: unknown key, did you mean \"box\"?")));
  EXPECT_THAT(messages(two_springs + "search = { box = { point.x = 1 } }\n"),
              ElementsAre(HasSubstr("search.box.point.x: got 1, need [low, high]")));
  EXPECT_THAT(messages(two_springs + "search = { box = { point.x = [1, -1] } }\n"),
              ElementsAre(HasSubstr("need more than 1 (low < high)")));
  EXPECT_THAT(messages(two_springs + "search = { box = { point.z = [-1, 1] } }\n"),
              ElementsAre(HasSubstr("no quantity \"point.z\" in study \"all\"")));
  EXPECT_THAT(
      messages(two_springs + "search = { box = { energy = [0, 1] } }\n"),
      ElementsAre(HasSubstr("search.box.energy: need a coordinate of a body or of a joint")));
  EXPECT_THAT(messages(two_springs + "start = { solve = \"wrench\" }\n"),
              ElementsAre(HasSubstr("study[1].start.solve: \"wrench\" holds the body")));
  EXPECT_THAT(messages(two_springs + "branches = { depth = 1 }\n"),
              ElementsAre(HasSubstr("only kind = \"force_deflection\" has branches")));
  for (const auto& [key, line] : std::vector<std::pair<std::string, std::string>>{
           {"control", "control = \"load\"\n"},
           {"trace", "trace = { maximum_step = 0.1 }\n"},
           {"path", "path = \"davidenko\"\n"},
           {"mark", "mark = { point.x = [0.5] }\n"}})
    EXPECT_THAT(messages(two_springs + line),
                ElementsAre(HasSubstr("study[1]." + key +
                                      ": has no meaning here: kind = \"equilibria\" follows no "
                                      "curve, need kind = \"force_deflection\" with it")));
  std::string other = two_springs;
  other.replace(other.find("\"equilibria\""), 12, "\"equilibrium\"");
  EXPECT_THAT(messages(other + "search = { starts = 5 }\n"),
              ElementsAre(HasSubstr("study[1].until: has no meaning here: kind = \"equilibrium\""),
                          HasSubstr("study[1].search: goes with kind = \"equilibria\"")));
}

}  // namespace
}  // namespace springfold::io
