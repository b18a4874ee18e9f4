#include "springfold/io/start_text.hpp"

#include <algorithm>

namespace springfold::io {
namespace {

/// The place of a part, or of what it belongs to.
std::string place_of(std::string part, const PlannedRun& planned) {
  while (true) {
    const auto at = std::find_if(planned.places.begin(), planned.places.end(),
                                 [&part](const PartPlace& entry) { return entry.part == part; });
    if (at != planned.places.end()) return at->place + ": ";
    if (part.empty()) return {};
    const std::size_t dot = part.rfind('.');
    part.resize(dot == std::string::npos ? 0 : dot);
  }
}

}  // namespace

std::string start_problem(const analysis::StartReport& start, const PlannedRun* planned) {
  const std::string& what = start.found ? start.outside : start.message;
  if (what.empty()) return {};
  return (planned && !start.where.empty() ? place_of(start.where, *planned) : "") + what +
         (start.advice.empty() ? "" : "; " + start.advice);
}

}  // namespace springfold::io
