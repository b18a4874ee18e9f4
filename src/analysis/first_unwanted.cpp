#include "first_unwanted.hpp"

#include <algorithm>
#include <cmath>

#include "force_events.hpp"
#include "load_path.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/core/number_text.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::analysis {

namespace {

/// Does this column turn back there, as its rows on the path on both sides show? Where branches meet too, the point is
/// called after them.
bool turns_back(const Member& member, const BasePath& path, const SpecialPoint& point,
                const char* column) {
  const std::vector<Sample>& rows = path.branch.samples;
  const QuantityDefinition* quantity = member.quantity(column);
  if (quantity == nullptr || point.row == 0 || point.row + 1 >= rows.size()) return false;
  const auto i = static_cast<std::size_t>(quantity - member.quantities().data());
  const double here = rows[point.row].values[i];
  return (here - rows[point.row - 1].values[i]) * (rows[point.row + 1].values[i] - here) < 0;
}

}  // namespace

bool turns_back(const Member& member, const CriticalPointSettings& settings, const BasePath& path,
                const SpecialPoint& point) {
  CriticalPointSettings turns = settings;
  turns.unwanted = Unwanted::limit_point;
  return is_unwanted(member, turns, path, point);
}

bool is_unwanted(const Member& member, const CriticalPointSettings& settings, const BasePath& path,
                 const SpecialPoint& point) {
  const bool only_turns = settings.unwanted == Unwanted::limit_point;
  const bool of_force = point.hit.kind == continuation::HitKind::user;
  const bool dead = settings.stability == StabilityOf::dead_load;
  switch (point.kind) {
    case EventKind::limit_point:
      return dead || !of_force;
    case EventKind::corner_limit_point:
      return dead || point.hit.kind == continuation::HitKind::corner;
    case EventKind::branch_point:
    case EventKind::branching_kink:
      return !only_turns || turns_back(member, path, point, "lambda") ||
             (dead && (point.hit.tag == force_limit || turns_back(member, path, point, "force")));
    case EventKind::unresolved:
      return !only_turns || turns_back(member, path, point, "lambda") ||
             (dead && turns_back(member, path, point, "force"));
    case EventKind::stability_change:
    case EventKind::kinematic_singularity:
    case EventKind::switching: {
      const bool of_dead_load = point.kind == EventKind::stability_change;
      const QuantityDefinition* index = member.quantity(dead ? "index_force" : "index");
      if (only_turns || (of_dead_load && !dead) || index == nullptr ||
          point.row + 1 >= path.branch.samples.size())
        return false;
      const auto column = static_cast<std::size_t>(index - member.quantities().data());
      return path.branch.samples[point.row + 1].values[column] > 0;
    }
    default:
      return false;
  }
}

std::optional<Index> unstable_at_start(const Member& member,
                                       const CriticalPointSettings& settings) {
  const bool dead = settings.stability == StabilityOf::dead_load;
  const QuantityDefinition* index = member.quantity(dead ? "index_force" : "index");
  if (index == nullptr) return std::nullopt;
  return member.evaluator().unstable_modes(*index, member.start());
}

FirstUnwanted first_unwanted(const Member* member, const CriticalPointSettings& settings,
                             const Observer& observer) {
  FirstUnwanted first;
  if (member == nullptr) {
    first.why = "there is no start";
    first.has_start = false;
    return first;
  }
  // Stability that is not there cannot be lost.
  const bool only_turns = settings.unwanted == Unwanted::limit_point;
  if (const auto modes = unstable_at_start(*member, settings); !only_turns && modes && *modes > 0) {
    first.why = "the start is unstable itself, " + std::to_string(*modes) +
                (*modes == 1 ? " mode is" : " modes are") +
                ": stability is lost before the path begins";
    return first;
  }
  // What comes first is known where any point is met that is unwanted whatever lies behind it. Should the engine take
  // that back, the path is traced to its end.
  const auto enough = [only_turns](const continuation::Hit& hit) {
    using continuation::HitKind;
    return hit.kind == HitKind::limit_point || hit.kind == HitKind::corner ||
           (!only_turns &&
            (hit.kind == HitKind::branch_point || hit.kind == HitKind::branching_kink));
  };
  const auto find = [&](const BasePath& path) {
    const auto found = std::find_if(
        path.points.begin(), path.points.end(),
        [&](const SpecialPoint& p) { return is_unwanted(*member, settings, path, p); });
    if (found != path.points.end()) first.point = *found;
    return first.point.has_value();
  };
  BasePath path = load_path(*member, settings, observer, enough);
  if (find(path)) return first;
  if (path.is_enough) path = load_path(*member, settings, observer);
  if (find(path)) return first;
  const bool hides = std::any_of(path.points.begin(), path.points.end(), [](const SpecialPoint& p) {
    return p.kind == EventKind::unresolved;
  });
  if (!path.problem.empty() || !path.branch.forward.complete)
    first.why = path.problem.empty() ? path.branch.forward.reason : path.problem;
  else if (hides)
    first.why = "a point of the path is unresolved: limit points may lie there";
  return first;
}

void DoubtedValues::add(double value, const std::string& why) {
  const auto same = std::find_if(by_reason_.begin(), by_reason_.end(),
                                 [&](const auto& one) { return one.first == why; });
  if (same == by_reason_.end())
    by_reason_.emplace_back(why, std::vector<double>{value});
  else
    same->second.push_back(value);
}

void DoubtedValues::forget(const std::function<bool(double)>& known) {
  for (auto& one : by_reason_) std::erase_if(one.second, known);
  std::erase_if(by_reason_, [](const auto& one) { return one.second.empty(); });
}

