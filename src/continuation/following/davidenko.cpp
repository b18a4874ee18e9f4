#include "springfold/continuation/davidenko.hpp"

#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "continuation/following/finished.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

constexpr double integration_error = function_noise;  ///< of one step, relative to max(1, |u_i|)
constexpr int order_of_pair = 5;                      ///< of Dormand's and Prince's pair
constexpr double no_rate = exact_model;               ///< |dlambda/ds| below this has no sign
constexpr double largest_return =
    root_of_rounding;  ///< farther from the curve the flow is not trusted

using Value = std::function<double(const CurvePoint&)>;

/// From one point of the curve along the flow, arc lengths t = 0 to h from there.
struct FlowArc {
  CurvePoint from{};
  double h = 0;
  std::function<Vector(double t)> dense{};  ///< (x, lambda), near the curve; n + 1 entries
};

/// Unit tangent at u = (x, lambda), on or beside the curve, oriented like that of `from`.
std::optional<Direction> flow_at(const Walker& walker, const Vector& u, const CurvePoint& from) {
  const Index n = u.size() - 1;
  Linearisation linear;
  if (!linearise(walker.problem, u.head(n), u[n], from.piece, linear)) return std::nullopt;
  return tangent_at(linear, walker.weights, from.tangent);
}

/// Point of the curve at arc length t, brought back from the dense output.
/// @returns nothing where that is too far away
std::optional<CurvePoint> point_on_arc(const Walker& walker, const FlowArc& arc, double t) {
  if (t == 0) return arc.from;
  const Vector u = arc.dense(t);
  const Index n = u.size() - 1;
  const auto border = flow_at(walker, u, arc.from);
  CurvePoint point{.s = arc.from.s + t, .x = u.head(n), .lambda = u[n]};
  if (!border || !find_point(walker, arc.from.piece, *border, point)) return std::nullopt;
  const double off =
      std::max((point.x - u.head(n)).lpNorm<Eigen::Infinity>(), std::abs(point.lambda - u[n]));
  if (!(off <= largest_return * std::max(1.0, u.lpNorm<Eigen::Infinity>()))) return std::nullopt;
  return point;
}

/// Zero of a function between the arc lengths a and b from arc.from.
std::optional<Located> zero_on_arc(const Walker& walker, const FlowArc& arc, double a, double b,
                                   const Value& value) {
  return locate([&](double t) { return point_on_arc(walker, arc, t); }, a, b,
                walker.options.location_tolerance * arc.h, value);
}

/// Where the arc meets its first switching surface.
struct ArcSurface {
  std::optional<Located> met{};
  std::string doubt{};  ///< set: a shorter step is needed; why
};

/// Values of the switches on the side of the point's piece, and their slopes along the curve.
struct SwitchSides {
  Vector values{}, slopes{};
};

std::optional<SwitchSides> sides_of(ProblemView problem, const CurvePoint& point) {
  SwitchSides sides;
  Matrix dg_dx;
  Vector dg_dlambda;
  if (!problem.switches(point.x, point.lambda, sides.values) ||
      !problem.switch_gradients(point.x, point.lambda, dg_dx, dg_dlambda))
    return std::nullopt;
  sides.slopes = dg_dx * point.tangent.dx + point.tangent.dlambda * dg_dlambda;
  for (Index j = 0; j < sides.values.size(); ++j) {
    sides.values[j] *= point.piece[static_cast<std::size_t>(j)];
    sides.slopes[j] *= point.piece[static_cast<std::size_t>(j)];
  }
  return sides;
}

