#include "springfold/continuation/between.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include "continuation/points/coincide.hpp"
#include "continuation/points/normalised.hpp"
#include "continuation/points/step.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/stretches.hpp"

namespace springfold::continuation {
namespace {

/// Part of a curve on one piece, from one of its points to another.
struct PointGap {
  CurvePoint from{}, to{};
  const CurvePoint* middle = nullptr;  ///< where one is known between them
  bool counted = false;  ///< the ends' number of negative eigenvalues holds between them as well
  bool goes_on = false;  ///< `from` is the end of the gap before, on one smooth curve
};

/// The curve as a function of the way along the tangent at a stretch's begin.
struct Node {
  double t = 0;
  Vector u{};     ///< (x, lambda)
  Vector rate{};  ///< du/dt
};

/// The polynomial through some nodes and their rates, of degree five for three of them, in Newton's form:
///
///     u(t) = c_0 + (t - a) (c_1 + (t - a) (c_2 + (t - m) (c_3 + (t - m) (c_4 + (t - b) c_5))))
class Hermite {
 public:
  explicit Hermite(const std::vector<const Node*>& nodes) {
    const std::size_t order = 2 * nodes.size();
    for (std::size_t i = 0; i < order; ++i) knots_.push_back(nodes[i / 2]->t);
    c_.resize(nodes.front()->u.size(), static_cast<Index>(order));
    for (std::size_t i = 0; i < order; ++i) c_.col(static_cast<Index>(i)) = nodes[i / 2]->u;
    for (std::size_t k = 1; k < order; ++k)
      for (std::size_t i = order - 1; i >= k; --i) {
        const double width = knots_[i] - knots_[i - k];
        const auto here = static_cast<Index>(i);
        if (width != 0)
          c_.col(here) = (c_.col(here) - c_.col(here - 1)) / width;
        else
          c_.col(here) = nodes[i / 2]->rate;
      }
  }

  void evaluate(double t, Vector& u, Vector& rate) const {
    u = c_.rightCols(1);
    rate.setZero(u.size());
    for (Index i = c_.cols() - 2; i >= 0; --i) {
      const double away = t - knots_[static_cast<std::size_t>(i)];
      rate = u + away * rate;
      u = c_.col(i) + away * u;
    }
  }

  Index order() const { return c_.cols(); }  ///< twice the number of nodes

  /// Its place alone, or that of the polynomial through the first nodes. @param order  twice their number
  Vector at(double t, Index order) const {
    Vector u = c_.col(order - 1);
    for (Index i = order - 2; i >= 0; --i)
      u = c_.col(i) + (t - knots_[static_cast<std::size_t>(i)]) * u;
    return u;
  }
  Vector at(double t) const { return at(t, order()); }

 private:
  std::vector<double> knots_{};
  Matrix c_{};
};

class Filler {
 public:
  Filler(const Walker& walker, double spacing, Between& result)
      : walker_{walker}, spacing_{spacing}, result_{result} {}

  /// @param around  further points of the smooth curve that the stretch lies on, the nearest ones first
  void fill(const PointGap& stretch, const std::vector<CurvePoint>& around) {
    stretch_ = &stretch;
    const Direction chord{stretch.to.x - stretch.from.x, stretch.to.lambda - stretch.from.lambda};
    length_ = metric_product(walker_.weights, chord, stretch.from.tangent);
    const double h = stretch.to.s - stretch.from.s;
    if (!(length_ > 0) || !(h > 0)) return;
    per_s_ = length_ / h;
    // Not at the ends themselves: those are rows already.
    const double first = std::floor(stretch.from.s / spacing_ + one_place) + 1;
    const double last = std::ceil(stretch.to.s / spacing_ - one_place) - 1;
    if (!(first <= last)) return;
    const Node a = node_of(stretch.from, 0), b = node_of(stretch.to, length_);
    std::vector<Node> others = nodes_of(around);
    const auto wide = polynomial(a, b, others);
    const auto known = known_middle(stretch);
    if (!known && wide && is_exact_at(*wide, {0.5})) return on_curve(*wide, first, last);
    const double half = 0.5 * length_;
    const auto m =
        known ? known : node_near(half, wide ? wide->at(half) : between_ends(a, b), nullptr);
    if (m && wide) {
      others.insert(others.begin(), *m);
      const auto finer = polynomial(a, b, others);
      if (is_exact_at(*finer, {0.25, 0.75})) return on_curve(*finer, first, last);
    }
    if (m)
      between(a, *m, b, first, last, 0);
    else {
      const Node middle{half, between_ends(a, b), (b.u - a.u) / length_};
      one_by_one(Hermite({&a, &middle, &b}), first, last);
    }
  }

