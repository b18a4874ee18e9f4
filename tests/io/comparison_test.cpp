// Expected values of a case: how a point is picked, and what may be compared there.
#include <gmock/gmock.h>

#include <sstream>

#include "case_files.hpp"
#include "io/compared_quantity.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/verification.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A bar on a torsion spring under an axial load: a branch point at P = 1, behind it P = t/sin t.
constexpr const char* strut = R"(
[parameters]
k = 1
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "z", name = "hinge", role = "preloaded", stiffness_or_law },
  { rigid = [1, 0] },
]
[[study]]
name = "press"
control = "load"
direction = [-1, 0]
until = { lambda = [-0.5, 1.8], bar.hinge = [-1.5, 1.5] }
mark = { bar.hinge = [-1, 0.5, 1] }
branches = { depth = 1 }
)";

std::string strut_text() {
  std::string text = strut;
  const std::string word = "stiffness_or_law";
  return text.replace(text.find(word), word.size(),
                      R"(spring = { law = "linear", stiffness = "k" })");
}

class Expected : public CaseFiles {
 protected:
  /// The case with these expected values, and what came out.
  VerifiedCase verified(const std::string& values) const {
    write("expected.toml", "value = [\n" + values + "]\n");
    VerifiedCase v{.name = "strut", .the_case = load(strut_text())};
    for (const PlannedRun& run : v.the_case.runs) {
      v.results.push_back(analysis::run_study(run.mechanism, run.plan));
      v.results.back().study = run.study;
    }
    v.comparisons = compare(v.the_case.expected, v.results);
    return v;
  }
  static std::string value(const std::string& entries) {
    return "{ name = \"a\", study = \"press\", tolerance = 1e-9, " + entries + " },\n";
  }
  std::vector<std::string> mistakes(const std::string& entries) const {
    write("expected.toml", "value = [\n" + value(entries) + "]\n");
    std::vector<std::string> all = messages(strut_text());
    std::erase_if(all, [](const std::string& message) {
      return message.find("was read because it lies beside") != std::string::npos;
    });
    return all;
  }
};

TEST_F(Expected, PicksTheNearestOfSeveralPoints) {
  const auto v = verified(
      value(R"(at = "UZ", near = { "bar.hinge" = 1 }, quantity = "bar.hinge", expected = 1)") +
      value(R"(at = "UZ", near = { bar.hinge = -2 }, quantity = "bar.hinge", expected = -1)") +
      value(
          R"~(at = "UZ", near = { bar.hinge = 0.6, lambda = 1 }, quantity = "lambda", expected = "0.5/sin(0.5)")~"));
  EXPECT_TRUE(holds(v)) << verification_table({v});
}

TEST_F(Expected, CountsBranchesWaysAndVanishingModes) {
  const auto v = verified(value(R"(at = "BP1", quantity = "corank", expected = 1)") +
                          value(R"(at = "BP1", quantity = "ways", expected = 4)") +
                          value(R"(quantity = "count.branches", expected = 3)") +
                          value(R"(quantity = "count.BP", expected = 1)"));
  EXPECT_TRUE(holds(v)) << verification_table({v});
}

TEST_F(Expected, ComparesSlopesAlongTheBranch) {
  // P = t/sin t: dP/dt = (sin t - t cos t)/sin^2 t.
  const auto v = verified(value(
      R"~(at = "UZ", near = { bar.hinge = 1 }, quantity = "lambda", per = "bar.hinge", expected = "(sin(1) - cos(1))/sin(1)^2")~"));
  EXPECT_TRUE(holds(v)) << verification_table({v});
}

TEST_F(Expected, MayBeBounds) {
  const auto v =
      verified(value(R"(quantity = "count.branches", compare = "at_least", expected = 2)") +
               value(R"(quantity = "count.branches", compare = "at_most", expected = 3)"));
  EXPECT_TRUE(holds(v));
  const auto w =
      verified(value(R"(quantity = "count.branches", compare = "at_least", expected = 4)") +
               value(R"(quantity = "count.branches", compare = "at_most", expected = 2)"));
  EXPECT_FALSE(w.comparisons[0].holds);
  EXPECT_FALSE(w.comparisons[1].holds);
  EXPECT_THAT(comparison_table(w.comparisons, w.the_case.expected), HasSubstr(">= 4"));
}

TEST_F(Expected, ThatNameNoPointOrNoValueDoNotHold) {
  const auto v =
      verified(value(R"(at = "LP", near = { lambda = 1 }, quantity = "lambda", expected = 1)") +
               value(R"(at = "UZ1", quantity = "corank", expected = 1)"));
  for (const Comparison& comparison : v.comparisons) EXPECT_TRUE(std::isnan(comparison.ours));
  EXPECT_FALSE(holds(v));
}

