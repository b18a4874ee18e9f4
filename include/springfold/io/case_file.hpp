// From a TOML case file to mechanisms and studies. Grammar: docs/case-file.md.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "springfold/analysis/study.hpp"

namespace springfold::io {

/// All mistakes of a case, each one as "file:line:col: key: what is wrong, what is needed [unit]".
class CaseError : public std::runtime_error {
 public:
  explicit CaseError(std::vector<std::string> messages);
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

/// Labels of the case's units, for tables and plots only: nothing is converted.
struct UnitLabels {
  std::string length = "m";
  std::string force = "N";
};

/// One study with one set of parameter values.
struct PlannedRun {
  std::string study{};
  int run = 1;          ///< 1, 2, ... along the study's `vary` list
  std::string label{};  ///< "Kv = 0.01", or empty
  model::Mechanism mechanism{};
  analysis::Study plan{};
  std::optional<analysis::ParameterFamily> family{};  ///< control mode parameter
  std::map<std::string, double> parameters{};         ///< all named parameters as used
};

/// One curve (or several) of a figure.
struct PlotCurves {
  std::string study{};
  std::vector<int> runs{};            ///< empty: all of the study
  std::vector<std::string> labels{};  ///< one per run; empty: the runs' own labels
};

struct PlotSpec {
  std::string name{};  ///< file name without ending
  std::string title{};
  std::string x = "deflection", y = "force";  ///< quantity names
  std::string x_label{}, y_label{};           ///< empty: made from quantity and unit
  double x_factor = 1, y_factor = 1;          ///< plotted value = factor * quantity
  std::vector<PlotCurves> curves{};
};

/// A published or closed-form value that a run is compared with.
struct ExpectedValue {
  std::string name{};   ///< as printed: "rho at Q1, Kv = 0.01"
  std::string group{};  ///< heading under which it is printed
  std::string study{};
  int run = 1;
  std::string at = "start";  ///< "start", "end", or an event label such as "LP1"
  std::string quantity{};    ///< a quantity name, or "count.LP" and the like
  double expected = 0;
  double tolerance = 0;  ///< absolute
  double factor = 1;     ///< compared value = factor * quantity
  std::string source{};
};

struct Expectations {
  std::vector<ExpectedValue> values{};
  std::vector<std::string> notes{};  ///< printed below the table
};

struct Case {
  std::filesystem::path file{};
  std::string title{};
  UnitLabels units{};
  std::vector<PlannedRun> runs{};
  std::vector<PlotSpec> plots{};
  Expectations expected{};
  std::string hash{};  ///< of the bytes of all files read and the overrides
  std::map<std::string, std::string> overrides{};
};

/// Reads and checks everything. `overrides` maps parameter names to numbers or formulas.
/// @throws CaseError with all mistakes of the stage at which it stopped
Case load_case(const std::filesystem::path& file,
               const std::map<std::string, std::string>& overrides = {});

}  // namespace springfold::io
