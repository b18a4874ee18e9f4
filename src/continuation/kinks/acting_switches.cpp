// Which switches act at a place of the curve, and which rest along a step.
#include <algorithm>
#include <cmath>

#include "continuation/kinks/kink.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

/// Of the accuracy to which kinks are placed: so far apart they are two.
constexpr double between_places = 100;

/// What rounding makes of the value of a switch at a kink, on the piece before it or on that behind; 0 where that is
/// not known.
double error_beside(const Walker& walker, const KinkSearch& kink, const Workspace::Switches& here,
                    Index j) {
  const auto error_at = [&](const CurvePoint& p) {
    const double error = error_of_value(walker, p, here.dg_dx, here.dg_dlambda, j);
    return std::isfinite(error) ? error : 0;
  };
  return std::max(error_at(kink.point), error_at(behind(kink.point, {&kink.met, 1})));
}

/// Is the threshold of a switch that is nearly zero at a kink elsewhere on the curve? A stiff spring that has just come
/// to act stays as near to its threshold as its force is small. Its value then follows from its rates: it is known
/// where it is zero, if it is more than rounding. What runs along its surface, or is led by rounding, acts here. A
/// switch that the step leaves was zero where it begins, however near that is; one that surely moves away from its
/// surface is not about to cross it.
bool is_zero_elsewhere(const Walker& walker, const CurvePoint& from, const KinkSearch& kink,
                       const Workspace::Switches& before, const Workspace::Switches& here, Index j,
                       bool was_left) {
  const double length = kink.point.s - from.s, change = here.g[j] - before.g[j];
  const double rate = sure_rate(walker, here, j, kink.point),
               rate_before = sure_rate(walker, before, j, from);
  const double side = from.piece[static_cast<std::size_t>(j)];
  if (std::min(side * rate, side * rate_before) > 0) return true;
  if (!(length > one_place || was_left) || rate == 0 || rate_before == 0) return false;
  constexpr double alike = 0.25;
  const bool follows =
      std::abs(0.5 * (rate + rate_before) * length - change) <= alike * std::abs(change) &&
      rate * rate_before > 0;
  if (!follows || was_left) return follows;
  return std::abs(here.g[j] / rate) > between_places * walker.options.simultaneous &&
         std::abs(here.g[j]) > error_beside(walker, kink, here, j);
}

}  // namespace

std::vector<Index> acting_at(const Walker& walker, const CurvePoint& from, const KinkSearch& kink,
                             const std::vector<Index>& left) {
  std::vector<Index> active = active_or_met(walker, kink);
  Workspace::Switches before, here;
  if (active.size() < 2 || !read_switches(walker, from, before) ||
      !read_switches(walker, kink.point, here))
    return active;
  std::erase_if(active, [&](Index j) {
    return j != kink.met &&
           is_zero_elsewhere(walker, from, kink, before, here, j, contains(left, j));
  });
  return active;
}

std::vector<Index> resting_switches(const Walker& walker, const CurvePoint& from,
                                    const CurvePoint& to) {
  std::vector<Index> resting;
  Workspace::Switches &first = walker.memory->at_from, &last = walker.memory->at_to;
  if (walker.problem.switch_count() == 0 || !(to.s > from.s) ||
      !walker.problem.switches(from.x, from.lambda, first.g) ||
      !walker.problem.switches(to.x, to.lambda, last.g))
    return resting;
  std::vector<Index> candidates;
  for (Index j = 0; j < first.g.size(); ++j)
    if (std::max(std::abs(first.g[j]), std::abs(last.g[j])) <= walker.options.simultaneous)
      candidates.push_back(j);
  if (candidates.empty() || !read_switches(walker, from, first) || !read_switches(walker, to, last))
    return resting;
  for (const Index j : candidates) {
    if (sure_rate(walker, first, j, from) != 0 || sure_rate(walker, last, j, to) != 0) continue;
    bool stays = true;
    for (const double share : uneven_shares<2>()) {
      const auto point = point_at(walker, from, share * (to.s - from.s));
      Vector g;
      stays = stays && point && walker.problem.switches(point->x, point->lambda, g) &&
              std::abs(g[j]) <= walker.options.simultaneous;
    }
    if (stays) resting.push_back(j);
  }
  return resting;
}

}  // namespace springfold::continuation
