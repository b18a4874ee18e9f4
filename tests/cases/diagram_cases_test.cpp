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

}  // namespace
}  // namespace springfold::io
