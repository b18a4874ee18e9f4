#include "invariance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "judge.hpp"

namespace springfold::known_answers {
namespace {

using continuation::Curve, continuation::CurvePoint, continuation::Hit, continuation::HitKind;

struct Found {
  HitKind kind = HitKind::user;
  int multiplicity = 1;
  Vector z{};
  double lambda = 0, parameter = 0;
  double rounding = 0;  ///< of its place
};

using Events = std::vector<Found>;

void append(const Embedded& problem, const Draw& draw, const Curve& curve, Events& events) {
  for (const Hit& hit : curve.hits) {
    if (hit.kind == HitKind::user || hit.kind == HitKind::inexact) continue;
    const Vector z = problem.base_point(hit.point.x);
    const int count =
        hit.switches.empty() ? hit.multiplicity : static_cast<int>(hit.switches.size());
    events.push_back({hit.kind, count, z, hit.point.lambda, draw.parameter(z, hit.point.lambda),
                      place_rounding(problem, hit, curve)});
  }
}

void sort(Events& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const Found& a, const Found& b) { return a.parameter < b.parameter; });
}

Events events_of(const Embedded& problem, const Draw& draw, const std::vector<Curve>& curves) {
  Events events;
  for (const Curve& curve : curves) append(problem, draw, curve, events);
  sort(events);
  return events;
}

bool same(const Events& a, const Events& b, double tolerance) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double allowed = tolerance + 2 * (a[i].rounding + b[i].rounding);
    if (a[i].kind != b[i].kind || a[i].multiplicity != b[i].multiplicity ||
        !((a[i].z - b[i].z).norm() <= allowed) || !(std::abs(a[i].lambda - b[i].lambda) <= allowed))
      return false;
  }
  return true;
}

bool complete_curve(const Followed& followed) {
  return followed.refusal.empty() && followed.curves.size() == 2 &&
         std::all_of(followed.curves.begin(), followed.curves.end(), reached_end);
}

/// x and lambda of all points and special points, in the given unit.
std::vector<double> digits(const Followed& followed, double unit) {
  std::vector<double> list;
  const auto add = [&](const CurvePoint& p) {
    list.push_back(p.s);
    list.push_back(p.lambda);
    for (const double x : p.x) list.push_back(x / unit);
  };
  for (const Curve& curve : followed.curves) {
    for (const CurvePoint& p : curve.points) add(p);
    for (const Hit& hit : curve.hits) add(hit.point);
  }
  return list;
}

struct Comparison {
  const Embedded& problem;
  const Draw& draw;
  const Followed& first;
  Events events{};
  double tolerance = 0;
  bool tell = false;

  Same verdict(bool agrees, const Embedded& other, const Followed& followed) const {
    if (tell && !agrees) {
      std::printf("differs:\n");
      print(other, draw, followed, false);
    }
    return agrees ? Same::yes : Same::no;
  }
  Same agrees(const Embedded& other, const Followed& followed) const {
    return verdict(complete_curve(followed) &&
                       same(events, events_of(other, draw, followed.curves), tolerance),
                   other, followed);
  }

  Same stepping(double factor) const {
    continuation::TraceOptions options;
    options.step.initial *= factor;
    options.step.maximum *= factor;
    options.step.minimum *= factor;
    options.maximum_points = static_cast<int>(options.maximum_points * std::max(1.0, 1 / factor));
    return agrees(problem, follow(problem, draw, options));
  }

  Same changed(const Embedded& other) const { return agrees(other, follow(other, draw, {})); }

  /// From the last stored point of the first curve back to the other end.
  Same reversed() const {
    const Curve& there = first.curves.front();
    const CurvePoint& end = there.points.back();
    Followed back;
    back.curves.push_back(follow_ray(problem, draw, end.x, end.lambda,
                                     {end.piece, {-end.tangent.dx, -end.tangent.dlambda}}, {}));
    std::vector<Curve> known = first.curves;
    std::erase_if(known.front().hits, [&](const Hit& hit) { return hit.point.s > end.s; });
    const bool ended = reached_end(back.curves.front());
    return verdict(ended && same(events_of(problem, draw, known),
                                 events_of(problem, draw, back.curves), tolerance),
                   problem, back);
  }

  Same restarted(Random& random) const {
    const Curve& curve = first.curves[random() % 2];
    const CurvePoint& p = curve.points[random() % curve.points.size()];
    return agrees(problem, follow(problem, draw, p.x, p.lambda, p.piece, {}));
  }
};

}  // namespace

const char* name_of(Change change) {
  switch (change) {
    case Change::reversed:
      return "reversed";
    case Change::restarted:
      return "restarted at a stored point";
    case Change::steps_quarter:
      return "step limits x 1/4";
    case Change::steps_half:
      return "step limits x 1/2";
    case Change::steps_double:
      return "step limits x 2";
    case Change::steps_fourfold:
      return "step limits x 4";
    case Change::rotated:
      return "unknowns rotated";
    case Change::mirrored:
      return "unknowns mirrored";
    case Change::units_bitwise:
      return "units x 2^k, every bit";
    case Change::units_binary:
      return "units x 2^k, events";
    case Change::units_decimal:
      return "units x 10^+-6, events";
    case Change::forces_binary:
      return "equations x 2^k, events";
  }
  return "?";
}

Invariance check_invariance(const Embedded& problem, const Draw& draw, const Followed& followed,
                            Random& random, bool tell) {
  Invariance result;
  result.close = draw.blurred || draw.gap < 1e-3 || smallest_separation(draw) < may_be_cluster;
  result.same.fill(Same::not_compared);
  if (!complete_curve(followed)) return result;
  const Comparison compare{problem,
                           draw,
                           followed,
                           events_of(problem, draw, followed.curves),
                           1e-8 * std::max(1.0, draw.size),
                           tell};
  const auto set = [&](Change change, Same same) {
    if (tell && same == Same::no) std::printf("(that was: %s)\n", name_of(change));
    result.same[static_cast<std::size_t>(change)] = same;
  };
  set(Change::reversed, compare.reversed());
  set(Change::restarted, compare.restarted(random));
  set(Change::steps_quarter, compare.stepping(0.25));
  set(Change::steps_half, compare.stepping(0.5));
  set(Change::steps_double, compare.stepping(2));
  set(Change::steps_fourfold, compare.stepping(4));
  const Index n = problem.size();
  set(Change::rotated, compare.changed(problem.turned(random_orthogonal(n, 1, random))));
  set(Change::mirrored, compare.changed(problem.turned(random_orthogonal(n, -1, random))));
  const double unit =
      std::ldexp(1, choice(random, 2) ? 1 + choice(random, 20) : -1 - choice(random, 20));
  const Embedded binary = problem.in_units(unit);
  const Followed again = follow(binary, draw, {});
  set(Change::units_bitwise, digits(again, unit) == digits(followed, 1) ? Same::yes : Same::no);
  set(Change::units_binary, compare.agrees(binary, again));
  set(Change::units_decimal, compare.changed(problem.in_units(choice(random, 2) ? 1e6 : 1e-6)));
  set(Change::forces_binary, compare.changed(problem.with_forces(unit)));
  return result;
}

}  // namespace springfold::known_answers
