#include "stability_changes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>

#include "branch_rows.hpp"
#include "curve_chord.hpp"
#include "force_events.hpp"
#include "grow_diagram.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/core/hermite.hpp"
#include "springfold/core/rounding.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Direction;
using continuation::Hit;
using continuation::HitKind;

/// Points closer than this, relative to their size, are one.
constexpr double same_place = 1e-6;

/// Cosine of the angle within which a point's tangent is that of the branch between two of its points.
constexpr double one_way = 0.7;

class Watcher {
 public:
  explicit Watcher(const Following& with)
      : t_{with}, weights_{with.problem.metric()}, options_{options_of(with.study.trace).newton} {
    for (const QuantityDefinition& q : t_.quantities)
      if (q.kind == QuantityDefinition::Kind::index_force) force_ = &q;
  }

  void watch(Curve& curve) {
    if (force_ == nullptr) return;
    std::vector<CurvePoint> stations = curve.points;
    if (!curve.hits.empty() && curve.hits.back().stops) stations.push_back(curve.hits.back().point);
    for (const Hit& hit : curve.hits)
      for (const CurvePoint& side : hit.leaving) {
        if (hit.leaving.size() != 1) continue;  // there the trace ended
        stations.push_back(hit.point);
        stations.push_back(side);
      }
    std::stable_sort(stations.begin(), stations.end(), is_before<CurvePoint>);
    const CurvePoint* before = nullptr;
    std::optional<int> count;
    for (const CurvePoint& station : stations) {
      const auto next = count_at(station);
      if (next && before != nullptr && count && before->piece == station.piece && *next != *count)
        search(*before, station, *count, *next, curve);
      if (!next && before != nullptr && before->piece == station.piece) continue;
      before = &station;
      count = next;
    }
    std::stable_sort(curve.hits.begin(), curve.hits.end(), is_before<Hit>);
  }

  /// Counts beside a special point are those of the rows beside it: between two of them there must be one. It is solved
  /// to rounding where that can be: beside singular points the tolerance leaves more than what lies between.
  void part_hits(Curve& curve) const {
    continuation::NewtonOptions finest = options_;
    finest.residual_tolerance = few_roundings;
    std::vector<CurvePoint> more;
    const Hit* last = nullptr;
    for (const Hit& hit : curve.hits) {
      if (!is_special(hit)) continue;
      const Hit* const before = std::exchange(last, &hit);
      if (before == nullptr || before->kind == HitKind::unresolved ||
          hit.kind == HitKind::unresolved)
        continue;
      const CurvePoint& a = before->leaving.size() == 1 ? before->leaving.front() : before->point;
      const CurvePoint& b = hit.point;
      const bool are_parted =
          std::any_of(curve.points.begin(), curve.points.end(),
                      [&](const CurvePoint& point) { return point.s > a.s && point.s < b.s; });
      if (are_parted || a.piece != b.piece || !(b.s > a.s)) continue;
      auto point = point_at(a, b, 0.5, finest);
      if (!point) point = point_at(a, b, 0.5, options_);
      if (!point) continue;
      more.push_back(std::move(*point));
    }
    if (more.empty()) return;
    curve.points.insert(curve.points.end(), std::make_move_iterator(more.begin()),
                        std::make_move_iterator(more.end()));
    std::stable_sort(curve.points.begin(), curve.points.end(), is_before<CurvePoint>);
  }

 private:
  template <class Item>
  static bool is_before(const Item& a, const Item& b) {
    if constexpr (std::is_same_v<Item, Hit>)
      return a.point.s < b.point.s;
    else
      return a.s < b.s;
  }

  std::optional<int> count_at(const CurvePoint& point) const {
    const double value = t_.evaluator.value(*force_, point);
    return std::isnan(value) ? std::nullopt : std::optional{static_cast<int>(std::lround(value))};
  }

  /// The curve's point on the plane across the chord at a part of the way, from the cubic through both ends. Nothing
  /// where the point that is found has another direction: it is one of a branch that crosses.
  std::optional<CurvePoint> point_at(const CurvePoint& a, const CurvePoint& b, double part,
                                     const continuation::NewtonOptions& options) const {
    const CurveChord chord(t_.problem, {a.x, a.lambda}, {b.x, b.lambda});
    const double length = chord.length;
    if (!(length > 0)) return std::nullopt;
    const HermiteCubic<Vector> x{a.x, a.tangent.dx, b.x, b.tangent.dx, length};
    const HermiteCubic<double> lambda{a.lambda, a.tangent.dlambda, b.lambda, b.tangent.dlambda,
                                      length};
    const Direction way{x.slope_at(part), lambda.slope_at(part)};
    const auto solved = continuation::correct(t_.problem, weights_, x.at(part), lambda.at(part),
                                              a.piece, chord.border, options);
    continuation::Linearisation at;
    if (!continuation::converged(solved) || !chord.is_beside(solved.x, solved.lambda, part) ||
        !continuation::linearise(t_.problem, solved.x, solved.lambda, a.piece, at))
      return std::nullopt;
    const auto tangent = continuation::tangent_at(at, weights_, a.tangent);
    if (!tangent) return std::nullopt;
    const double size = std::sqrt(continuation::metric_product(weights_, way, way));
    if (!(continuation::metric_product(weights_, *tangent, way) > one_way * size))
      return std::nullopt;
    CurvePoint point = a;
    point.x = solved.x;
    point.lambda = solved.lambda;
    point.s = a.s + part * (b.s - a.s);
    point.tangent = *tangent;
    point.negative = continuation::negative_eigenvalues(at);
    return point;
  }

