#include "springfold/continuation/between.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include "continuation/points/arc.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/normalised.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/stretches.hpp"

namespace springfold::continuation {
namespace {

/// Part of a curve on one piece, from one of its points to another.
struct PointGap {
  CurvePoint from{}, to{};
  std::optional<CurvePoint> middle{};  ///< where one is known between them
  bool counted = false;  ///< the ends' number of negative eigenvalues holds between them as well
  /// The one special point in it, if there is one: the ends' numbers hold up to it and from there on.
  std::optional<double> change{};
  bool goes_on = false;  ///< `from` is the end of the gap before, on one smooth curve
};

/// The gaps of a curve, filled one after the other. Within one the curve is a function of the way along the tangent
/// where it begins.
class Filler {
 public:
  using Nodes = std::vector<const CurvePoint*>;

  Filler(const Walker& walker, double spacing, Between& result)
      : walker_{walker}, spacing_{spacing}, result_{result} {}

  /// @param around  further points of the smooth curve that the gap lies on, the nearest ones first
  void fill(const PointGap& gap, const Nodes& around) {
    gap_ = &gap;
    length_ = way(gap.to);
    const double h = gap.to.s - gap.from.s;
    if (!(length_ > 0) || !(h > 0)) return;
    per_s_ = length_ / h;
    // Not at the ends themselves: those are rows already.
    const double first = std::floor(gap.from.s / spacing_ + one_place) + 1;
    const double last = std::ceil(gap.to.s / spacing_ - one_place) - 1;
    if (!(first <= last)) return;
    Nodes nodes = nodes_of(around);
    ArcModel curve = model_of({&gap.from, &gap.to});
    const bool wide = nodes.size() > few;
    if (wide) curve = model_of(nodes);
    if (curve.empty()) return one_by_one(curve, first, last);
    const CurvePoint* middle = known_middle();
    if (!middle && wide && is_exact_at(curve, {0.5})) return on_curve(curve, first, last);
    std::optional<CurvePoint> found;
    if (!middle && (found = inner_point(curve, 0.5 * length_))) middle = &*found;
    if (!middle || !is_of_gap(*middle)) return one_by_one(curve, first, last);
    if (wide) {
      nodes.insert(nodes.begin() + 2, middle);
      curve = model_of(nodes);
      if (is_exact_at(curve, {0.25, 0.75})) return on_curve(curve, first, last);
    }
    between(gap.from, *middle, gap.to, first, last, 0);
  }

 private:
  /// A model through no more nodes than this is not compared with the one without the last.
  static constexpr std::size_t few = 5;
  /// Where the quintic is off by e at two nodes more, the polynomial through all five, of degree nine, is
  /// off by about e^(10/6): on a smooth curve each order more brings the same factor.
  static constexpr double nearly_exact = one_place;
  static constexpr int deepest = 24;
  /// Cosine of a turn up to which polynomials of the way along a tangent converge fast.
  static constexpr double little_turned = 1 - small_share;

  double way(const CurvePoint& p) const { return way_to(walker_.weights, gap_->from, p); }
  double way_of(double k) const { return (k * spacing_ - gap_->from.s) * per_s_; }

  ArcModel model_of(const Nodes& nodes) const {
    ArcModel model;
    model.interpolate(walker_.weights, gap_->from, nodes);
    return model;
  }

  const CurvePoint* known_middle() const {
    const double t = gap_->middle ? way(*gap_->middle) : 0;
    return t > 0 && t < length_ ? &*gap_->middle : nullptr;
  }

  /// The gap's ends, and points of the curve around it, as far as it turns little: a quarter of a turn away it is no
  /// function of the way any more, and polynomials see that from afar.
  Nodes nodes_of(const Nodes& around) const {
    const CurvePoint& from = gap_->from;
    Nodes nodes{&from, &gap_->to};
    for (const CurvePoint* p : around) {
      const bool ahead = metric_product(walker_.weights, p->tangent, from.tangent) > little_turned;
      if (ahead && (p->s < from.s ? way(*p) < 0 : way(*p) > length_)) nodes.push_back(p);
    }
    return nodes;
  }

  /// Is it, as far as the polynomial without the last node shows? @param shares  of the gap, where both differ most
  bool is_exact_at(const ArcModel& curve, std::initializer_list<double> shares) {
    return !curve.empty() && std::all_of(shares.begin(), shares.end(), [&](double share) {
      Vector fewer;
      curve.evaluate(share * length_, fewer, rate_, 1);
      curve.evaluate(share * length_, u_, rate_);
      return is_exact((u_ - fewer).lpNorm<Eigen::Infinity>(), u_.lpNorm<Eigen::Infinity>());
    });
  }

