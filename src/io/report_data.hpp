// What the HTML page shows, as JSON. Private to io.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"
#include "stability_parts.hpp"

namespace springfold::io {

/// Bytes of doubles (little-endian) as base64 (RFC 4648, with padding): read back without rounding.
std::string base64_of(const std::vector<double>& numbers);

/// JSON that may stand in an HTML script element: it has no "<".
std::string report_data(const Case& the_case, const std::vector<analysis::StudyResult>& results);

/// What a special point means for the mechanism, in a sentence or two.
/// @param is_load  the study puts on a load, otherwise it drives the mechanism
std::string explanation_of(analysis::EventKind kind, const Passage& passage, bool is_load);

}  // namespace springfold::io
