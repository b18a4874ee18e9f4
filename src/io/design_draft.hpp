// Settings of a study of kind `design`, numbers still formulas.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "springfold/analysis/study.hpp"
#include "table_reader.hpp"

namespace springfold::io {

struct DesignDraft {
  struct Parameter {
    std::string name{};
    NumberId low = 0, high = 0;
    std::optional<NumberId> unit{};
  };
  struct Stiffness {
    std::string quantity{};
    std::optional<std::pair<std::string, NumberId>> at{};
    std::vector<NumberId> pose{};
    NumberId at_least = 0;
  };
  std::vector<Parameter> parameters{};
  std::vector<std::pair<analysis::CriticalRequirement, std::optional<NumberId>>>
      critical{};                                     ///< without their numbers; none: infinite
  std::optional<analysis::CurveRequirement> curve{};  ///< without its numbers
  std::vector<std::pair<NumberId, NumberId>> points{};
  NumberId tolerance = 0;
  std::optional<analysis::ConstantRequirement> constant{};  ///< without its numbers
  NumberId from = 0, to = 0, within = 0;
  std::optional<NumberId> mean_at_least{};
  std::vector<Stiffness> stiffness{};
  analysis::ChangeNorm changes = analysis::ChangeNorm::norm;
  NumberId starts = 0;
};

/// The table `design` of a study of that kind; reports a missing one.
DesignDraft read_design(analysis::StudyKind kind, const TableReader& study, NumberTable& numbers,
                        Reading& reading);

void build_design(const DesignDraft& draft, const std::vector<double>& numbers,
                  analysis::DesignSettings& settings);

}  // namespace springfold::io