/// Where switch j leaves its side between two samples, or dips below zero and comes back.
ArcSurface surface_between(const Walker& walker, const FlowArc& arc, const CurvePoint& a,
                           const CurvePoint& b, Index j, bool left) {
  const std::string doubt = "close to " + walker.problem.switch_name(j);
  const auto read = [&walker, j](Vector SwitchSides::*what) {
    return [&walker, j, what](const CurvePoint& point) {
      const auto sides = sides_of(walker.problem, point);
      return sides ? ((*sides).*what)[j] : not_a_number;
    };
  };
  const Value value = read(&SwitchSides::values), slope = read(&SwitchSides::slopes);
  double begin = a.s - arc.from.s, end = b.s - arc.from.s;
  if (!(value(b) < 0)) {
    if (!(slope(a) < 0 && slope(b) > 0)) return {.doubt = std::isnan(value(b)) ? doubt : ""};
    const auto lowest = zero_on_arc(walker, arc, begin, end, slope);
    if (!lowest) return {.doubt = doubt};
    if (!(value(lowest->point) < 0)) return {};
    end = lowest->point.s - arc.from.s;
  }
  if (left) {  // it starts at zero: begin where it is clearly on its side
    begin += tiny_share * (end - begin);
    const auto beside = point_on_arc(walker, arc, begin);
    if (!beside || !(value(*beside) > 0)) return {.doubt = doubt};
  }
  auto met = zero_on_arc(walker, arc, begin, end, value);
  if (!met) return {.doubt = doubt};
  return {.met = std::move(met)};
}

/// Where the arc meets its first switching surface.
/// @param samples  points of the arc in order, the first is arc.from
/// @param left  switches that are zero at arc.from because the curve leaves them there
ArcSurface first_surface(const Walker& walker, const FlowArc& arc,
                         const std::vector<CurvePoint>& samples, const std::vector<Index>& left) {
  for (std::size_t k = 1; k < samples.size(); ++k) {
    ArcSurface first;
    for (Index j = 0; j < walker.problem.switch_count(); ++j) {
      const bool leaves = k == 1 && std::find(left.begin(), left.end(), j) != left.end();
      ArcSurface next = surface_between(walker, arc, samples[k - 1], samples[k], j, leaves);
      if (!next.doubt.empty()) return next;
      if (next.met && (!first.met || next.met->point.s < first.met->point.s))
        first = std::move(next);
    }
    if (first.met) return first;
  }
  return {};
}

/// Integrates the flow over the arc length h.
/// @returns the relative error of the step, nothing where the tangent is not defined
std::optional<double> integrate(const Walker& walker, const CurvePoint& from, double h,
                                FlowArc& arc) {
  using State = std::vector<double>;
  struct Step {  // all that the dense output needs
    boost::numeric::odeint::runge_kutta_dopri5<State> stepper{};
    State u_0{}, rate_0{}, u_h{}, rate_h{};
  };
  const auto state_of = [](const Vector& x, double lambda) {
    State u(x.begin(), x.end());
    u.push_back(lambda);
    return u;
  };
  const auto vector_of = [](const State& u) -> Vector {
    return Eigen::Map<const Vector>(u.data(), static_cast<Index>(u.size()));
  };
  Step step;
  step.u_0 = state_of(from.x, from.lambda);
  step.rate_0 = state_of(from.tangent.dx, from.tangent.dlambda);
  step.u_h = step.rate_h = step.u_0;
  State error = step.u_0;
  bool defined = true;
  const auto flow = [&](const State& u, State& rate, double) {
    const auto tangent = flow_at(walker, vector_of(u), from);
    defined = defined && tangent;
    rate = defined ? state_of(tangent->dx, tangent->dlambda) : State(u.size(), 0.0);
  };
  step.stepper.do_step(flow, step.u_0, step.rate_0, 0.0, step.u_h, step.rate_h, h, error);
  if (!defined) return std::nullopt;
  double worst = 0;
  for (std::size_t i = 0; i < error.size(); ++i)
    worst = std::max(worst, std::abs(error[i]) / std::max(1.0, std::abs(step.u_0[i])));
  arc.from = from;
  arc.h = h;
  arc.dense = [step = std::move(step), h, vector_of](double t) -> Vector {
    if (t == h) return vector_of(step.u_h);
    State u = step.u_0;
    step.stepper.calc_state(t, u, step.u_0, step.rate_0, 0.0, step.u_h, step.rate_h, h);
    return vector_of(u);
  };
  return worst;
}

int sign_of(double value, double nothing = 0) {
  return value > nothing ? 1 : value < -nothing ? -1 : 0;
}

