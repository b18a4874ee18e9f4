// Many cases compared with their expected values at once: one table, also for other programs.
#pragma once

#include <string>
#include <vector>

#include "springfold/io/results.hpp"

namespace springfold::io {

/// A case with what came out of its runs.
struct VerifiedCase {
  std::string name{};
  Case the_case{};
  std::vector<analysis::StudyResult> results{};
  std::vector<Comparison> comparisons{};
};

/// What keeps a case from holding beside its compared values, one sentence each: runs that are not
/// complete, nothing to compare with.
std::vector<std::string> faults_of(const VerifiedCase& verified);

/// No faults, and every compared value holds.
bool holds(const VerifiedCase& verified);

/// One row for each compared value, then the faults, then the counts.
std::string verification_table(const std::vector<VerifiedCase>& cases);

std::string verification_csv(const std::vector<VerifiedCase>& cases);

std::string verification_json(const std::vector<VerifiedCase>& cases);

}  // namespace springfold::io
