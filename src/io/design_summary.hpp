// The answer of a design study for people and for other programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "springfold/analysis/design.hpp"

namespace springfold::io {

/// Lines below the heading of a run.
std::string design_lines(const analysis::DesignReport& report);

/// Key `design` of a run in summary.json. Layout: docs/results.md.
nlohmann::ordered_json design_json(const analysis::DesignReport& report);

}  // namespace springfold::io
