#include "continuation/following/finished.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "continuation/locating/evidence.hpp"
#include "continuation/locating/tested_step.hpp"
#include "continuation/points/arc.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Steps shorter than this share of the longest are those of a narrow place.
constexpr double short_step = small_share;

/// Beside a branch that is nearer than this, tangents are too rough for a model that is continued.
constexpr double too_near = poor;

/// Branches that are so many times farther apart than rounding moves a point are told apart by every step.
constexpr double well_apart = 1000;

/// From how far off a narrow place is looked at: first so many times its length, at least so many of the longest steps;
/// then from half as far, and so on: a smooth curve fits a model at last, one with a kink does not, unless the place
/// fills it.
constexpr double times_its_length = 5, longest_steps = 2, nearest_lengths = 1.5;

/// A curve that has changed to another branch is off by about an eighth of what stands between them where it is looked
/// at; one that has not is off by what an interpolation leaves.
constexpr double changed = 0.02;

struct PointRange {
  std::size_t first = 0, last = 0;  ///< points
};

std::optional<Separation> separation(const Walker& walker, const Curve& curve, std::size_t i) {
  const CurvePoint &p = curve.points[i], &other = curve.points[i > 0 ? i - 1 : i + 1];
  const TestedStep arc(walker, p, std::abs(p.s - other.s));
  return separation_at(arc, p);
}

bool is_hidden(const Walker& walker, const Curve& curve, std::size_t i) {
  const auto s = separation(walker, curve, i);
  return !s || !(s->distance > std::max(well_apart * s->blur, too_near));
}

/// The shorter one of the steps that lead to and from a point.
double step_beside(const Curve& curve, std::size_t i) {
  const auto& points = curve.points;
  const double to = i > 0 ? points[i].s - points[i - 1].s : HUGE_VAL;
  return i + 1 < points.size() ? std::min(to, points[i + 1].s - points[i].s) : to;
}

/// Points that short steps lead to or from, beside another branch; up to their neighbours. Steps shorten as the other
/// branch comes near: the place is looked for where they are shortest, and from there as far as it goes.
std::vector<PointRange> hidden_stretches(const Walker& walker, const Curve& curve) {
  const double limit = short_step * walker.options.step.maximum;
  const std::size_t count = curve.points.size();
  const auto step = [&](std::size_t i) { return step_beside(curve, i); };
  const auto is_in_it = [&](std::size_t i) {
    return step(i) < limit && is_hidden(walker, curve, i);
  };
  std::vector<PointRange> found;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && step(i) > step(i - 1)) continue;
    if (i + 1 < count && step(i) > step(i + 1)) continue;
    if (!is_in_it(i)) continue;
    std::size_t first = i, last = i;
    while (first > 0 && is_in_it(first - 1)) --first;
    while (last + 1 < count && is_in_it(last + 1)) ++last;
    i = last;
    if (first > 0) --first;
    if (last + 1 < count) ++last;
    if (found.empty() || first > found.back().last) found.push_back({first, last});
    found.back().last = last;
  }
  return found;
}

/// The stored point nearest to s.
std::size_t nearest(const Curve& curve, double s) {
  const auto after = std::lower_bound(curve.points.begin(), curve.points.end(), s,
                                      [](const CurvePoint& p, double at) { return p.s < at; });
  auto i = static_cast<std::size_t>(after - curve.points.begin());
  if (i == curve.points.size() || (i > 0 && s - curve.points[i - 1].s < curve.points[i].s - s)) --i;
  return i;
}

bool one_piece(const Curve& curve, std::size_t first, std::size_t last) {
  const CurvePoint &a = curve.points[first], &b = curve.points[last];
  return a.piece == b.piece &&
         std::none_of(curve.hits.begin(), curve.hits.end(), [&](const Hit& h) {
           return !h.switches.empty() && h.point.s >= a.s && h.point.s <= b.s;
         });
}

