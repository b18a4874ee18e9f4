#include "special_rates.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "critical_starts.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {
namespace {

/// Step of the six-point differences, where rates are of size 1.
constexpr double rate_step = 0x1p-9;

/// Where starts beside this one do not belong to it, as beside a limit point, steps are so much shorter, down to the
/// least: rounding costs as many digits.
constexpr double shorter = 0x1p-3, least_step = 0x1p-18;

/// Relative difference of the slopes to both sides that steps of the least length leave of a smooth value.
constexpr double one_slope = 1e-4;

/// Values of members beside the base, nothing where there is none.
using ValuesAlong = std::function<std::optional<Vector>(const Member&, double)>;

/// Is undefined where the slopes to both sides differ.
void leave_out_kinks(const std::function<std::optional<Vector>(double)>& along, double step,
                     Vector& rates) {
  const auto here = along(0), above = along(step), below = along(-step);
  if (!here || !above || !below) return;
  for (Index i = 0; i < rates.size(); ++i) {
    const double up = ((*above)[i] - (*here)[i]) / step, down = ((*here)[i] - (*below)[i]) / step;
    if (std::abs(up - down) > one_slope * std::max({1.0, std::abs(up), std::abs(down)}))
      rates[i] = std::nan("");
  }
}

/// Where starts beside this one are on another piece, what is counted from them has a kink: shorter steps do not reach
/// it.
std::optional<Vector> rates_along(const CaseCurves& curves, const Member& base, double mu,
                                  const ValuesAlong& values, double size) {
  const int sheet = base.sheet;
  const Piece piece = base.first.piece;
  bool alike = true;
  const auto along = [&](double t) -> std::optional<Vector> {
    const Member* member = curves.at(mu + t);
    if (member == nullptr) return std::nullopt;
    alike = alike && member->sheet == sheet && member->first.piece == piece;
    return values(*member, t);
  };
  std::optional<Vector> found;
  bool belongs = false;
  for (double step = rate_step; step >= least_step && !belongs; step *= shorter) {
    alike = true;
    auto rates = six_point_derivative(along, 0, step / size);
    belongs = rates && alike;
    if (belongs || !found) found = std::move(rates);
  }
  if (found && !belongs) leave_out_kinks(along, least_step / size, *found);
  if (found) *found /= curves.scale();
  return found;
}

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
  const auto along = [&](const Member& member, double t) {
    return values(member, {.x = rate->x + t * rate->dx,
                           .lambda = rate->lambda + t * rate->dlambda,
                           .piece = start.piece});
  };
  const double size = std::max({1.0, rate->dx.lpNorm<Eigen::Infinity>(), std::abs(rate->dlambda)});
  return rates_along(curves, base, start.mu, along, size);
}

std::optional<Vector> rates_at_start(const CaseCurves& curves, const StateValues& values) {
  const auto along = [&](const Member& member, double) { return values(member, member.start()); };
  return rates_along(curves, curves.base(), curves.base().mu, along, 1);
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