  /// Does the count change at the curve's own special points between the two, and nowhere else as far as it shows
  /// beside them?
  bool is_at_hits(const CurvePoint& a, const CurvePoint& b, int from, int to,
                  const Curve& curve) const {
    const Direction chord{b.x - a.x, b.lambda - a.lambda};
    const double square = continuation::metric_product(weights_, chord, chord);
    for (const Hit& hit : curve.hits) {
      if (!is_special(hit) || hit.point.piece != a.piece || !(hit.point.s > a.s) ||
          !(hit.point.s < b.s))
        continue;
      const Direction way{hit.point.x - a.x, hit.point.lambda - a.lambda};
      const double part = continuation::metric_product(weights_, way, chord) / square;
      const double aside = 0.5 * same_place / std::sqrt(square);
      if (!(part > aside) || !(part < 1 - aside)) continue;
      const auto before = point_at(a, b, part - aside, options_),
                 behind = point_at(a, b, part + aside, options_);
      if (!before || !behind) continue;
      if (count_at(*before) == from && count_at(*behind) == to) return true;
    }
    return false;
  }

  /// All places between two points at which the count goes from one value to the other.
  void search(const CurvePoint& a, const CurvePoint& b, int from, int to, Curve& curve) const {
    constexpr int most_places = 8, halvings = 60;
    if (is_at_hits(a, b, from, to, curve)) return;
    double begin = 0;
    for (int places = 0; places < most_places && from != to; ++places) {
      double low = begin, high = 1;
      int reached = to;
      std::optional<CurvePoint> at;
      for (int i = 0; i < halvings && high - low > 1e-15; ++i) {
        const double middle = low + (high - low) / 2;
        const auto trial = point_at(a, b, middle, options_);
        if (!trial) {
          // Beside the branch point at which the curve begins or ends there are no points: it changes there.
          const bool begins = low == 0 && a.s == curve.points.front().s;
          const bool ends = high == 1 && b.s == curve.points.back().s;
          if (begins || ends) return;
          break;
        }
        const auto count = count_at(*trial);
        at = trial;
        if (!count) break;  // singular to rounding: the place itself
        if (*count == from) {
          low = middle;
        } else {
          high = middle;
          reached = *count;
        }
      }
      if (!at) return;
      add(*at, from, reached, curve);
      begin = high;
      from = reached;
    }
  }

  /// Arc lengths are those of chords here: places are compared, not their s.
  bool is_at(const CurvePoint& a, const CurvePoint& b) const {
    const Direction way{a.x - b.x, a.lambda - b.lambda};
    return std::sqrt(continuation::metric_product(weights_, way, way)) <=
           same_place * std::max({1.0, a.x.lpNorm<Eigen::Infinity>(), std::abs(a.lambda)});
  }

  /// A curve may begin or end at a special point, which then is none of its hits.
  bool is_explained(const Curve& curve, const CurvePoint& point) const {
    if (is_at(point, curve.points.front()) || is_at(point, curve.points.back()) ||
        is_beside_branch_end(curve, point, t_.problem))
      return true;
    return std::any_of(curve.hits.begin(), curve.hits.end(),
                       [&](const Hit& hit) { return is_special(hit) && is_at(point, hit.point); });
  }

  static bool is_special(const Hit& hit) {
    return hit.kind != HitKind::user || hit.tag == force_limit || hit.tag == dead_load_change;
  }

  void add(const CurvePoint& point, int from, int to, Curve& curve) const {
    if (is_explained(curve, point)) return;
    Hit hit;
    hit.kind = HitKind::user;
    hit.tag = dead_load_change;
    hit.name = stability_mark + std::to_string(from) + " to " + std::to_string(to);
    hit.point = point;
    hit.s_before = hit.s_after = point.s;
    curve.hits.push_back(std::move(hit));
  }

  const Following& t_;
  Vector weights_;
  continuation::NewtonOptions options_;
  const QuantityDefinition* force_ = nullptr;
};

}  // namespace

void add_stability_changes(const Following& with, Curve& forward, Curve& backward) {
  const ControlMode control = with.study.control;
  const bool holds = control == ControlMode::pose || control == ControlMode::mixed;
  if (!with.problem.symmetric()) return;
  Watcher watcher(with);
  for (Curve* curve : {&forward, &backward}) {
    if (holds) watcher.watch(*curve);
    watcher.part_hits(*curve);
  }
}

}  // namespace springfold::analysis
