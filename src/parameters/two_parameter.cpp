#include "springfold/parameters/two_parameter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "parameters/augmented.hpp"
#include "parameters/degeneracy.hpp"
#include "parameters/freed.hpp"
#include "parameters/held_modes.hpp"
#include "parameters/return_to_start.hpp"
#include "parameters/solve_augmented.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/stretches.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::continuation {
namespace {

/// Borders are renewed when a null vector is this much longer than its projection on them.
constexpr double poor_borders = 2.5;
/// Points of a curve nearer than this, in arc length, are the same.
constexpr double same_place = poor;

/// Orthonormal columns nearest to the given ones.
Matrix polar(const Matrix& columns) {
  const Svd svd = jacobi_svd(columns, SingularVectors::thin, SingularVectors::thin);
  return svd.U * svd.V.transpose();
}

/// Positive along growing mu. Where mu is stationary rounding must not decide it twice: there the largest entry does,
/// so that the two sides take one way each.
double sense_of(const Direction& tangent) {
  if (std::abs(tangent.dlambda) > root_of_rounding) return tangent.dlambda;
  Index largest = 0;
  for (Index i = 1; i < tangent.dx.size(); ++i)
    if (std::abs(tangent.dx[i]) > (1 + poor) * std::abs(tangent.dx[largest])) largest = i;
  return std::copysign(root_of_rounding, tangent.dx[largest]);
}

class Follower {
 public:
  Follower(const Family& family, CriticalStart start, const std::vector<CriticalEvent>& events,
           const TraceOptions& options, const std::function<bool(const CriticalPoint&)>& observer,
           const FurtherPoints& further)
      : family_{family},
        start_{std::move(start)},
        events_{events},
        options_{options},
        observer_{observer},
        further_{further} {
    options_.limit_points = false;  // turns of mu are events here: they are told apart
    options_.branch_points = false;
  }

  CriticalCurve follow(bool growing) {
    auto system = system_at(family_, start_);
    if (!system) return refused("the equations are not defined at the special point");
    const auto X = first_unknowns(*system);
    if (!X) return refused("the special point could not be located with the second parameter");
    if (system->unfolding(*X) > kept_within) return not_kept();
    Vector at = *X;
    double mu = start_.mu;
    std::optional<Direction> along;
    while (true) {
      const auto ray = way_out(*system, at, mu, along, growing);
      if (!ray) return std::move(curve_);
      if (!along) first_ = {.x = at, .lambda = mu, .tangent = ray->tangent};
      const bool renew = leg(*system, at, mu, *ray);
      if (!renew) break;
      along = last_.tangent;
      at = last_.x;
      mu = last_.lambda;
      const auto place = system->place(at, mu);
      if (!place) break;
      start_.x = at.head(system->n());
      system.emplace(family_, start_, NullVectors{polar(place->W), polar(place->V)});
    }
    tidy();
    return std::move(curve_);
  }

 private:
  CriticalCurve refused(std::string why) {
    curve_.stop = StopReason::bad_start;
    curve_.stop_detail = std::move(why);
    return std::move(curve_);
  }
  CriticalCurve not_kept() {
    curve_.kept = false;
    return refused(
        "the second parameter does not keep the branch: there is no curve of branch points");
  }

  /// Newton's method at the start's mu. Where mu is stationary there it is no parameter, and Newton's method fails
  /// or wanders off: a start that solves the equations is kept then.
  std::optional<Vector> first_unknowns(const Augmented& system) const {
    const Vector start = system.start_unknowns();
    auto X = solve_at(system, start, start_.mu);
    if (X && (*X - start).norm() <= same_place) return X;
    Vector F;
    const double size = std::max(1.0, start.lpNorm<Eigen::Infinity>());
    const bool solves = system.residual(start, start_.mu, F) &&
                        F.lpNorm<Eigen::Infinity>() <= options_.newton.residual_tolerance * size;
    return solves ? start : X;
  }