std::vector<std::string> DoubtedValues::told(const std::string& parameter) const {
  std::vector<std::string> doubts;
  for (const auto& [why, values] : by_reason_) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    std::string place = "at " + parameter + " = " + rounded(*low);
    if (*low < *high)
      place += " to " + rounded(*high) + ", " + std::to_string(values.size()) + " values";
    doubts.push_back(place + ": " + why);
  }
  return doubts;
}

FirstUnwanted first_unwanted(const CaseCurves& curves, double mu,
                             const CriticalPointSettings& settings, const Observer& observer) {
  const Member* member = curves.at(mu);
  if (member == nullptr) return {.why = curves.why_none(mu), .has_start = false};
  return first_unwanted(member, settings, observer);
}

namespace {

/// The limit that ends a path before an unwanted point that lies just behind it; empty: no limit does.
std::string limit_on_the_way(const Member& member, const BasePath& path,
                             const CriticalPointSettings& settings, const Observer& observer) {
  // Where a path has just begun to end there it passes the limit by next to nothing: by what it moves within the
  // bracket of the value from which on it does so, 1e-11 of a range. A path that goes another way does not come back
  // for so little.
  constexpr double a_little = 1e-5;
  if (path.forward.stop != continuation::StopReason::event) return {};
  Study wider = member.study;
  for (Limit& limit : wider.until) {
    const double unit = member.quantity(limit.quantity)->scale;
    const auto more = [&](double edge) { return a_little * std::max(std::abs(edge), unit); };
    if (std::isfinite(limit.low)) limit.low -= more(limit.low);
    if (std::isfinite(limit.high)) limit.high += more(limit.high);
  }
  const BasePath beyond = load_path(member, settings, observer, {}, &wider);
  const bool comes =
      std::any_of(beyond.points.begin(), beyond.points.end(),
                  [&](const SpecialPoint& p) { return is_unwanted(member, settings, beyond, p); });
  return comes ? path.forward.stop_detail : std::string{};
}

/// The branch point beside which a path turns most sharply, if there is one for this value of the parameter and none a
/// little beside it: there branches cross, and to either side of it paths go different ways.
std::optional<continuation::CurvePoint> crossing_on_the_way(const CaseCurves& curves, double mu,
                                                            const BasePath& path, double range) {
  constexpr double a_little = 1e-3;  // of the range: by then branches have parted beyond doubt
  const std::vector<continuation::CurvePoint>& points = path.forward.points;
  const bool has_unknowns = !points.empty() && points.front().x.size() > 0;
  if (!has_unknowns) return std::nullopt;
  const Vector metric = curves.at(mu)->problem->metric();
  std::size_t sharpest = 0;
  double least = 1;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double cosine =
        continuation::metric_product(metric, points[i].tangent, points[i + 1].tangent);
    if (points[i].piece != points[i + 1].piece || !(cosine < least)) continue;
    least = cosine;
    sharpest = i;
  }
  const auto branch_point = [&](const continuation::CurvePoint& from, double value) {
    return continuation::polish_critical(curves.family(),
                                         {.kind = continuation::CriticalKind::branch_point,
                                          .x = from.x,
                                          .lambda = from.lambda,
                                          .mu = value,
                                          .piece = from.piece});
  };
  for (std::size_t i = sharpest; i < std::min(sharpest + 2, points.size()); ++i) {
    continuation::CurvePoint at = points[i];
    const auto found = branch_point(at, mu);
    if (!found) continue;
    const double reach = points[std::min(i + 1, points.size() - 1)].s - points[i > 0 ? i - 1 : 0].s;
    const continuation::Direction way{found->x - at.x, found->lambda - at.lambda};
    if (!(continuation::metric_product(metric, way, way) <= reach * reach)) continue;
    if (branch_point(at, mu - a_little * range) || branch_point(at, mu + a_little * range))
      continue;
    at.x = found->x;
    at.lambda = found->lambda;
    return at;
  }
  return std::nullopt;
}

}  // namespace

std::string why_path_misses(const CaseCurves& curves, double mu, double beside,
                            const FirstUnwanted& first, const CriticalPointSettings& settings,
                            const Observer& observer) {
  const Member* member = curves.at(mu);
  if (member != nullptr && !first.point && first.why.empty()) {
    const BasePath path = load_path(*member, settings, observer);
    const std::string limit = limit_on_the_way(*member, path, settings, observer);
    if (!limit.empty()) return ", as the path ends first: " + limit;
  }
  member = curves.at(beside);
  if (member == nullptr) return {};
  const BasePath path = load_path(*member, settings, observer);
  const double range = (settings.high - settings.low) / curves.scale();
  const auto crossing = crossing_on_the_way(curves, beside, path, range);
  if (!crossing) return {};
  member = curves.at(beside);
  const double lambda = member->evaluator().value(*member->quantity("lambda"), *crossing);
  return ", as branches cross on the way to it, at lambda = " + rounded(lambda);
}

bool ends_piece(continuation::Degeneracy kind) {
  using continuation::Degeneracy;
  switch (kind) {
    case Degeneracy::cusp:
    case Degeneracy::isola_centre:
    case Degeneracy::crossing:
    case Degeneracy::branch_points_merge:
    case Degeneracy::fold_meets_activation:
    case Degeneracy::corner_loses_reversal:
    case Degeneracy::touches_surface:
    case Degeneracy::two_switches:
    case Degeneracy::turn:
      return true;
    case Degeneracy::bends_other_way:
    case Degeneracy::hilltop:
    case Degeneracy::corank_two:
    case Degeneracy::extremum:
    case Degeneracy::user:
      return false;
  }
  return false;
}

}  // namespace springfold::analysis