/// Two points before the stretch and two behind it make a model; a point nearer to it on each side is compared.
/// @param far  from how far off
/// @returns nothing where the curve does not reach so far, or turns
std::optional<bool> is_smooth_across(const Walker& walker, const Curve& curve,
                                     const PointRange& stretch, double far) {
  const double a = curve.points[stretch.first].s, b = curve.points[stretch.last].s;
  if (a - far < curve.points.front().s || b + far > curve.points.back().s) return std::nullopt;
  const std::array<std::size_t, 6> at{nearest(curve, a - far),       nearest(curve, a - 0.5 * far),
                                      nearest(curve, a - far / 8),   nearest(curve, b + far / 8),
                                      nearest(curve, b + 0.5 * far), nearest(curve, b + far)};
  for (std::size_t i = 1; i < at.size(); ++i)
    if (at[i] <= at[i - 1]) return std::nullopt;
  if (!one_piece(curve, at.front(), at.back())) return std::nullopt;
  const auto point = [&](std::size_t i) -> const CurvePoint& { return curve.points[at[i]]; };
  const std::array<const CurvePoint*, 4> nodes{&point(0), &point(1), &point(4), &point(5)};
  ArcModel model;
  if (!model.go_through(walker.weights, point(1), nodes)) return std::nullopt;
  for (const std::size_t i : {2u, 3u}) {
    const auto s = separation(walker, curve, at[i]);
    const double off = distance_of(walker, model, point(1), point(i));
    if (s && off > changed * s->distance && off > between_samples * s->blur) return false;
  }
  return true;
}

/// What cannot be looked at from anywhere is not judged.
bool is_smooth_across(const Walker& walker, const Curve& curve, const PointRange& stretch) {
  const double length = curve.points[stretch.last].s - curve.points[stretch.first].s;
  double far = std::max(times_its_length * length, longest_steps * walker.options.step.maximum);
  bool seen = false;
  for (; far >= nearest_lengths * length; far *= 0.5) {
    const auto smooth = is_smooth_across(walker, curve, stretch, far);
    if (smooth && *smooth) return true;
    seen = seen || smooth;
  }
  return !seen;
}

}  // namespace

void check_narrow_places(const Walker& walker, Curve& curve) {
  if (walker.problem.structured() || !walker.options.branch_points) return;
  for (const PointRange& stretch : hidden_stretches(walker, curve)) {
    if (is_smooth_across(walker, curve, stretch)) continue;
    const CurvePoint &a = curve.points[stretch.first], &b = curve.points[stretch.last];
    Hit hit{.kind = HitKind::unresolved,
            .name =
                "unresolved: branches are so near to each other here that rounding may have led "
                "the curve from one to the other",
            .point = curve.points[(stretch.first + stretch.last) / 2],
            .s_before = a.s,
            .s_after = b.s};
    // Where the sign of an eigenvalue does not change on a curve that may have changed its branch, nothing is shown.
    std::erase_if(curve.hits, [&](const Hit& h) {
      return h.kind == HitKind::touch && h.point.s >= a.s && h.point.s <= b.s;
    });
    const auto behind = std::find_if(curve.hits.begin(), curve.hits.end(),
                                     [&](const Hit& h) { return h.point.s > hit.point.s; });
    curve.hits.insert(behind, std::move(hit));
  }
}

namespace {

/// The reason for which steps were refused most often from a place on, without the numbers in it.
std::string most_frequent_reason(const Curve& curve, double from) {
  std::map<std::string, int> counts;
  std::string most;
  for (const StepNote& note : curve.log) {
    if (note.s < from || note.reason.starts_with("cut: ")) continue;
    const std::string reason = note.reason.substr(0, note.reason.find_first_of("0123456789"));
    if (const int count = ++counts[reason]; most.empty() || count > counts[most]) most = reason;
  }
  while (!most.empty() && most.back() == ' ') most.pop_back();
  return most;
}

}  // namespace

std::string why_so_many(const Walker& walker, const Curve& curve) {
  const std::size_t n = curve.points.size(), first = (n - 1) - (n + 2) / 4;
  const CurvePoint &from = curve.points[first], &to = curve.points.back();
  const double length = to.s - from.s,
               step = length / std::max<double>(1, static_cast<double>(n - 1 - first));
  double by_lambda = 0;
  for (std::size_t i = first; i + 1 < n; ++i)
    by_lambda += std::abs(curve.points[i + 1].lambda - curve.points[i].lambda);
  const std::string far =
      std::to_string(n) + " points over an arc length of " + rounded(to.s) + "; ";
  const std::string more = "maximum_points allows more";
  if (step < walker.options.step.maximum / 3) {
    const std::string reason = most_frequent_reason(curve, from.s);
    return far + "the last steps were " + rounded(step) + " long" +
           (reason.empty() ? "" : ", shortened most often by \"" + reason + "\"") + ": " + more +
           ", a limit of the range ends the curve earlier";
  }
  constexpr double alone = 1 - negligible_share;
  const bool lambda_alone = by_lambda > alone * length;
  return far + "the last steps had full length" +
         (lambda_alone ? ", and hardly anything but lambda changed on them" : "") +
         ", the curve goes on: " + more + ", maximum_step longer steps, a limit of the range" +
         (lambda_alone ? " of lambda" : "") + " ends it";
}

}  // namespace springfold::continuation