  std::optional<Ray> way_out(const Augmented& system, const Vector& X, double mu,
                             const std::optional<Direction>& along, bool growing) {
    const auto rays = rays_from(system, X, mu, {}, options_).rays;
    const Ray* best = nullptr;
    double largest = -infinity;
    for (const Ray& ray : rays) {
      const double forward = along ? metric_product(system.metric(), *along, ray.tangent)
                                   : (growing ? sense_of(ray.tangent) : -sense_of(ray.tangent));
      if (forward > largest) best = &ray;
      largest = std::max(largest, forward);
    }
    if (best != nullptr) return *best;
    curve_.stop_detail = "no curve leaves the special point";
    return std::nullopt;
  }

  /// One stretch with fixed borders. @returns whether another one follows
  bool leg(const Augmented& system, const Vector& X, double mu, const Ray& ray) {
    std::vector<Watch> watches = watches_of(system, events_);
    const Index n = system.n();
    const CurvePoint here{.x = X, .lambda = mu, .tangent = ray.tangent};
    for (Watch& watch : watches)
      if ((watch.kind == Degeneracy::user || watch.kind == Degeneracy::two_switches) &&
          !stand_on_one_side(system, watch, here)) {
        end_at_start(watch, here, n);
        return false;
      }
    std::vector<Event> events;
    for (std::size_t i = 0; i < watches.size(); ++i)
      events.push_back({.name = name_of(watches[i]),
                        .value = watches[i].value,
                        .action = watches[i].action,
                        .tag = static_cast<int>(i),
                        .noise = [of = watches[i].noise](const CurvePoint&) { return of; },
                        .of_place = watches[i].of_place});
    bool renew = false, lost = false, parted = false;
    ReturnToStart back{
        system, options_, first_, length_, {.x = X, .lambda = mu, .tangent = ray.tangent}};
    const auto observe = [&](const CurvePoint& point) {
      ++accepted_;
      if (back.with(point)) return false;
      if (observer_) {
        CriticalPoint now = critical_point(point, n);
        now.s += length_;
        if (!observer_(now)) return false;
      }
      parted = system.parting(point.x, point.lambda) > kept_within;
      lost = parted || system.unfolding(point.x) > kept_within;
      if (lost || accepted_ >= options_.maximum_points) return false;
      if (system.borders().left.cols() == 0) return true;
      const auto place = system.place(point.x, point.lambda);
      renew = !place || place->largest() > poor_borders;
      return !renew;
    };
    std::vector<CurvePoint> middles;
    Curve curve = trace_with_middles(system, X, mu, ray, events, options_, observe, middles);
    const bool broken = lost && system.unfolding(curve.points.back().x) > kept_within;
    if (lost) leave_out_last(curve);
    if (back.found()) close(*back.found(), curve);
    for (auto* points : {&curve.points, &middles})
      for (CurvePoint& point : *points) point.s += length_;
    for (Hit& hit : curve.hits) hit.point.s += length_;
    add(curve, further_points(system, curve, middles), watches, n);
    if (lost) {
      curve_.kept = false;
      curve_.stop_detail =
          parted && !broken ? "the second parameter parts the modes of this multiple branch point: "
                              "each has a curve of its own, from values beside this one"
                            : "the second parameter does not keep the branch";
    } else if (accepted_ >= options_.maximum_points) {
      curve_.stop = StopReason::max_points;
      curve_.stop_detail =
          std::string{to_string(StopReason::max_points)} + ": " + std::to_string(accepted_) +
          " points: maximum_points allows more, a larger maximum_step takes fewer; "
          "a parameter over several decades is better followed as an exponent";
    }
    last_ = curve.points.back();
    return renew && curve.stop == StopReason::observer;
  }

  /// Where modes have parted no eigenvalue is zero; where the branch is not kept there are no equilibria.
  static void leave_out_last(Curve& curve) {
    if (curve.points.size() < 2) return;
    curve.points.pop_back();
    std::erase_if(curve.hits,
                  [end = curve.points.back().s](const Hit& hit) { return hit.point.s > end; });
  }

