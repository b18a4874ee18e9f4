#include "limits.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "branch_rows.hpp"
#include "force_events.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {

namespace {

/// Rotation vectors are followed up to this length: at a whole turn they are singular.
constexpr double nearly_whole_turn = 2 * std::numbers::pi - 0.25;

/// Does a limit or mark name one of the three rotation vector entries that begin at z[first]?
bool is_watched(const Study& study, const std::vector<QuantityDefinition>& quantities,
                bool of_study_body, Index first) {
  const auto rotates = [&](const std::string& name) {
    for (const QuantityDefinition& q : quantities) {
      if (q.name != name) continue;
      if (q.kind == QuantityDefinition::Kind::unknown)
        return q.entry >= first && q.entry < first + 3;
      return of_study_body && q.kind == QuantityDefinition::Kind::deflection &&
             q.unit == Unit::angle;
    }
    return false;
  };
  return std::any_of(study.until.begin(), study.until.end(),
                     [&](const Limit& limit) { return rotates(limit.quantity); }) ||
         std::any_of(study.marks.begin(), study.marks.end(),
                     [&](const Mark& mark) { return rotates(mark.quantity); });
}

/// Points lie off the curve by as much as the residual's tolerance lets them, and so do the values of what is computed
/// from them, in the mechanism's own units: values that differ by less are the same. lambda is solved for as well:
/// along a family that lies at a limit it is what rounding leaves of it. What is given is exact.
double rounding_of(const QuantityDefinition& quantity, double value) {
  const bool is_set = quantity.kind == QuantityDefinition::Kind::arc_length ||
                      quantity.kind == QuantityDefinition::Kind::command;
  const double own = std::numeric_limits<double>::epsilon() * std::abs(value);
  return is_set ? own : std::max(own, off_curve_rate * std::abs(quantity.scale));
}

/// Bodies whose rotation is prescribed in part are described by rotation vectors; and limits on a
/// rotation vector have no meaning beyond a whole turn. The branch ends before, and says so.
void add_whole_turns(const Study& study, const Evaluator& evaluator,
                     const std::vector<QuantityDefinition>& quantities,
                     std::vector<continuation::Event>& events) {
  const PathProblem& problem = evaluator.problem();
  const statics::System& system = problem.layout();
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    if (system.mechanism.bodies[b].task_space != model::TaskSpace::spatial) continue;
    const Index first = system.body_slices[b].t + 3;
    const bool own = static_cast<Index>(b + 1) == study.body;
    const auto& free = problem.free_rotations();
    const bool is_free =
        std::any_of(free.begin(), free.end(), [b](const auto& r) { return r.body == b; });
    const bool held = own && problem.rule().N.cols() == 0;
    const bool vector = !is_free && !held;
    if (!vector && !is_watched(study, quantities, own, first)) continue;
    events.push_back(
        {"not followed further: body " + system.mechanism.bodies[b].name +
             (vector ? ", whose rotation is prescribed in part, comes near a whole turn"
                     : " comes near a whole turn, beyond which limits and marks on its "
                       "rotation have no meaning"),
         [&problem, first](const continuation::CurvePoint& point) {
           const Vector z = problem.expand(point.x, point.lambda);
           return z.segment<3>(first).norm() - nearly_whole_turn;
         },
         continuation::EventAction::stop, whole_turn});
  }
}

}  // namespace

std::vector<continuation::Event> events_of(const Study& study, const Evaluator& evaluator,
                                           const std::vector<QuantityDefinition>& quantities) {
  std::vector<continuation::Event> events;
  const auto add = [&](const std::string& name, double value, continuation::EventAction action,
                       std::string label) {
    const QuantityDefinition* q = find_quantity(quantities, name);
    assert(q != nullptr);
    const double unit = rounding_of(*q, value);
    events.push_back({std::move(label),
                      [&evaluator, definition = *q, value](const continuation::CurvePoint& point) {
                        return evaluator.value(definition, point) - value;
                      },
                      action, 0, [unit](const continuation::CurvePoint&) { return unit; }, true});
  };
  if (study.control == ControlMode::pose || study.control == ControlMode::mixed)
    events.push_back({"limit point of the force",
                      [&evaluator](const continuation::CurvePoint& point) {
                        return evaluator.force_rate(point).value;
                      },
                      continuation::EventAction::record, force_limit,
                      [&evaluator](const continuation::CurvePoint& point) {
                        return evaluator.force_rate(point).noise;
                      }});
  if (study.control == ControlMode::pose && evaluator.problem().symmetric() &&
      !evaluator.problem().structured())
    events.push_back(dead_load_event(evaluator));
  if (study.control == ControlMode::load && study.kind == StudyKind::force_deflection &&
      evaluator.problem().symmetric())
    events.push_back({driven_change_name,
                      [&evaluator](const continuation::CurvePoint& point) {
                        return evaluator.displacement_rate(point).value;
                      },
                      continuation::EventAction::record, driven_change,
                      [&evaluator](const continuation::CurvePoint& point) {
                        return evaluator.displacement_rate(point).noise;
                      }});
  add_whole_turns(study, evaluator, quantities, events);
  for (const Limit& limit : study.until) {
    if (std::isfinite(limit.low))
      add(limit.quantity, limit.low, continuation::EventAction::stop,
          limit.quantity + " reaches its lower limit");
    if (std::isfinite(limit.high))
      add(limit.quantity, limit.high, continuation::EventAction::stop,
          limit.quantity + " reaches its upper limit");
  }
  for (const Mark& mark : study.marks)
    add(mark.quantity, mark.value, continuation::EventAction::record, mark.quantity);
  for (const std::string& name : study.extrema) {
    const QuantityDefinition* q = find_quantity(quantities, name);
    assert(q != nullptr);
    events.push_back({extremum_name(name),
                      [&evaluator, definition = *q](const continuation::CurvePoint& point) {
                        return evaluator.rate(definition, point).value;
                      },
                      continuation::EventAction::record, column_extremum,
                      [&evaluator, definition = *q](const continuation::CurvePoint& point) {
                        return evaluator.rate(definition, point).noise;
                      }});
  }
  return events;
}

