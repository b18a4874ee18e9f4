#include "springfold/continuation/davidenko.hpp"

#include <algorithm>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cassert>
#include <cmath>
#include <numbers>

#include "continuation/following/davidenko_arc.hpp"
#include "continuation/following/many_points.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

constexpr double integration_error = function_noise;  ///< of one step, relative to max(1, |u_i|)
constexpr int order = 5;                              ///< of Dormand's and Prince's pair
constexpr double no_rate = exact_model;               ///< |dlambda/ds| below this has no sign

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
struct Watched {
  std::function<double(const CurvePoint&)> value{};
  Hit hit{};  ///< kind and name
  bool stops = false;
  double nothing = 0;  ///< smaller values have no sign
  int sign = 0;
};

std::vector<Watched> everything_to_watch(const std::vector<Event>& events, bool limit_points) {
  std::vector<Watched> all;
  if (limit_points) {
    const auto rate = [](const CurvePoint& point) { return point.tangent.dlambda; };
    all.push_back({.value = rate,
                   .hit = {.kind = HitKind::limit_point, .name = "limit point"},
                   .nothing = no_rate});
  }
  for (const Event& event : events)
    all.push_back({.value = event.value,
                   .hit = {.kind = HitKind::user, .name = event.name, .tag = event.tag},
                   .stops = event.action == EventAction::stop});
  return all;
}

/// Everything between two steps.
struct Walk {
  const Walker& walker;
  std::vector<Watched> watched{};
  CurvePoint here{};
  std::vector<Index> left{};  ///< switches that are zero at `here` and being left
  double h = 0;
  Curve curve{};
};

enum class Advance { go_on, shorten, stop };

Advance stop(Walk& walk, StopReason reason, std::string detail) {
  walk.curve.stop = reason;
  walk.curve.stop_detail = std::move(detail);
  return Advance::stop;
}

struct FlowEvent {
  Hit hit{};
  bool stops = false;
};

/// Changes of sign of one function between the samples.
/// @returns false where one could not be located
bool find_zeros_of(Watched& watched, const Walker& walker, const FlowArc& arc,
                   const std::vector<CurvePoint>& samples, std::vector<FlowEvent>& found) {
  std::size_t last = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const int sign = sign_of(watched.value(samples[k]), watched.nothing);
    if (sign == 0) continue;
    if (watched.sign * sign < 0) {
      const double a = samples[last].s - arc.from.s, b = samples[k].s - arc.from.s;
      const auto zero = zero_on_arc(walker, arc, a, b, watched.value);
      if (!zero) return false;
      Hit hit = watched.hit;
      hit.point = zero->point;
      hit.s_before = arc.from.s + zero->before;
      hit.s_after = arc.from.s + zero->after;
      found.push_back({std::move(hit), watched.stops});
    }
    watched.sign = sign;
    last = k;
  }
  return true;
}

/// Records what lies between the samples, in order.
Advance record(Walk& walk, const FlowArc& arc, const std::vector<CurvePoint>& samples,
               std::string& refusal) {
  std::vector<Watched> watched = walk.watched;  // a refused step leaves no trace
  std::vector<FlowEvent> found;
  for (Watched& w : watched)
    if (!find_zeros_of(w, walk.walker, arc, samples, found)) {
      refusal = "\"" + w.hit.name + "\" could not be located";
      return Advance::shorten;
    }
  walk.watched = std::move(watched);
  std::stable_sort(found.begin(), found.end(), [](const FlowEvent& a, const FlowEvent& b) {
    return a.hit.point.s < b.hit.point.s;
  });
  for (FlowEvent& f : found) {
    walk.curve.hits.push_back(std::move(f.hit));
    if (f.stops) return stop(walk, StopReason::event, walk.curve.hits.back().name);
  }
  return Advance::go_on;
}

/// Takes the only way out of a switching surface, if there is only one.
Advance leave_surface(Walk& walk, const ArcZero& met, double from) {
  const ProblemView problem = walk.walker.problem;
  const CurvePoint& arriving = met.point;
  Hit hit{.kind = HitKind::kink,
          .point = arriving,
          .switches = active_switches(walk.walker, arriving.x, arriving.lambda),
          .s_before = from + met.before,
          .s_after = from + met.after};
  hit.name = names_of(problem, hit.switches);
  Rays rays{.complete = false, .why = "too many switches act at one point"};
  if (hit.switches.size() <= 12)
    rays = rays_at(walk.walker, arriving.x, arriving.lambda, arriving.piece, hit.switches);
  for (const Ray& ray : rays.rays) {
    const bool back = ray.piece == arriving.piece &&
                      metric_product(walk.walker.weights, ray.tangent, arriving.tangent) < 0;
    if (!back) hit.leaving.push_back(point_on_ray(walk.walker, arriving, ray));
  }
  const std::size_t ways = hit.leaving.size();
  if (ways > 1) hit.kind = HitKind::branching_kink;
  if (ways == 1 && rays.complete) {
    walk.here = hit.leaving.front();
    walk.left = hit.switches;
    walk.h = std::min(walk.h, walk.walker.options.step.initial);
    if (sign_of(walk.here.tangent.dlambda) * sign_of(arriving.tangent.dlambda) < 0)
      hit.kind = HitKind::corner;
    for (Watched& watched : walk.watched)  // what jumps at a kink has no zero there
      if (const int sign = sign_of(watched.value(walk.here), watched.nothing)) watched.sign = sign;
  }
  walk.curve.hits.push_back(hit);
  if (ways == 0) return stop(walk, StopReason::no_way_out, "no way out at " + hit.name);
  if (ways > 1)
    return stop(walk, StopReason::several_ways, std::to_string(ways) + " ways out at " + hit.name);
  if (!rays.complete) return stop(walk, StopReason::several_ways, "unresolved kink: " + rays.why);
  return Advance::go_on;
}