  static std::string name_of(const Watch& watch) {
    const std::string kind{to_string(watch.kind)};
    if (watch.kind == Degeneracy::user) return watch.name;
    return watch.name.empty() ? kind : kind + ": " + watch.name;
  }

  /// A value that is zero where a stretch begins has the sign, there and wherever it is zero to rounding, with which it
  /// leaves it: what defines the curve, or stands still along it, crosses nothing. @returns false where the way leads
  /// outside
  static bool stand_on_one_side(const Augmented& system, Watch& watch, const CurvePoint& here) {
    const double value = watch.value(here);
    if (!(std::abs(value) <= function_noise)) return true;
    CurvePoint ahead = here;
    ahead.x += told_apart * here.tangent.dx;
    ahead.lambda += told_apart * here.tangent.dlambda;
    // Where members have starts of their own, the tangent is known less well than a point.
    const auto corrected = solve_at(system, ahead.x, ahead.lambda);
    if (corrected && (*corrected - ahead.x).norm() <= told_apart * small_share)
      ahead.x = *corrected;
    const double there = watch.value(ahead);
    const bool leaves = std::abs(there) > told_apart * root_of_rounding + function_noise;
    const double inside = watch.inside != 0 ? watch.inside : 1;
    if (leaves && there * watch.inside < 0) return false;
    const double side = leaves ? std::copysign(function_noise, there) : inside * function_noise;
    watch.value = [of = std::move(watch.value), side](const CurvePoint& p) {
      const double at = of(p);
      return std::abs(at) <= function_noise ? side : at;
    };
    return true;
  }

  /// The way leads out of what the caller asks for: nothing of it is.
  void end_at_start(const Watch& watch, const CurvePoint& here, Index n) {
    CriticalPoint point = critical_point(here, n);
    point.s = length_;
    if (curve_.points.empty()) curve_.points.push_back(point);
    curve_.hits.push_back(
        {.kind = watch.kind, .name = watch.name, .point = std::move(point), .tag = watch.tag});
    curve_.stop = StopReason::event;
    curve_.stop_detail = name_of(watch);
  }

  /// The curve ends at its start, which its last step passes.
  static void close(const CurvePoint& start, Curve& curve) {
    curve.points.back() = start;
    std::erase_if(curve.hits, [&](const Hit& hit) { return hit.point.s > start.s; });
    curve.stop = StopReason::closed;
    curve.stop_detail = std::string{to_string(StopReason::closed)};
  }

  std::vector<CurvePoint> further_points(const Augmented& system, const Curve& curve,
                                         const std::vector<CurvePoint>& middles) {
    if (!(further_.spacing > 0) || curve.points.size() < 2) return {};
    const double count = (curve.points.back().s - curve.points.front().s) / further_.spacing;
    if (count > further_.most) {
      curve_.left_out += count;
      return {};
    }
    Between between = points_between(system, curve, middles, further_.spacing, options_);
    curve_.missed += between.missed;
    return std::move(between.points);
  }

  void add(const Curve& curve, const std::vector<CurvePoint>& further,
           const std::vector<Watch>& watches, Index n) {
    std::size_t f = 0;
    const auto add_further = [&](double until) {
      for (; f < further.size() && further[f].s < until; ++f)
        curve_.points.push_back(critical_point(further[f], n));
    };
    for (std::size_t i = curve_.points.empty() ? 0 : 1; i < curve.points.size(); ++i) {
      add_further(curve.points[i].s);
      curve_.points.push_back(critical_point(curve.points[i], n));
    }
    add_further(infinity);
    for (const Hit& hit : curve.hits) {
      if (hit.kind != HitKind::user) continue;
      const Watch& watch = watches[static_cast<std::size_t>(hit.tag)];
      CriticalHit found{.kind = watch.kind,
                        .name = watch.name,
                        .point = critical_point(hit.point, n),
                        .tag = watch.tag};
      if (watch.refine) found.kind = watch.refine(hit.point);
      if (found.kind == Degeneracy::corank_two) found.name.clear();
      if (watch.name_there) found.name = watch.name_there(hit.point);
      curve_.hits.push_back(std::move(found));
    }
    curve_.stop = curve.stop;
    curve_.stop_detail = curve.stop_detail;
    if (curve.stop == StopReason::event && !curve_.hits.empty()) {
      const CriticalHit& last = curve_.hits.back();
      curve_.stop_detail =
          last.kind == Degeneracy::user ? last.name : std::string{to_string(last.kind)};
    }
    if (!curve.points.empty()) length_ = curve.points.back().s;
  }