 private:
  /// Where the quintic is off by e at two nodes more, the polynomial through all five, of degree nine, is
  /// off by about e^(10/6): on a smooth curve each order more brings the same factor.
  static constexpr double nearly_exact = one_place;
  static constexpr int deepest = 24;
  /// Cosine of a turn up to which polynomials of the way along a tangent converge fast.
  static constexpr double little_turned = 0.9;

  double way_of(double k) const { return (k * spacing_ - stretch_->from.s) * per_s_; }

  /// The cubic through the ends predicts the middle.
  Vector between_ends(const Node& a, const Node& b) const {
    return 0.5 * (a.u + b.u) + length_ / 8 * (a.rate - b.rate);
  }

  std::optional<Node> known_middle(const PointGap& stretch) const {
    if (stretch.middle == nullptr) return std::nullopt;
    const CurvePoint &p = *stretch.middle, &from = stretch.from;
    const double t = metric_product(walker_.weights, {p.x - from.x, p.lambda - from.lambda},
                                    stretch.from.tangent);
    if (!(t > 0 && t < length_)) return std::nullopt;
    return node_of(p, t);
  }

  /// Points of the curve around the stretch, as far as it turns little: a quarter of a turn away it is no function of t any
  /// more, and polynomials of t see that from afar.
  std::vector<Node> nodes_of(const std::vector<CurvePoint>& around) const {
    const CurvePoint& from = stretch_->from;
    std::vector<Node> nodes;
    for (const CurvePoint& p : around) {
      const Direction away{p.x - from.x, p.lambda - from.lambda};
      const double t = metric_product(walker_.weights, away, from.tangent);
      const bool ahead = metric_product(walker_.weights, p.tangent, from.tangent) > little_turned;
      if (ahead && (p.s < from.s ? t < 0 : t > length_)) nodes.push_back(node_of(p, t));
    }
    return nodes;
  }

  /// The polynomial through the stretch's ends and the nodes around it; nothing where there are few.
  static std::optional<Hermite> polynomial(const Node& a, const Node& b,
                                           const std::vector<Node>& others) {
    constexpr std::size_t few = 4;
    if (others.size() < few) return std::nullopt;
    std::vector<const Node*> nodes{&a, &b};
    for (const Node& node : others) nodes.push_back(&node);
    return Hermite(nodes);
  }

  /// Is it, as far as the polynomial without the last node shows? @param shares  of the stretch, where both differ most
  bool is_exact_at(const Hermite& curve, std::initializer_list<double> shares) const {
    return std::all_of(shares.begin(), shares.end(), [&](double share) {
      const Vector all = curve.at(share * length_);
      const Vector fewer = curve.at(share * length_, curve.order() - 2);
      return is_exact((all - fewer).lpNorm<Eigen::Infinity>(), all.lpNorm<Eigen::Infinity>());
    });
  }

  Node node_of(const CurvePoint& p, double t) const {
    const Index n = p.x.size();
    Node node{.t = t, .u = Vector(n + 1), .rate = Vector(n + 1)};
    node.u << p.x, p.lambda;
    set_rate(p, node);
    return node;
  }

  void set_rate(const CurvePoint& p, Node& node) const {
    const double along = metric_product(walker_.weights, p.tangent, stretch_->from.tangent);
    node.rate << p.tangent.dx, p.tangent.dlambda;
    node.rate /= along;
  }

