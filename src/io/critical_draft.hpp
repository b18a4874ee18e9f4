// Settings of studies of special points in a second parameter, numbers still formulas.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/analysis/study.hpp"
#include "table_reader.hpp"

namespace springfold::io {

struct StudyDraft;

struct CriticalPointDraft {
  std::string point{}, parameter{};  ///< point: "LP1", or "STUDY/UZ1"
  std::optional<std::size_t>
      study{};  ///< at whose curve it begins: its position, once they are all read
  std::vector<std::string> parameters{};
  std::vector<NumberId> range{};  ///< low and high, or none
  analysis::Unwanted unwanted = analysis::Unwanted::limit_point;
  analysis::StabilityOf stability = analysis::StabilityOf::control;
  bool smallest = true, tied = true;
  std::optional<NumberId> values{};
};

/// The table that has the name of the study's kind; reports a missing one.
CriticalPointDraft read_critical(analysis::StudyKind kind, const TableReader& study,
                                 NumberTable& numbers, Reading& reading);

/// The key of that table.
std::vector<std::string> critical_keys();

/// Finds the studies at whose curves others begin. @pre with_earlier_curves() had been asked before they were read
void connect_curves(std::vector<StudyDraft>& studies);

void build_critical(const CriticalPointDraft& draft, const std::vector<double>& numbers,
                    analysis::CriticalPointSettings& settings);

}  // namespace springfold::io