  /// At a cusp, and at a hilltop, lambda turns back too: that is no event of its own, and what lies between the two,
  /// which rounding tells apart, no point.
  void tidy() {
    const auto is_more = [](Degeneracy kind) {
      return kind == Degeneracy::cusp || kind == Degeneracy::isola_centre ||
             kind == Degeneracy::crossing || kind == Degeneracy::branch_points_merge ||
             kind == Degeneracy::touches_surface || kind == Degeneracy::turn ||
             kind == Degeneracy::hilltop;
    };
    // Where another mode vanishes it does so with the coordinate free, too.
    const auto again = std::unique(curve_.hits.begin(), curve_.hits.end(),
                                   [](const CriticalHit& a, const CriticalHit& b) {
                                     return a.kind == Degeneracy::corank_two && b.kind == a.kind &&
                                            b.point.s - a.point.s <= same_place;
                                   });
    curve_.hits.erase(again, curve_.hits.end());
    const std::vector<CriticalHit> all = curve_.hits;
    std::erase_if(curve_.hits, [&](const CriticalHit& hit) {
      // Another mode that takes no part in how the branch bends.
      if (hit.kind == Degeneracy::bends_other_way &&
          std::any_of(all.begin(), all.end(), [&](const CriticalHit& other) {
            return (other.kind == Degeneracy::corank_two ||
                    (other.kind == Degeneracy::hilltop && other.name != of_the_force)) &&
                   std::abs(other.point.s - hit.point.s) <= same_place;
          }))
        return true;
      const bool secondary = hit.kind == Degeneracy::extremum ||
                             hit.kind == Degeneracy::fold_meets_activation ||
                             hit.kind == Degeneracy::corner_loses_reversal;
      return secondary && std::any_of(all.begin(), all.end(), [&](const CriticalHit& other) {
               return is_more(other.kind) && std::abs(other.point.s - hit.point.s) <= same_place;
             });
    });
    if (curve_.points.size() < 3 || curve_.hits.size() == all.size()) return;
    const auto first = curve_.points.begin() + 1, last = curve_.points.end() - 1;
    const auto at_hit = [&](const CriticalPoint& p) {
      return std::any_of(all.begin(), all.end(), [&](const CriticalHit& hit) {
        return is_more(hit.kind) && std::abs(hit.point.s - p.s) <= same_place;
      });
    };
    curve_.points.erase(std::remove_if(first, last, at_hit), last);
  }

  const Family& family_;
  CriticalStart start_;
  const std::vector<CriticalEvent>& events_;
  TraceOptions options_;
  const std::function<bool(const CriticalPoint&)>& observer_;
  const FurtherPoints& further_;
  CriticalCurve curve_{};
  CurvePoint first_{}, last_{};
  double length_ = 0;
  int accepted_ = 1;
};

}  // namespace

CriticalCurve follow_critical(const Family& family, const CriticalStart& start, bool growing,
                              const std::vector<CriticalEvent>& events, const TraceOptions& options,
                              const std::function<bool(const CriticalPoint&)>& observer,
                              const FurtherPoints& further) {
  if (is_of_freed(start))
    return follow_freed(family, start, growing, events, options, observer, further);
  if (holds_modes(start))
    return follow_held(family, start, growing, events, options, observer, further);
  return Follower(family, start, events, options, observer, further).follow(growing);
}

}  // namespace springfold::continuation
