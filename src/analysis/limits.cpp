#include "limits.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "branch_rows.hpp"

namespace springfold::analysis {

std::vector<continuation::Event> events_of(const Study& study, const Evaluator& evaluator,
                                           const std::vector<QuantityDefinition>& quantities) {
  std::vector<continuation::Event> events;
  const auto add = [&](const std::string& name, double value, continuation::EventAction action,
                       std::string label) {
    const auto q = std::find_if(quantities.begin(), quantities.end(),
                                [&](const auto& d) { return d.name == name; });
    assert(q != quantities.end());
    events.push_back({std::move(label),
                      [&evaluator, definition = *q, value](const continuation::CurvePoint& point) {
                        return evaluator.value(definition, point) - value;
                      },
                      action});
  };
  if (study.control == ControlMode::pose || study.control == ControlMode::mixed)
    events.push_back({force_limit,
                      [&evaluator](const continuation::CurvePoint& point) {
                        return evaluator.force_rate(point);
                      },
                      continuation::EventAction::record});
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
  return events;
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
  ahead.x += 1e-6 * ray.tangent.dx;
  ahead.lambda += 1e-6 * ray.tangent.dlambda;
  for (const Limit& limit : study.until) {
    const auto q = std::find_if(quantities.begin(), quantities.end(),
                                [&](const auto& d) { return d.name == limit.quantity; });
    const double here = evaluator.value(*q, start) / q->scale;
    const double change = evaluator.value(*q, ahead) / q->scale - here;
    for (const auto& [edge, outwards, name] :
         {std::tuple{limit.low / q->scale, -1.0, "lower"}, {limit.high / q->scale, 1.0, "upper"}}) {
      if (!std::isfinite(edge)) continue;
      const double beyond = outwards * (here - edge);
      const double rounding = 1e-12 * std::max(1.0, std::abs(edge));
      if (beyond < -rounding || (beyond <= rounding && outwards * change <= 0)) continue;
      curve.stop =
          beyond > rounding ? continuation::StopReason::bad_start : continuation::StopReason::event;
      curve.stop_detail = beyond > rounding ? "it lies outside the range of " + limit.quantity
                                            : limit.quantity + " reaches its " + name + " limit";
      return curve;
    }
  }
  return std::nullopt;
}

std::optional<std::string> limit_passed(const Study& study, const Evaluator& evaluator,
                                        const std::vector<QuantityDefinition>& quantities,
                                        const continuation::CurvePoint& point) {
  for (const Limit& limit : study.until) {
    const auto q = std::find_if(quantities.begin(), quantities.end(),
                                [&](const auto& d) { return d.name == limit.quantity; });
    const double here = evaluator.value(*q, point) / q->scale;
    const auto beyond = [here](double edge, double outwards) {
      return std::isfinite(edge) && outwards * (here - edge) > 1e-9 * std::max(1.0, std::abs(edge));
    };
    if (beyond(limit.low / q->scale, -1)) return limit.quantity + " reaches its lower limit";
    if (beyond(limit.high / q->scale, 1)) return limit.quantity + " reaches its upper limit";
  }
  return std::nullopt;
}

}  // namespace springfold::analysis
