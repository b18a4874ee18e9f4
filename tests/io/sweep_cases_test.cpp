// Studies with many runs: values of several parameters, and the table with one row per run.
#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::Contains;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string head = R"([parameters]
k = 1
c = 10
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "strut"
elements = [
  { joint = "revolute", axis = "z", name = "foot", role = "virtual", stiffness = "k" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = "c" },
  { rigid = [1, 0] },
]
[[study]]
name = "press"
control = "load"
direction = [-1, 0]
until = { lambda = [-0.1, "1.2*k"] }
)";

class SweepCases : public CaseFiles {
 protected:
  std::vector<PlannedRun> runs(const std::string& vary) const {
    return load(head + "vary = " + vary + "\n").runs;
  }
  std::vector<std::string> wrong(const std::string& vary) const {
    return messages(head + "vary = " + vary + "\n");
  }
};

std::vector<std::pair<double, double>> values_of(const std::vector<PlannedRun>& runs) {
  std::vector<std::pair<double, double>> values;
  for (const PlannedRun& run : runs)
    values.emplace_back(run.parameters.at("k"), run.parameters.at("c"));
  return values;
}

using Values = std::vector<std::pair<double, double>>;

TEST_F(SweepCases, AGridHasEveryValueWithEveryOtherAndItsFirstParameterRunsFastest) {
  const auto found = runs("{ grid = { c = [8, \"9*k\"], k = { from = 1, to = 2, points = 3 } } }");
  EXPECT_EQ(values_of(found), (Values{{1, 8}, {1, 9}, {1.5, 8}, {1.5, 13.5}, {2, 8}, {2, 18}}));
  EXPECT_EQ(found[3].label, "c = 13.5, k = 1.5");
  EXPECT_EQ(found[3].run, 4);
}

TEST_F(SweepCases, AListHasItsParametersSideBySide) {
  EXPECT_EQ(values_of(runs("{ list = { k = [1, 2], c = [20, 30] } }")), (Values{{1, 20}, {2, 30}}));
}

TEST_F(SweepCases, ASampleUsesEveryPartOfEveryRangeOnce) {
  constexpr int n = 50;
  const auto found = runs("{ sample = { k = [1, 2], c = [\"4*2\", 9] }, points = 50, seed = 3 }");
  ASSERT_EQ(found.size(), 50U);
  std::set<int> of_k, of_c;
  for (const auto& [k, c] : values_of(found)) {
    of_k.insert(static_cast<int>(std::floor((k - 1) * n)));
    of_c.insert(static_cast<int>(std::floor((c - 8) * n)));
  }
  std::set<int> parts;
  for (int i = 0; i < n; ++i) parts.insert(i);
  EXPECT_EQ(of_k, parts);
  EXPECT_EQ(of_c, parts);
}

TEST_F(SweepCases, ASampleIsTheSameForTheSameSeedAndAnotherForAnother) {
  const std::string sample = "{ sample = { k = [1, 2], c = [8, 9] }, points = 20, seed = ";
  EXPECT_EQ(values_of(runs(sample + "7 }")), values_of(runs(sample + "7 }")));
  EXPECT_NE(values_of(runs(sample + "7 }")), values_of(runs(sample + "8 }")));
}

TEST_F(SweepCases, TheTableHasItsColumnsWithTheirNames) {
  const Case found =
      load(head +
           "vary = { list = { k = [1, 2] }, table = [{ name = \"P\", at = \"BP1\", quantity = "
           "\"lambda\", factor = \"1/k\" }, { quantity = \"count.BP\" }] }\n");
  ASSERT_EQ(found.sweeps.size(), 1U);
  EXPECT_THAT(found.sweeps[0].parameters, ElementsAre("k"));
  EXPECT_THAT(found.sweeps[0].columns, ElementsAre("P", "count.BP"));
  EXPECT_THAT(found.runs[1].columns[0].factor, DoubleEq(0.5));
  EXPECT_TRUE(found.runs[1].keeps_curves);
}

TEST_F(SweepCases, SayWhatIsWrongWithValues) {
  EXPECT_THAT(
      wrong("{ list = { k = [1, 2], c = [20] } }"),
      ElementsAre(HasSubstr("vary.list.c: got 1 values, need 2 as for the first parameter")));
  EXPECT_THAT(wrong("{ grid = { kk = [1, 2] } }"),
              ElementsAre(HasSubstr("vary.grid.kk: no parameter \"kk\", did you mean \"k\"?")));
  EXPECT_THAT(wrong("{ grid = { k = { from = 1, to = 2 } } }"),
              Contains(HasSubstr("vary.grid.k.points: missing")));
  EXPECT_THAT(wrong("{ grid = { k = { from = 1, to = 2, points = 200 }, c = { from = 1, to = 2, "
                    "points = 200 } } }"),
              ElementsAre(HasSubstr("vary.grid: got 40000 values, need at most 10000 values")));
  EXPECT_THAT(wrong("{ sample = { k = [2, 1] }, points = 3 }"),
              ElementsAre(HasSubstr("vary.sample.k: need low < high")));
  EXPECT_THAT(wrong("{ sample = { k = [1, 2] } }"),
              ElementsAre(HasSubstr("vary.points: missing, need a whole number from 1 to 10000")));
  EXPECT_THAT(wrong("{ grid = { k = [1, 2] }, list = { c = [8, 9] } }"),
              Contains(HasSubstr("need one of parameter with values, list, grid and sample")));
  EXPECT_THAT(wrong("{ grid = { k = [1, 2] }, points = 4 }"),
              ElementsAre(HasSubstr("vary.points: has no meaning here, goes with sample")));
}

TEST_F(SweepCases, SayWhatIsWrongWithTables) {
  EXPECT_THAT(wrong("{ grid = { k = [1, 2] }, curves = false }"),
              ElementsAre(HasSubstr("vary.curves: got false without a table")));
  EXPECT_THAT(wrong("{ grid = { k = [1, 2] }, table = [{ quantity = \"lambdaa\" }] }"),
              ElementsAre(HasSubstr("no quantity \"lambdaa\" in study \"press\"")));
  EXPECT_THAT(wrong("{ grid = { k = [1, 2] }, table = [{ quantity = \"lambda\" }, { quantity = "
                    "\"lambda\" }] }"),
              ElementsAre(HasSubstr("two columns are called \"lambda\"")));
  EXPECT_THAT(
      messages(
          head +
          "vary = { grid = { k = [1, 2] }, curves = false, table = [{ quantity = \"lambda\" }] }\n"
          "[[plot]]\nname = \"p\"\ncurves = [{ study = \"press\" }]\n"),
      ElementsAre(
          HasSubstr("study[1].vary.curves: got false, need true: plot \"p\" draws these curves")));
}

}  // namespace
}  // namespace springfold::io
