// The options of a run by name, for the manifest.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "springfold/io/case_file.hpp"

namespace springfold::io {

struct NamedOption {
  std::string name{};              ///< as in analysis::Study: "trace.maximum_step"
  nlohmann::ordered_json value{};  ///< as used
  bool is_default = false;         ///< the same as if it had not been given
};

/// Every option of the run's study.
std::vector<NamedOption> options_of(const PlannedRun& planned);

}  // namespace springfold::io
