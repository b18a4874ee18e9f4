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

std::string with_place(const std::string& text, const PlannedRun* planned) {
  const std::string key = text.substr(0, text.find(": "));
  const bool has_key = planned != nullptr && !key.empty() && key != text &&
                       std::any_of(planned->places.begin(), planned->places.end(),
                                   [&key](const PartPlace& entry) { return entry.part == key; });
  return has_key ? place_of(key, *planned) + text.substr(key.size() + 2) : text;
}

}  // namespace springfold::io