  /// The points first...last between the outer two of three nodes.
  void between(const CurvePoint& a, const CurvePoint& m, const CurvePoint& b, double first,
               double last, int depth) {
    if (!(first <= last)) return;
    const ArcModel curve = model_of({&a, &m, &b});
    constexpr double few_places = 3;
    if (last - first < few_places) return one_by_one(curve, first, last);
    double error = 0;
    std::optional<CurvePoint> inner[2];
    for (int i = 0; i < 2; ++i) {
      const double t = 0.5 * (way(m) + way(i == 0 ? a : b));
      if (!curve.empty()) inner[i] = inner_point(curve, t);
      if (!inner[i] || !is_of_gap(*inner[i]) || depth > deepest)
        return one_by_one(curve, first, last);
      curve.evaluate(t, u_, rate_);
      const Index n = u_.size() - 1;
      error = std::max({error, (inner[i]->x - u_.head(n)).lpNorm<Eigen::Infinity>(),
                        std::abs(inner[i]->lambda - u_[n])});
    }
    const double scale = std::max({1.0, m.x.lpNorm<Eigen::Infinity>(), std::abs(m.lambda)});
    if (error <= exact_model * scale) return on_curve(curve, first, last);
    if (error <= nearly_exact * scale)
      return on_curve(model_of({&a, &*inner[0], &m, &*inner[1], &b}), first, last);
    const double seam = std::floor((way(m) / per_s_ + gap_->from.s) / spacing_);
    between(a, *inner[0], m, first, std::min(seam, last), depth + 1);
    between(m, *inner[1], b, std::max(seam + 1, first), last, depth + 1);
  }

  /// Points on a polynomial that is exact: checked, not corrected.
  void on_curve(const ArcModel& curve, double first, double last) {
    for (double k = first; k <= last; ++k) {
      CurvePoint point = on_model(curve, k);
      const bool inside = walker_.problem.residual(point.x, point.lambda, point.piece, F_);
      const double scale =
          std::max({1.0, point.x.lpNorm<Eigen::Infinity>(), std::abs(point.lambda)});
      // Within the tolerance in the caller's units too, which the engine's are near to.
      const bool small =
          inside && F_.lpNorm<Eigen::Infinity>() <=
                        small_share * walker_.options.newton.residual_tolerance * scale;
      if (!small || !gap_->counted) {
        one_by_one(curve, k, k);
        continue;
      }
      point.negative = gap_->from.negative;
      result_.points.push_back(std::move(point));
    }
  }

  /// Points corrected from the model; where that is too poor, from the point before along its tangent.
  void one_by_one(const ArcModel& curve, double first, double last) {
    std::optional<CurvePoint> before;
    for (double k = first; k <= last; ++k) {
      const double t = way_of(k);
      std::optional<CurvePoint> point;
      if (!curve.empty()) point = corrected(on_model(curve, k), std::min(t, length_ - t));
      if (!point) point = walked(before ? *before : gap_->from, t);
      if (point && is_of_gap(*point)) {
        before = point;
        before->s = point->s = k * spacing_;
        result_.points.push_back(std::move(*point));
      } else {
        ++result_.missed;
      }
    }
  }

  /// The point of the curve beside a place on the step; nothing where it is farther from there than a share of the way
  /// to what is known. Newton's method may end on another curve, however far.
  std::optional<CurvePoint> corrected(const CurvePoint& place, double known_in) const {
    std::optional<CurvePoint> point(place);
    if (!find_point(walker_, place.piece, gap_->from.tangent, *point) ||
        length_of(walker_, difference(*point, place)) > near_share * known_in)
      point.reset();
    return point;
  }

  /// The point at a way along the gap, from one before it in steps as short as they must be.
  std::optional<CurvePoint> walked(CurvePoint here, double t) const {
    constexpr int most = 60;
    double step = t - way(here);
    for (int i = 0; i < most; ++i) {
      const double ahead = metric_product(walker_.weights, here.tangent, gap_->from.tangent);
      if (!(ahead > 0)) return std::nullopt;
      CurvePoint place = here;
      place.x += step / ahead * here.tangent.dx;
      place.lambda += step / ahead * here.tangent.dlambda;
      auto next = corrected(place, step / ahead);
      if (!next) {
        step /= 2;
        continue;
      }
      here = std::move(*next);
      const double left = t - way(here);
      if (left <= one_place * length_) return here;
      step = std::min(2 * step, left);
    }
    return std::nullopt;
  }

  /// Where another branch is nearer than the model is exact, the corrector may find that. A point with another number
  /// of negative eigenvalues than its place in the gap asks for is not of this curve.
  bool is_of_gap(const CurvePoint& point) const {
    std::optional<Index> expected;
    if (gap_->counted) expected = gap_->from.negative;
    if (gap_->change && std::abs(point.s - *gap_->change) > told_apart)
      expected = point.s < *gap_->change ? gap_->from.negative : gap_->to.negative;
    return !expected || !point.negative || point.negative == expected;
  }

  std::optional<CurvePoint> inner_point(const ArcModel& curve, double t) const {
    auto point = point_near(walker_, curve, gap_->from, t);
    if (!point) return point;
    CurvePoint place;
    curve.point(walker_.weights, gap_->from, t, place);
    if (length_of(walker_, difference(*point, place)) > near_share * std::min(t, length_ - t))
      return std::nullopt;
    point->s = gap_->from.s + t / per_s_;
    return point;
  }