  /// The curve's point nearest to a guess, within the plane across the tangent at the begin.
  std::optional<CurvePoint> corrected(const Vector& guess) const {
    const Index n = guess.size() - 1;
    return point_on_curve(walker_, guess.head(n), guess[n], stretch_->from.piece,
                          stretch_->from.tangent)
        .point;
  }

  /// @param rate  predicted; the tangent must be along it
  std::optional<Node> node_near(double t, const Vector& guess, const Vector* rate) const {
    const auto p = corrected(guess);
    if (!p) return std::nullopt;
    const Index n = p->x.size();
    Node node{.t = t, .u = Vector(n + 1), .rate = Vector(n + 1)};
    node.u << p->x, p->lambda;
    set_rate(*p, node);
    constexpr double other_direction = 0.5;
    if (rate && (node.rate - *rate).norm() > other_direction * rate->norm()) return std::nullopt;
    return node;
  }

  /// The points first...last between the outer two of three nodes.
  void between(const Node& a, const Node& m, const Node& b, double first, double last, int depth) {
    if (!(first <= last)) return;
    const Hermite curve({&a, &m, &b});
    constexpr double few = 3;
    if (last - first < few) return one_by_one(curve, first, last);
    Vector u, rate;
    double error = 0;
    std::optional<Node> inner[2];
    for (int i = 0; i < 2; ++i) {
      const double t = 0.5 * (m.t + (i == 0 ? a.t : b.t));
      curve.evaluate(t, u, rate);
      inner[i] = node_near(t, u, &rate);
      if (!inner[i] || depth > deepest) return one_by_one(curve, first, last);
      error = std::max(error, (inner[i]->u - u).lpNorm<Eigen::Infinity>());
    }
    const double scale = std::max(1.0, m.u.lpNorm<Eigen::Infinity>());
    if (error <= exact_model * scale) return on_curve(curve, first, last);
    if (error <= nearly_exact * scale)
      return on_curve(Hermite({&a, &*inner[0], &m, &*inner[1], &b}), first, last);
    const double seam = std::floor((m.t / per_s_ + stretch_->from.s) / spacing_);
    between(a, *inner[0], m, first, std::min(seam, last), depth + 1);
    between(m, *inner[1], b, std::max(seam + 1, first), last, depth + 1);
  }

  /// Points on a polynomial that is exact: checked, not corrected.
  void on_curve(const Hermite& curve, double first, double last) {
    for (double k = first; k <= last; ++k) {
      curve.evaluate(way_of(k), u_, rate_);
      const Index n = u_.size() - 1;
      CurvePoint point = started(k);
      point.x = u_.head(n);
      point.lambda = u_[n];
      const bool inside = walker_.problem.residual(point.x, point.lambda, point.piece, F_);
      const double scale = std::max(1.0, u_.lpNorm<Eigen::Infinity>());
      // Within the tolerance in the caller's units too, which the engine's are near to.
      const bool small =
          inside && F_.lpNorm<Eigen::Infinity>() <=
                        small_share * walker_.options.newton.residual_tolerance * scale;
      if (!small || !stretch_->counted) {
        one_by_one(curve, k, k);
        continue;
      }
      point.tangent = unit_direction(walker_, rate_);
      point.negative = stretch_->from.negative;
      result_.points.push_back(std::move(point));
    }
  }

  void one_by_one(const Hermite& curve, double first, double last) {
    for (double k = first; k <= last; ++k) {
      curve.evaluate(way_of(k), u_, rate_);
      auto point = corrected(u_);
      if (!point) {
        ++result_.missed;
        continue;
      }
      point->s = k * spacing_;
      result_.points.push_back(std::move(*point));
    }
  }

  CurvePoint started(double k) const {
    CurvePoint point;
    point.s = k * spacing_;
    point.piece = stretch_->from.piece;
    return point;
  }