/// A function whose changes of sign are special points, with the last sign that it had.
struct TestFunction {
  std::function<double(const CurvePoint&)> value{};
  Hit hit{};           ///< what they are
  double nothing = 0;  ///< smaller values have no sign
  int sign = 0;

  /// Where a curve begins, or begins again: what jumps at a kink has no zero there.
  void begin_at(const CurvePoint& point) {
    if (const int now = sign_of(value(point), nothing)) sign = now;
  }
};

std::vector<TestFunction> everything_to_watch(const std::vector<Event>& events, bool limit_points) {
  std::vector<TestFunction> all;
  if (limit_points) {
    const auto rate = [](const CurvePoint& point) { return point.tangent.dlambda; };
    all.push_back({.value = rate,
                   .hit = {.kind = HitKind::limit_point, .name = "limit point"},
                   .nothing = no_rate});
  }
  for (const Event& event : events)
    all.push_back({.value = event.value,
                   .hit = {.kind = HitKind::user,
                           .name = event.name,
                           .stops = event.action == EventAction::stop,
                           .tag = event.tag}});
  return all;
}

/// Everything between two steps.
struct Walk {
  const Walker& walker;
  std::vector<TestFunction> tests{};
  Progress progress{};
  Curve curve{};
};

Outcome stop(Walk& walk, StopReason reason, std::string detail) {
  walk.curve.stop = reason;
  walk.curve.stop_detail = std::move(detail);
  return Outcome::stop;
}

/// Changes of sign of one function between the samples.
/// @returns false where one could not be located
bool find_zeros_of(TestFunction& test, const Walker& walker, const FlowArc& arc,
                   const std::vector<CurvePoint>& samples, std::vector<Hit>& found) {
  double last = 0;
  for (const CurvePoint& sample : samples) {
    const int sign = sign_of(test.value(sample), test.nothing);
    if (sign == 0) continue;
    const double here = sample.s - arc.from.s;
    if (test.sign * sign < 0) {
      const auto zero = zero_on_arc(walker, arc, last, here, test.value);
      if (!zero) return false;
      found.push_back(test.hit);
      found.back().point = zero->point;
      found.back().s_before = arc.from.s + zero->before;
      found.back().s_after = arc.from.s + zero->after;
    }
    test.sign = sign;
    last = here;
  }
  return true;
}

/// Records what lies between the samples, in order.
Outcome record(Walk& walk, const FlowArc& arc, const std::vector<CurvePoint>& samples,
               std::string& refusal) {
  std::vector<TestFunction> tests = walk.tests;  // a refused step leaves no trace
  std::vector<Hit> found;
  for (TestFunction& w : tests)
    if (!find_zeros_of(w, walk.walker, arc, samples, found)) {
      refusal = "\"" + w.hit.name + "\" could not be located";
      return Outcome::shorten;
    }
  walk.tests = std::move(tests);
  sort_by_place(found);
  for (const Hit& hit : found) {
    walk.curve.hits.push_back(hit);
    if (hit.stops) return stop(walk, StopReason::event, hit.name);
  }
  return Outcome::go_on;
}

/// Takes the only way out of a switching surface, if there is only one.
Outcome leave_surface(Walk& walk, const Located& met) {
  const KinkSearch kink{.status = KinkSearch::Status::found,
                        .point = met.point,
                        .before = met.before,
                        .after = met.after,
                        .active = active_switches(walk.walker, met.point.x, met.point.lambda)};
  const double h = walk.progress.ds;
  const Outcome outcome = pass_kink(walk.walker, kink, walk.progress, walk.curve);
  if (outcome != Outcome::go_on) return outcome;
  walk.progress.ds = std::min(walk.progress.ds, h);
  for (TestFunction& test : walk.tests) test.begin_at(walk.progress.here);
  return outcome;
}

