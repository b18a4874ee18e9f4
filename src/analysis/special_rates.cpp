#include "special_rates.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/core/differences.hpp"

namespace springfold::analysis {
namespace {

/// Step of the six-point differences, where rates are of size 1.
constexpr double rate_step = 0x1p-9;

/// Where starts beside this one do not belong to it, as beside a limit point, steps are so much shorter, down to the least:
/// rounding costs as many digits.
constexpr double shorter = 0x1p-3, least_step = 0x1p-18;

}  // namespace

std::optional<Vector> rates_at_special(const CaseCurves& curves, const Member& base,
                                       const SpecialPoint& point, const StateValues& values,
                                       std::string* why_none) {
  std::string why;
  const auto start = critical_start(curves, base, point, why);
  if (why_none != nullptr) *why_none = why;
  return start ? rates_at_followed(curves, base, *start, values) : std::nullopt;
}

std::optional<Vector> rates_at_followed(const CaseCurves& curves, const Member& base,
                                        const continuation::CriticalStart& start,
                                        const StateValues& values) {
  const auto rate = critical_rate(curves.family(), start);
  if (!rate) return std::nullopt;
  const int sheet = base.sheet;
  bool same_sheet = true;
  const auto along = [&](double t) -> std::optional<Vector> {
    const Member* member = curves.at(start.mu + t);
    if (member == nullptr) return std::nullopt;
    same_sheet = same_sheet && member->sheet == sheet;
    return values(*member, {.x = rate->x + t * rate->dx,
                            .lambda = rate->lambda + t * rate->dlambda,
                            .piece = start.piece});
  };
  const double size = std::max({1.0, rate->dx.lpNorm<Eigen::Infinity>(), std::abs(rate->dlambda)});
  std::optional<Vector> found;
  for (double step = rate_step; step >= least_step; step *= shorter) {
    same_sheet = true;
    auto rates = six_point_derivative(along, 0, step / size);
    const bool belongs = rates && same_sheet;
    if (belongs || !found) found = std::move(rates);
    if (belongs) break;
  }
  if (found) *found /= curves.scale();
  return found;
}

std::optional<Vector> rates_at_start(const CaseCurves& curves, const StateValues& values) {
  const auto along = [&](double t) -> std::optional<Vector> {
    const Member* member = curves.at(curves.base().mu + t);
    if (member == nullptr) return std::nullopt;
    return values(*member, member->start());
  };
  auto found = six_point_derivative(along, 0, rate_step);
  if (found) *found /= curves.scale();
  return found;
}

StateValues column_values(std::vector<std::size_t> columns) {
  return [columns = std::move(columns)](
             const Member& member, const continuation::CurvePoint& point) -> std::optional<Vector> {
    Vector values(static_cast<Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i)
      values[static_cast<Index>(i)] =
          member.evaluator().value(member.quantities()[columns[i]], point);
    return values;
  };
}

}  // namespace springfold::analysis
