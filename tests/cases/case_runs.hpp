// Runs of case texts in tests, and values in their results.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "analysis/column.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

struct Ran {
  Case read{};
  std::vector<analysis::StudyResult> results{};
  const analysis::StudyResult& of(const std::string& study) const& {
    for (const analysis::StudyResult& result : results)
      if (result.study == study) return result;
    throw std::out_of_range(study);
  }
  analysis::StudyResult of(const std::string& study) && { return std::as_const(*this).of(study); }
};

inline Ran run(const std::string& text) {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const auto file = std::filesystem::path{testing::TempDir()} /
                    (std::string{"springfold_"} + info->test_suite_name() + info->name() + ".toml");
  std::ofstream{file, std::ios::binary} << text;
  Ran ran{load_case(file), {}};
  std::filesystem::remove(file);
  for (const PlannedRun& planned : ran.read.runs) {
    ran.results.push_back(analysis::run_study_after(planned.history, planned.mechanism,
                                                    planned.plan,
                                                    planned.family ? &*planned.family : nullptr));
    ran.results.back().study = planned.study;
    ran.results.back().run = planned.run;
  }
  return ran;
}

inline std::vector<double> lambdas(const analysis::StudyResult& result, analysis::EventKind kind) {
  std::vector<double> list;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == kind) list.push_back(value(result, event.row, "lambda"));
  return list;
}

}  // namespace springfold::io