/// The step itself: integrated and judged, then brought back onto the curve at four places.
/// @returns the start and these four; nothing if the step is refused
std::optional<std::vector<CurvePoint>> step(Walk& walk, FlowArc& arc, std::string& refusal) {
  const StepOptions& options = walk.walker.options.step;
  const double h = walk.progress.ds;
  double& next = walk.progress.ds;
  const auto error = integrate(walk.walker, walk.progress.here, h, arc);
  if (!error) {
    refusal = "the tangent is not defined somewhere on the step";
    next = 0.5 * h;
    return std::nullopt;
  }
  const double factor =
      *error > 0 ? (1 - small_share) * std::pow(integration_error / *error, 1.0 / order_of_pair)
                 : options.growth;
  next = std::clamp(h * std::clamp(factor, aside_share, options.growth), 0.0, options.maximum);
  if (!(*error <= integration_error)) {
    refusal = "error of the integration " + rounded(*error);
    return std::nullopt;
  }
  std::vector<CurvePoint> samples{arc.from};
  for (int k = 1; k <= 4; ++k) {
    auto point = point_on_arc(walk.walker, arc, k < 4 ? k * h / 4 : h);
    if (!point) {
      refusal = "the end of the step is not close to the curve";
      next = 0.5 * h;
      return std::nullopt;
    }
    samples.push_back(std::move(*point));
  }
  const double turn = std::acos(
      std::min(1.0, metric_product(walk.walker.weights, arc.from.tangent, samples.back().tangent)));
  if (!(turn <= options.turn)) {
    refusal = "tangent turned by " + rounded(turn * 180 / std::numbers::pi) + " deg";
    next = 0.5 * h;
    return std::nullopt;
  }
  return samples;
}

Outcome advance(Walk& walk, std::string& refusal) {
  const double h = walk.progress.ds;
  FlowArc arc;
  auto samples = step(walk, arc, refusal);
  if (!samples) return Outcome::shorten;
  ArcSurface surface = first_surface(walk.walker, arc, *samples, walk.progress.left);
  if (surface.met) {
    while (samples->back().s >= surface.met->point.s && samples->size() > 1) samples->pop_back();
    samples->push_back(surface.met->point);
  }
  refusal = surface.doubt;
  const Outcome recorded =
      refusal.empty() ? record(walk, arc, *samples, refusal) : Outcome::shorten;
  if (recorded == Outcome::shorten) walk.progress.ds = 0.5 * h;
  if (recorded != Outcome::go_on) return recorded;
  if (surface.met) return leave_surface(walk, *surface.met);
  walk.progress.here = std::move(samples->back());
  walk.progress.left.clear();
  walk.curve.points.push_back(walk.progress.here);
  return Outcome::go_on;
}

}  // namespace

Curve davidenko(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                const std::vector<Event>& events, const TraceOptions& options,
                const StepObserver& observer) {
  check_entry(problem, x, lambda, start.piece, options);
  check_ray(problem, start);
  check_events(events);
  const Walker walker{problem, problem.metric(), options};
  Walk walk{walker, everything_to_watch(events, options.limit_points)};
  Progress& progress = walk.progress;
  progress.here = point_on_ray(walker, {.x = x, .lambda = lambda}, start);
  progress.left = active_switches(walker, x, lambda);
  progress.ds = options.step.initial;
  for (TestFunction& test : walk.tests) test.begin_at(progress.here);
  walk.curve.points = {progress.here};
  walk.curve.stop = StopReason::max_points;

  while (static_cast<int>(walk.curve.points.size()) < options.maximum_points) {
    const double from = progress.here.s, tried = progress.ds;
    std::string refusal;
    const Outcome outcome = advance(walk, refusal);
    if (outcome == Outcome::stop) return std::move(walk.curve);
    if (outcome == Outcome::shorten) {
      walk.curve.log.push_back({from, tried, refusal});
      if (progress.ds >= options.step.minimum) continue;
      stop(walk, StopReason::step_too_small, refusal);
      return std::move(walk.curve);
    }
    progress.ds = std::max(progress.ds, options.step.minimum);
    if (observer && !observer(progress.here)) {
      stop(walk, StopReason::observer, "");
      return std::move(walk.curve);
    }
  }
  walk.curve.stop_detail = why_so_many(walk.walker, walk.curve);
  return std::move(walk.curve);
}

}  // namespace springfold::continuation