  CurvePoint on_model(const ArcModel& curve, double k) const {
    CurvePoint point;
    curve.point(walker_.weights, gap_->from, way_of(k), point);
    point.s = k * spacing_;
    return point;
  }

  const Walker& walker_;
  double spacing_, length_ = 0, per_s_ = 1;
  const PointGap* gap_ = nullptr;
  Between& result_;
  Vector u_{}, rate_{}, F_{};
};

/// The gaps between a curve's points.
/// @param counts  numbers of negative eigenvalues are known
std::vector<PointGap> gaps_of(const std::vector<Stretch>& stretches, const Curve& curve,
                              bool counts) {
  std::vector<PointGap> gaps;
  const auto add = [&](const CurvePoint& from, const CurvePoint& to, bool goes_on) {
    std::vector<double> special;
    bool is_place = true;  // not a stretch
    for (const Hit& hit : curve.hits)
      if (hit.kind != HitKind::user && hit.point.s >= from.s && hit.point.s <= to.s) {
        special.push_back(hit.point.s);
        is_place = is_place && hit.kind != HitKind::unresolved && hit.kind != HitKind::family;
      }
    const bool counted =
        special.empty() && from.negative == to.negative && (from.negative || !counts);
    const bool one = special.size() == 1 && is_place;
    gaps.push_back({from, to, std::nullopt, counted,
                    one ? std::optional(special.front()) : std::nullopt, goes_on});
  };
  for (const Stretch& stretch : stretches) {
    // Between pieces, without a kink that was found.
    if (!gaps.empty() && gaps.back().to.s < stretch.front().s)
      add(gaps.back().to, stretch.front(), true);
    for (std::size_t i = 1; i < stretch.size(); ++i) add(stretch[i - 1], stretch[i], i > 1);
  }
  return gaps;
}

/// Ends of the gaps before and behind on the same smooth curve, and points between them, the nearest ones first, as
/// many as a polynomial can use: with more of them rounding of the tangents grows faster than the error falls.
std::vector<const CurvePoint*> points_around(const std::vector<PointGap>& gaps, std::size_t i) {
  constexpr std::size_t most = 7;
  std::vector<const CurvePoint*> before, behind, points;
  for (std::size_t k = i; before.size() < most && gaps[k].goes_on;) {
    if (gaps[--k].middle) before.push_back(&*gaps[k].middle);
    before.push_back(&gaps[k].from);
  }
  for (std::size_t k = i + 1; behind.size() < most && k < gaps.size() && gaps[k].goes_on; ++k) {
    if (gaps[k].middle) behind.push_back(&*gaps[k].middle);
    behind.push_back(&gaps[k].to);
  }
  auto back = before.begin(), ahead = behind.begin();
  while (points.size() < most && (back != before.end() || ahead != behind.end())) {
    const double away = back != before.end() ? gaps[i].from.s - (*back)->s : infinity;
    const double along = ahead != behind.end() ? (*ahead)->s - gaps[i].to.s : infinity;
    points.push_back(away <= along ? *back++ : *ahead++);
  }
  return points;
}

/// Each of the points, in the order of s, belongs to the gap that it lies in.
void put_middles(const Walker& walker, const Normalised& own,
                 const std::vector<CurvePoint>& middles, std::vector<PointGap>& gaps) {
  auto middle = middles.begin();
  for (PointGap& gap : gaps) {
    while (middle != middles.end() && middle->s <= gap.from.s) ++middle;
    if (middle == middles.end()) return;
    if (!(middle->s < gap.to.s && middle->piece == gap.from.piece)) continue;
    gap.middle = own.inside(*middle);
    gap.middle->tangent = direction_seen_from(walker, gap.from.x, *gap.middle);
    gap.middle->x = gap.from.x + between(walker, gap.from, *gap.middle).dx;
  }
}

}  // namespace

Between points_between(ProblemView problem, const Curve& curve, double spacing,
                       const TraceOptions& options) {
  return points_between(problem, curve, {}, spacing, options);
}

Between points_between(ProblemView problem, const Curve& curve,
                       const std::vector<CurvePoint>& middles, double spacing,
                       const TraceOptions& options) {
  if (!(spacing > 0)) throw std::invalid_argument("spacing: must be positive");
  check_curve(problem, curve);
  Between result;
  if (curve.points.empty()) return result;
  const CurvePoint& start = curve.points.front();
  const Normalised own(problem, start.x, start.lambda, start.piece);
  const Walker walker{own, own.metric(), options};
  Filler filler(walker, spacing, result);
  std::vector<PointGap> gaps =
      gaps_of(smooth_stretches(walker, own, curve), curve, problem.symmetric());
  put_middles(walker, own, middles, gaps);
  try {
    for (std::size_t i = 0; i < gaps.size(); ++i) filler.fill(gaps[i], points_around(gaps, i));
  } catch (const Interrupted&) {  // those up to here are points of the curve
  }
  for (CurvePoint& point : result.points) point = own.outside(std::move(point));
  return result;
}

}  // namespace springfold::continuation
