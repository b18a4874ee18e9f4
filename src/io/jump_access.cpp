#include "jump_access.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cycle_access.hpp"
#include "nothing.hpp"
#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "transition_access.hpp"

namespace springfold::io {
namespace {

using analysis::Jump;
using analysis::SnapState;
using analysis::StudyResult;

const std::string critical_prefix = "critical.", inertial_prefix = "inertial.";

/// Does the name read a column of another state than the landing?
bool has_prefix(const std::string& name) {
  return name.starts_with(critical_prefix) || name.starts_with(inertial_prefix) ||
         name.starts_with(saddle_prefix);
}

bool is_number(std::string_view text) {
  return !text.empty() && text.size() < 7 && text.front() != '0' &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// How far the lowest saddle beside the landing, or beside another state of the jump, lies above it.
double barrier_of(const Jump& jump, const SnapState& state) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < jump.others.size(); ++i)
    if (&jump.others[i] == &state) number = i + 1;
  const double height = number < jump.barriers.size() ? jump.barriers[number] : nothing;
  return std::isfinite(height) ? height : nothing;
}

double value_of(const StudyResult& result, const Jump& jump, const SnapState& state,
                const std::string& quantity) {
  const Jump* back =
      jump.back > 0 ? &result.snap->jumps[static_cast<std::size_t>(jump.back - 1)] : nullptr;
  if (quantity == "released") return jump.critical.energy - state.energy;
  if (quantity == "energy_before") return jump.critical.energy;
  if (quantity == "energy_after") return state.energy;
  if (quantity == "return") return back ? column_value(result, back->critical, "lambda") : nothing;
  if (quantity == "return_released") return back ? back->released : nothing;
  if (quantity == "loop") return jump.loop;
  if (quantity == "verdict") return static_cast<double>(jump.verdict);
  if (quantity == "states") return static_cast<double>(jump.others.size() + 1);
  if (quantity == "barrier") return barrier_of(jump, state);
  if (quantity == "time_scale") return jump.time_scale;
  if (quantity == "peak_speed") return jump.inertial ? jump.inertial->peak_speed : nothing;
  if (quantity == "peak_force") return jump.inertial ? jump.inertial->peak_force : nothing;
  if (quantity == "peak_moment") return jump.inertial ? jump.inertial->peak_moment : nothing;
  if (quantity == "duration") return jump.inertial ? jump.inertial->duration : nothing;
  if (quantity == "inertial_released") return jump.inertial ? jump.inertial->released : nothing;
  if (quantity == "dissipated") return jump.inertial ? jump.inertial->dissipated : nothing;
  if (quantity.starts_with(inertial_prefix))
    return jump.inertial ? column_value(result, jump.inertial->landing,
                                        quantity.substr(inertial_prefix.size()))
                         : nothing;
  if (quantity.starts_with(critical_prefix))
    return column_value(result, jump.critical, quantity.substr(critical_prefix.size()));
  return column_value(result, state, quantity);
}

/// The jump whose landing is nearest to these values, in units of how far landings spread.
const Jump* nearest(const StudyResult& result, const std::vector<NearValue>& near) {
  const auto& jumps = result.snap->jumps;
  std::vector<double> distance(jumps.size(), 0);
  for (const NearValue& wanted : near) {
    double low = wanted.value, high = wanted.value;
    std::vector<double> values;
    for (const Jump& jump : jumps) {
      values.push_back(value_of(result, jump, jump.landing, wanted.quantity));
      low = std::fmin(low, values.back());
      high = std::fmax(high, values.back());
    }
    for (std::size_t i = 0; i < jumps.size(); ++i) {
      const double d = std::abs(values[i] - wanted.value) / (high > low ? high - low : 1);
      distance[i] =
          std::max(distance[i], std::isnan(d) ? std::numeric_limits<double>::infinity() : d);
    }
  }
  const auto best = std::min_element(distance.begin(), distance.end());
  if (best == distance.end() || !std::isfinite(*best)) return nullptr;
  return &jumps[static_cast<std::size_t>(best - distance.begin())];
}

}  // namespace

bool is_jump_place(const std::string& at) {
  if (at == "J" || is_cycle_place(at) || is_transition_place(at)) return true;
  if (!at.starts_with('J')) return false;
  const std::size_t dot = at.find('.');
  return is_number(std::string_view{at}.substr(1, dot == std::string::npos ? dot : dot - 1)) &&
         (dot == std::string::npos || is_number(std::string_view{at}.substr(dot + 1)));
}

std::vector<std::string> jump_quantities() {
  return {"released",
          "energy_before",
          "energy_after",
          "return",
          "return_released",
          "loop",
          "verdict",
          "states",
          "barrier",
          "time_scale",
          "peak_speed",
          "peak_force",
          "peak_moment",
          "duration",
          "dissipated",
          "inertial_released",
          "jumps",
          "area",
          "gap",
          "energy_change",
          "loop_released",
          "closed",
          "transitions",
          "reached",
          "garden_of_eden",
          "memory",
          "low",
          "high",
          "up",
          "down",
          "up_released",
          "down_released",
          "escape",
          "barriers",
          "lowest_barrier",
          "complete",
          "alternatives"};
}

bool is_jump_quantity(const std::string& name) {
  const auto names = jump_quantities();
  return has_prefix(name) || std::find(names.begin(), names.end(), name) != names.end();
}

std::string jump_column(const std::string& name) {
  if (has_prefix(name)) return name.substr(name.find('.') + 1);
  return is_jump_quantity(name) ? "" : name;
}

double jump_value(const ExpectedValue& expected, const StudyResult& result) {
  if (!result.snap) return nothing;
  if (is_cycle_place(expected.at)) return cycle_value(expected, result);
  if (is_transition_place(expected.at)) return transition_value(expected, result);
  const auto& jumps = result.snap->jumps;
  const std::size_t dot = expected.at.find('.');
  const Jump* jump = nullptr;
  if (expected.at == "J") {
    jump = nearest(result, expected.near);
  } else {
    const std::string label = expected.at.substr(0, dot);
    for (const Jump& j : jumps)
      if (j.label == label) jump = &j;
  }
  if (jump == nullptr) return nothing;
  if (dot == std::string::npos) return value_of(result, *jump, jump->landing, expected.quantity);
  const auto other = static_cast<std::size_t>(std::stoi(expected.at.substr(dot + 1)));
  return other <= jump->others.size()
             ? value_of(result, *jump, jump->others[other - 1], expected.quantity)
             : nothing;
}

}  // namespace springfold::io
