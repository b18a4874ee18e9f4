#include "design_modes.hpp"

#include <algorithm>
#include <cmath>

#include "first_unwanted.hpp"
#include "load_path.hpp"
#include "switching_starts.hpp"

namespace springfold::analysis {
namespace {

/// How far beside a design its modes are looked at, in the sizes of the parameters: rates are wrong by as much of their
/// own change, and modes are that far apart.
constexpr double step_aside = 0x1p-10;

/// Branch points, and those of the pieces beside springs that rest: one after the other on one branch.
bool is_mode(const DesignPath& path, const SpecialPoint& point) {
  return point.kind == EventKind::branch_point || way_at_rest(path.base(), point);
}

int modes_at(const DesignPath& path, const SpecialPoint& point) {
  const int pieces = way_at_rest(path.base(), point)
                         ? static_cast<int>(pieces_at_rest(path.base(), point).size())
                         : point.hit.multiplicity;
  return std::max(1, pieces);
}

FirstModes modes_of(const DesignPath& path, const CriticalRequirement& wanted,
                    const Observer& observer) {
  const CriticalPointSettings settings = settings_of(wanted);
  FirstModes found;
  found.path = load_path(path.path(), path.base(), settings, observer);
  for (const SpecialPoint& point : found.path.points) {
    if (!is_unwanted(path.base(), settings, found.path, point)) continue;
    const bool more = found.first.has_value();
    if (more && !(is_mode(path, point) && is_mode(path, *found.first))) break;
    if (!more) found.first = point;
    const auto reached = path.at_point(point, wanted.quantity);
    if (!reached || (more && !(reached->value >= found.modes.front().value))) break;
    const int count = modes_at(path, point);
    for (int i = 0; i < count && found.modes.size() < modes_together; ++i)
      found.modes.push_back(*reached);
  }
  return found;
}

bool knows_rates(const FirstModes& found) {
  return std::all_of(found.modes.begin(), found.modes.end(),
                     [](const Measure& mode) { return mode.rates.allFinite(); });
}

}  // namespace

CriticalPointSettings settings_of(const CriticalRequirement& wanted) {
  CriticalPointSettings settings;
  settings.unwanted = wanted.unwanted;
  settings.stability = wanted.stability;
  return settings;
}

FirstModes first_modes(const DesignCase& of, const Vector& values, const DesignPath& path,
                       const CriticalRequirement& wanted, const Observer& observer) {
  FirstModes found = modes_of(path, wanted, observer);
  const bool is_multiple = found.first && modes_at(path, *found.first) > 1;
  if (!is_multiple || knows_rates(found)) return found;
  // Every parameter by another amount: those of a symmetric structure do not move alike.
  Vector near = values;
  for (Index i = 0; i < near.size(); ++i)
    near[i] += step_aside * of.sizes[static_cast<std::size_t>(i)] / static_cast<double>(i + 1);
  DesignPath other(of, near);
  if (!other.has_start()) return found;
  other.trace(observer);
  const FirstModes apart = modes_of(other, wanted, observer);
  for (std::size_t i = 0; i < std::min(found.modes.size(), apart.modes.size()); ++i)
    found.modes[i].rates = apart.modes[i].rates;
  return found;
}

}  // namespace springfold::analysis