TEST_F(Expected, WithMistakesSayWhatIsNeeded) {
  EXPECT_THAT(
      mistakes(R"(at = "UZ", quantity = "lambda", expected = 1)"),
      ElementsAre(HasSubstr("value[1].at: got \"UZ\", which may be several points: need near")));
  EXPECT_THAT(
      mistakes(R"(at = "UZ1", near = { lambda = 1 }, quantity = "lambda", expected = 1)"),
      ElementsAre(HasSubstr("value[1].near: goes with at = \"LP\" and the like, the code of")));
  EXPECT_THAT(mistakes(R"(at = "UZ", near = 1, quantity = "lambda", expected = 1)"),
              ElementsAre(HasSubstr("need a table such as { deflection = 0.1 }"),
                          HasSubstr("need at least one quantity and its value")));
  EXPECT_THAT(mistakes(R"(at = "UZ", near = { lamda = 1 }, quantity = "lambda", expected = 1)"),
              ElementsAre(HasSubstr("no quantity \"lamda\" in study \"press\", did you mean")));
  EXPECT_THAT(mistakes(R"(at = "UZ1", quantity = "lambda", per = "hinge", expected = 1)"),
              ElementsAre(HasSubstr("value[1].per: no quantity \"hinge\"")));
  EXPECT_THAT(mistakes(R"(quantity = "lambda", compare = "less", expected = 1)"),
              ElementsAre(HasSubstr("need \"equal\", \"at_least\" or \"at_most\"")));
  EXPECT_THAT(
      mistakes(R"(at = "UZ1", quantity = "lambda", per = "lambda", side = "left", expected = 1)"),
      ElementsAre(HasSubstr("need \"after\" or \"before\"")));
  EXPECT_THAT(mistakes(R"(quantity = "count.branch", expected = 1)"),
              ElementsAre(HasSubstr("need count. and one of \"branches\"")));
  EXPECT_THAT(mistakes(R"(quantity = "K.x.z", expected = 1)"),
              ElementsAre(HasSubstr("value[1].quantity: no quantity \"K.x.z\"")));
}

/// A point on two springs at right angles, 2 along x and 5 along y.
TEST_F(Expected, NameEntriesOfTheStiffnessMatrixAndOfItsInverse) {
  write("expected.toml", "value = [" + value(R"(quantity = "K.x.x", expected = 2)") +
                             value(R"(quantity = "K.x.y", expected = 0)") +
                             value(R"(quantity = "K.y.y", expected = 5)") +
                             value(R"(quantity = "C.y.y", expected = 0.2)") + "]");
  const Case c = load(R"(
[[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "leg"
elements = [
  { joint = "prismatic", axis = "x", role = "virtual", stiffness = 2 },
  { joint = "prismatic", axis = "y", role = "virtual", stiffness = 5 },
]
[[study]]
name = "press"
kind = "equilibrium"
)");
  auto result = analysis::run_study(c.runs[0].mechanism, c.runs[0].plan);
  result.study = "press";
  for (const Comparison& comparison : compare(c.expected, {result}))
    EXPECT_TRUE(comparison.holds) << comparison.expected.quantity << " = " << comparison.ours;
}

TEST(MatrixEntries, NameTheBodyWhereThereAreSeveral) {
  model::Mechanism one;
  one.bodies = {{"a", model::TaskSpace::planar, Vector::Zero(3)}};
  const auto names = matrix_entries(one);
  ASSERT_EQ(names.size(), 18u);
  EXPECT_EQ(names[2].name, "K.x.phi");
  EXPECT_EQ(names[2].entry.column, 2);
  EXPECT_EQ(names[9].name, "C.x.x");
  model::Mechanism two;
  two.bodies = {{"a", model::TaskSpace::xy, Vector::Zero(2)},
                {"b", model::TaskSpace::xy, Vector::Zero(2)}};
  EXPECT_EQ(matrix_entries(two)[2].name, "K.a.x.b.x");
}

TEST(ComparisonTable, FitsATerminalWithLongNamesAndNamesEachSourceOnce) {
  const std::string name =
      "the load at which the second of all modes appears, in parts of the first";
  std::vector<Comparison> comparisons;
  for (const char* source : {"a closed form", "another program", "a closed form"})
    comparisons.push_back({.expected = {.name = name,
                                        .expected = -0.123456789012,
                                        .tolerance = 1e-10,
                                        .source = source},
                           .ours = -0.12345678901,
                           .holds = true});
  const std::string table = comparison_table(comparisons, {});
  std::istringstream lines{table};
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  const auto count = [&table](const std::string& text) {
    std::size_t times = 0;
    for (std::size_t at = 0; (at = table.find(text, at)) != std::string::npos; ++at) ++times;
    return times;
  };
  EXPECT_EQ(count("[1]"), 3U);  // two values and the source itself
  EXPECT_EQ(count("[2]"), 2U);
  EXPECT_EQ(count("a closed form"), 1U);
  EXPECT_EQ(count("parts of the"), 3U);
}

TEST_F(Expected, AreShownInOneTableWithTheCaseTheSourceAndTheFaults) {
  auto v = verified(value(R"(at = "BP1", quantity = "lambda", expected = 1, source = "here")"));
  EXPECT_THAT(verification_table({v}), HasSubstr("1 of 1 case hold, 1 of 1 value\n"));
  EXPECT_THAT(verification_csv({v}),
              HasSubstr("strut,,a,press,1,BP1,lambda,1,1,0,1e-09,equal,true,here\n"));
  v.results[0].branches[0].forward = {"too short", false};
  EXPECT_FALSE(holds(v));
  EXPECT_THAT(verification_table({v}),
              HasSubstr("NOT OK  strut: press, run 1: stopped early: too short\n"));
  EXPECT_THAT(verification_json({v}), HasSubstr("\"holds\": false"));
  v.results.clear();
  v.comparisons.clear();
  EXPECT_THAT(faults_of(v), ElementsAre("press, run 1: was not run", "has no expected values"));
}

}  // namespace
}  // namespace springfold::io
