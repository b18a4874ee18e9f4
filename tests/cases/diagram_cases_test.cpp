// The case files that ask for whole diagrams in other units. That they hold as they are is shown by
// scripts/verify-cases.sh.
#include <gmock/gmock.h>

#include "springfold/analysis/run.hpp"
#include "springfold/io/case_file.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

void expect_all_hold(const std::string& folder,
                     const std::map<std::string, std::string>& overrides) {
  const Case c = load_case(
      std::filesystem::path{SPRINGFOLD_SOURCE_DIR} / "cases" / folder / "case.toml", overrides);
  std::vector<analysis::StudyResult> results;
  for (const PlannedRun& run : c.runs) {
    results.push_back(analysis::run_study(run.mechanism, run.plan));
    results.back().study = run.study;
    results.back().run = run.run;
    EXPECT_TRUE(complete(results.back())) << run.study;
  }
  const std::vector<Comparison> comparisons = compare(c.expected, results);
  EXPECT_GT(comparisons.size(), 3u);
  for (const Comparison& comparison : comparisons)
    EXPECT_TRUE(comparison.holds) << comparison.expected.name << ": " << comparison.ours
                                  << ", expected " << comparison.expected.expected;
}

TEST(VonMisesTrussCase, AgreesInOtherUnitsAndForms) {
  expect_all_hold("von-mises-truss", {{"a", "300"}, {"L0", "1000"}, {"k", "70"}});
  expect_all_hold("von-mises-truss", {{"a", "0.2"}});
}

TEST(LinkColumnCase, AgreesInOtherUnits) {
  expect_all_hold("link-column", {{"L", "0.02"}, {"k", "1e5"}});
}

TEST(Bend45Case, AgreesWithASecondSolution) { expect_all_hold("bend-45", {}); }

TEST(SegmentedColumnCase, HasDoubleCriticalPointsAsTheClosedFormSays) {
  expect_all_hold("segmented-column", {});
}

TEST(SegmentedColumnCase, AgreesInOtherUnits) {
  expect_all_hold("segmented-column", {{"L", "250"}, {"EI", "3e4"}});
}

/// Values of lambda at the branch points of the two-link column.
std::vector<double> critical_loads(const std::map<std::string, std::string>& overrides) {
  const Case c = load_case(
      std::filesystem::path{SPRINGFOLD_SOURCE_DIR} / "cases/segmented-column/case.toml", overrides);
  PlannedRun run = c.runs.at(1);
  run.plan.until[0].high = 7;
  std::vector<double> loads;
  const analysis::StudyResult result = analysis::run_study(run.mechanism, run.plan);
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Event& event : branch.events)
      if (event.kind == analysis::EventKind::branch_point)
        loads.push_back(branch.samples[event.row].values[1]);
  return loads;
}

// EA -> infinity: 2 (sqrt 21 - 3); twice that about the axis that is twice as stiff.
TEST(SegmentedColumnCase, TendsToTheClosedFormOfTheColumnThatIsNotShortened) {
  const double P = 2 * (std::sqrt(21.0) - 3);
  EXPECT_THAT(critical_loads({{"EA", "1e9"}}), testing::ElementsAre(testing::DoubleNear(P, 2e-8)));
  EXPECT_THAT(critical_loads({{"EA", "1e9"}, {"weak", "2"}}),
              testing::ElementsAre(testing::DoubleNear(P, 2e-8), testing::DoubleNear(2 * P, 6e-8)));
}

TEST(PuuFlexibleCase, HasTheStiffnessOfTheClosedForm) { expect_all_hold("puu-flexible", {}); }

TEST(BarCases, AgreeInOtherUnits) {
  expect_all_hold("bar-torsion-spring", {{"L", "300"}, {"c", "7e4"}});
  expect_all_hold("guyed-bar", {{"L", "0.02"}, {"k", "5e3"}});
  expect_all_hold("quasi-zero-stiffness", {{"a", "40"}, {"k", "0.3"}});
}

TEST(ThreeLinkChainCase, AgreesInOtherUnits) {
  expect_all_hold("three-link-chain", {{"l", "250"}, {"c", "1e5"}});
}

/// Also that the straight column counts as unstable where it is so to one side only.
TEST(ColumnWithStopCase, AgreesInOtherUnits) {
  expect_all_hold("column-with-stop", {{"l", "50"}, {"c", "2e4"}});
}

TEST(UniversalJointCase, AgreesInOtherUnits) {
  expect_all_hold("universal-joint-bar", {{"L", "0.1"}, {"c1", "300"}});
}

}  // namespace
}  // namespace springfold::io