namespace {

/// Values so far from a limit, of the larger of it and its unit, lie on the one or the other side of it.
constexpr double beyond_limit = 1e-9;

/// How far along its ray a curve is looked at to see which way it goes, in the metric.
constexpr double short_way = 1e-6;

/// Two values of a quantity in its unit that far apart on the short way differ by rounding alone: a curve that runs
/// along its limit does not leave it.
double no_change(double value) {
  return std::numeric_limits<double>::epsilon() * std::abs(value) + short_way * tangent_rounding;
}

std::string outside_text(const Limit& limit, double value) {
  return limit.quantity + " is " + rounded(value) + " at the start, outside of its limits " +
         rounded(limit.low) + " to " + rounded(limit.high);
}

}  // namespace

std::optional<OutsideStart> outside_start(const Study& study, const Evaluator& evaluator,
                                          const std::vector<QuantityDefinition>& quantities,
                                          const continuation::CurvePoint& start) {
  for (const Limit& limit : study.until) {
    Study one = study;
    one.until = {limit};
    if (!limit_passed(one, evaluator, quantities, start)) continue;
    const QuantityDefinition* q = find_quantity(quantities, limit.quantity);
    return OutsideStart{limit.quantity, outside_text(limit, evaluator.value(*q, start))};
  }
  return std::nullopt;
}

std::optional<continuation::Curve> ended_at_start(const Study& study, const Evaluator& evaluator,
                                                  const std::vector<QuantityDefinition>& quantities,
                                                  const continuation::CurvePoint& start,
                                                  const continuation::Ray& ray) {
  continuation::Curve curve;
  curve.points = {start};
  curve.points.front().tangent = ray.tangent;
  curve.points.front().piece = ray.piece;
  continuation::CurvePoint ahead = curve.points.front();
  ahead.x += short_way * ray.tangent.dx;
  ahead.lambda += short_way * ray.tangent.dlambda;
  for (const Limit& limit : study.until) {
    const QuantityDefinition* q = find_quantity(quantities, limit.quantity);
    const double here = evaluator.value(*q, start) / q->scale;
    const double change = evaluator.value(*q, ahead) / q->scale - here;
    for (const auto& [edge, outwards, name] :
         {std::tuple{limit.low / q->scale, -1.0, "lower"}, {limit.high / q->scale, 1.0, "upper"}}) {
      if (!std::isfinite(edge)) continue;
      const double beyond = outwards * (here - edge);
      const double rounding = off_curve_rate * std::max(1.0, std::abs(edge));
      if (beyond < -rounding || (beyond <= rounding && outwards * change <= no_change(here)))
        continue;
      curve.stop =
          beyond > rounding ? continuation::StopReason::bad_start : continuation::StopReason::event;
      curve.stop_detail = beyond > rounding ? outside_text(limit, q->scale * here)
                                            : limit.quantity + " reaches its " + name + " limit";
      return curve;
    }
  }
  return std::nullopt;
}

bool is_on_limit(const Study& study, const Evaluator& evaluator,
                 const std::vector<QuantityDefinition>& quantities,
                 const continuation::CurvePoint& point) {
  return std::any_of(study.until.begin(), study.until.end(), [&](const Limit& limit) {
    const QuantityDefinition* q = find_quantity(quantities, limit.quantity);
    const double here = evaluator.value(*q, point) / q->scale;
    const auto is_at = [&](double edge) {
      return std::abs(here - edge / q->scale) <= beyond_limit * std::max(1.0, std::abs(here));
    };
    return is_at(limit.low) || is_at(limit.high);
  });
}

std::optional<std::string> limit_passed(const Study& study, const Evaluator& evaluator,
                                        const std::vector<QuantityDefinition>& quantities,
                                        const continuation::CurvePoint& point) {
  for (const Limit& limit : study.until) {
    const QuantityDefinition* q = find_quantity(quantities, limit.quantity);
    const double here = evaluator.value(*q, point) / q->scale;
    const auto beyond = [here](double edge, double outwards) {
      return std::isfinite(edge) &&
             outwards * (here - edge) > beyond_limit * std::max(1.0, std::abs(edge));
    };
    if (beyond(limit.low / q->scale, -1)) return limit.quantity + " reaches its lower limit";
    if (beyond(limit.high / q->scale, 1)) return limit.quantity + " reaches its upper limit";
  }
  return std::nullopt;
}

}  // namespace springfold::analysis