/// The step itself: integrated and judged, then brought back onto the curve at four places.
/// @returns the start and these four; nothing if the step is refused
std::optional<std::vector<CurvePoint>> step(Walk& walk, FlowArc& arc, std::string& refusal) {
  const StepOptions& options = walk.walker.options.step;
  const double h = walk.h;
  const auto error = integrate(walk.walker, walk.here, h, arc);
  if (!error) {
    refusal = "the tangent is not defined somewhere on the step";
    walk.h = 0.5 * h;
    return std::nullopt;
  }
  const double factor = *error > 0
                            ? (1 - small_share) * std::pow(integration_error / *error, 1.0 / order)
                            : options.growth;
  walk.h = std::clamp(h * std::clamp(factor, aside_share, options.growth), 0.0, options.maximum);
  if (!(*error <= integration_error)) {
    refusal = "error of the integration " + rounded(*error);
    return std::nullopt;
  }
  std::vector<CurvePoint> samples{arc.from};
  for (int k = 1; k <= 4; ++k) {
    auto point = point_on_arc(walk.walker, arc, k < 4 ? k * h / 4 : h);
    if (!point) {
      refusal = "the end of the step is not close to the curve";
      walk.h = 0.5 * h;
      return std::nullopt;
    }
    samples.push_back(std::move(*point));
  }
  const double turn = std::acos(
      std::min(1.0, metric_product(walk.walker.weights, arc.from.tangent, samples.back().tangent)));
  if (!(turn <= options.turn)) {
    refusal = "tangent turned by " + rounded(turn * 180 / std::numbers::pi) + " deg";
    walk.h = 0.5 * h;
    return std::nullopt;
  }
  return samples;
}

Advance advance(Walk& walk, std::string& refusal) {
  const double h = walk.h;
  FlowArc arc;
  auto samples = step(walk, arc, refusal);
  if (!samples) return Advance::shorten;
  ArcSurface surface = first_surface(walk.walker, arc, *samples, walk.left);
  if (surface.met) {
    while (samples->back().s >= surface.met->point.s && samples->size() > 1) samples->pop_back();
    samples->push_back(surface.met->point);
  }
  refusal = surface.doubt;
  const Advance recorded =
      refusal.empty() ? record(walk, arc, *samples, refusal) : Advance::shorten;
  if (recorded == Advance::shorten) walk.h = 0.5 * h;
  if (recorded != Advance::go_on) return recorded;
  if (surface.met) return leave_surface(walk, *surface.met, arc.from.s);
  walk.here = std::move(samples->back());
  walk.left.clear();
  walk.curve.points.push_back(walk.here);
  return Advance::go_on;
}

}  // namespace

Curve davidenko(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                const std::vector<Event>& events, const TraceOptions& options,
                const StepObserver& observer) {
  check_entry(problem, x, lambda, start.piece, options);
  check_ray(problem, start);
  const Walker walker{problem, problem.metric(), options};
  Walk walk{walker, everything_to_watch(events, options.limit_points)};
  walk.here.x = x;
  walk.here.lambda = lambda;
  walk.here = point_on_ray(walker, walk.here, start);
  walk.left = active_switches(walker, x, lambda);
  walk.h = options.step.initial;
  for (Watched& watched : walk.watched)
    watched.sign = sign_of(watched.value(walk.here), watched.nothing);
  walk.curve.points = {walk.here};
  walk.curve.stop = StopReason::max_points;

  while (static_cast<int>(walk.curve.points.size()) < options.maximum_points) {
    const double from = walk.here.s, tried = walk.h;
    std::string refusal;
    const Advance outcome = advance(walk, refusal);
    if (outcome == Advance::stop) return std::move(walk.curve);
    if (outcome == Advance::shorten) {
      walk.curve.log.push_back({from, tried, refusal});
      if (walk.h >= options.step.minimum) continue;
      stop(walk, StopReason::step_too_small, refusal);
      return std::move(walk.curve);
    }
    walk.h = std::max(walk.h, options.step.minimum);
    if (observer && !observer(walk.here)) {
      stop(walk, StopReason::observer, "");
      return std::move(walk.curve);
    }
  }
  walk.curve.stop_detail = why_so_many(walk.walker, walk.curve);
  return std::move(walk.curve);
}

}  // namespace springfold::continuation