  const Walker& walker_;
  double spacing_, length_ = 0, per_s_ = 1;
  const PointGap* stretch_ = nullptr;
  Between& result_;
  Vector u_{}, rate_{}, F_{};
};

bool is_kink(const Hit& hit) { return !hit.switches.empty(); }

bool changes_the_count(const Hit& hit) { return hit.kind != HitKind::user; }

/// The stretches of a curve: from point to point, parted at kinks, up to the event that ended it.
std::vector<PointGap> stretches_of(const Curve& curve, bool counts) {
  std::vector<PointGap> stretches;
  CurvePoint from = curve.points.front();
  bool special = false, goes_on = false;
  const auto up_to = [&](const CurvePoint& to) {
    const bool counted = !special && from.negative == to.negative;
    if (to.s > from.s)
      stretches.push_back({from, to, nullptr, counted && (from.negative || !counts), goes_on});
    goes_on = goes_on || to.s > from.s;
    special = false;
  };
  std::size_t h = 0;
  const auto take_hits = [&](double until) {
    for (; h < curve.hits.size() && curve.hits[h].point.s <= until; ++h) {
      const Hit& hit = curve.hits[h];
      special = special || changes_the_count(hit);
      const bool last = h + 1 == curve.hits.size() && hit.point.s > curve.points.back().s;
      if (!is_kink(hit) && !last) continue;
      up_to(hit.point);
      from = hit.leaving.empty() ? hit.point : hit.leaving.front();
      special = is_kink(hit);
      goes_on = false;
    }
  };
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    take_hits(curve.points[i].s);
    up_to(curve.points[i]);
    from = curve.points[i];
  }
  take_hits(infinity);
  return stretches;
}

/// Ends of the stretches before and behind on the same smooth curve, and points between them, the nearest ones first, as many
/// as a polynomial can use: with more of them rounding of the tangents grows faster than the error falls.
std::vector<const CurvePoint*> points_around(const std::vector<PointGap>& stretches,
                                             std::size_t i) {
  constexpr std::size_t most = 7;
  std::vector<const CurvePoint*> before, behind, points;
  for (std::size_t k = i; before.size() < most && stretches[k].goes_on;) {
    if (stretches[--k].middle) before.push_back(stretches[k].middle);
    before.push_back(&stretches[k].from);
  }
  for (std::size_t k = i + 1; behind.size() < most && k < stretches.size() && stretches[k].goes_on;
       ++k) {
    if (stretches[k].middle) behind.push_back(stretches[k].middle);
    behind.push_back(&stretches[k].to);
  }
  auto back = before.begin(), ahead = behind.begin();
  while (points.size() < most && (back != before.end() || ahead != behind.end())) {
    const double away = back != before.end() ? stretches[i].from.s - (*back)->s : infinity;
    const double along = ahead != behind.end() ? (*ahead)->s - stretches[i].to.s : infinity;
    points.push_back(away <= along ? *back++ : *ahead++);
  }
  return points;
}

/// Each of the points, in the order of s, belongs to the stretch that it lies in.
void put_middles(const std::vector<CurvePoint>& middles, std::vector<PointGap>& stretches) {
  auto middle = middles.begin();
  for (PointGap& stretch : stretches) {
    while (middle != middles.end() && middle->s <= stretch.from.s) ++middle;
    if (middle == middles.end()) return;
    if (middle->s < stretch.to.s && middle->piece == stretch.from.piece) stretch.middle = &*middle;
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
  std::vector<PointGap> stretches = stretches_of(curve, problem.symmetric());
  put_middles(middles, stretches);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    PointGap stretch = stretches[i];
    stretch.from = own.inside(stretch.from);
    // A closed curve may end at another copy of its start, whole periods away.
    const auto as_seen = [&](const CurvePoint& point) {
      CurvePoint p = own.inside(point);
      const Direction chord = between(walker, stretch.from, p);
      p.tangent = direction_seen_from(walker, stretch.from.x, p);
      p.x = stretch.from.x + chord.dx;
      return p;
    };
    stretch.to = as_seen(stretch.to);
    std::optional<CurvePoint> middle;
    if (stretch.middle != nullptr) stretch.middle = &middle.emplace(as_seen(*stretch.middle));
    std::vector<CurvePoint> around;
    for (const CurvePoint* point : points_around(stretches, i)) around.push_back(as_seen(*point));
    filler.fill(stretch, around);
  }
  for (CurvePoint& point : result.points) point = own.outside(std::move(point));
  return result;
}

}  // namespace springfold::continuation
