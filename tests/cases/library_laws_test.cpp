// Laws that every case of the library obeys, whatever its numbers are.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/column.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> case_files() {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path{SPRINGFOLD_SOURCE_DIR} / "cases"))
    if (entry.path().filename() == "case.toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Rows on which the two counts differ; a number that one of them lacks is a difference.
int rows_that_differ(const analysis::StudyResult& result, const std::string& one,
                     const std::string& other) {
  const std::size_t a = column(result, one), b = column(result, other);
  int differ = 0;
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Sample& row : branch.samples) {
      const double x = row.values[a], y = row.values[b];
      differ += x == y || (std::isnan(x) && std::isnan(y)) ? 0 : 1;
    }
  return differ;
}

TEST(EveryCase, CountsTheSameModesUnstableUnderLoadControlAsUnderDeadLoad) {
#ifdef SPRINGFOLD_SANITIZED
  GTEST_SKIP() << "takes minutes with sanitizers; other tests run the same code with them";
#endif
  int studies = 0;
  for (const fs::path& file : case_files())
    for (const PlannedRun& run : load_case(file).runs) {
      if (run.plan.kind != analysis::StudyKind::force_deflection ||
          run.plan.control != analysis::ControlMode::load)
        continue;
      const auto result = analysis::run_study_after(run.history, run.mechanism, run.plan,
                                                    run.family ? &*run.family : nullptr);
      EXPECT_EQ(rows_that_differ(result, "index", "index_force"), 0)
          << file << ", " << run.study << ", run " << run.run;
      ++studies;
    }
  EXPECT_GT(studies, 50);
}

}  // namespace
}  // namespace springfold::io
