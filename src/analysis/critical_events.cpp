// What ends a critical curve, and what is marked on it.
#include <cmath>
#include <functional>
#include <limits>

#include "beside_answer.hpp"
#include "critical_rows.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalEvent;
using continuation::CriticalPoint;
using continuation::EventAction;

/// A value in the study of a member: limits and marks may be formulas of the parameter.
using ValueOf = std::function<double(const Member&)>;

/// Tag of the end at which the first point of the path is its start.
constexpr int start_of_path = 1;

CriticalEvent at_value(const CaseCurves& curves, std::string name, const std::string& quantity,
                       ValueOf wanted, const Piece& piece, EventAction action) {
  return {std::move(name),
          [&curves, quantity, wanted = std::move(wanted), piece](const CriticalPoint& p) {
            const Member* member = curves.equations_at(p.mu);
            if (member == nullptr) return std::numeric_limits<double>::quiet_NaN();
            const QuantityDefinition& q = *member->quantity(quantity);
            const double value = member->evaluator().value(q, CaseCurves::point_of(p, piece));
            return (value - wanted(*member)) / q.scale;
          },
          action};
}

/// At a value of the parameter itself.
CriticalEvent at_parameter(const CaseCurves& curves, std::string name, double value,
                           EventAction action) {
  return {std::move(name),
          [mu = value / curves.scale()](const CriticalPoint& p) { return p.mu - mu; }, action,
          true};
}

/// @param end  Limit::low or Limit::high
ValueOf limit_of(const std::string& quantity, double Limit::*end) {
  return [quantity, end](const Member& member) {
    for (const Limit& limit : member.study.until)
      if (limit.quantity == quantity) return limit.*end;
    return std::numeric_limits<double>::quiet_NaN();
  };
}

}  // namespace

std::string end_of_range(const CaseCurves& curves, int sense) {
  RuledRange side = curves.rules();
  (sense < 0 ? side.above : side.below).clear();
  std::string text = std::string{"reaches its "} + (sense < 0 ? "lower" : "upper") + " limit";
  for (const std::string& words : words_of_beyond(side, curves.name())) text += "; " + words;
  return text;
}

std::vector<CriticalEvent> critical_events(const CaseCurves& curves, const Study& study,
                                           const Piece& piece) {
  std::vector<CriticalEvent> events;
  const auto end_range = [&](double value, int inside) {
    if (!std::isfinite(value)) return;
    events.push_back(at_parameter(curves, curves.name() + " " + end_of_range(curves, -inside),
                                  value, EventAction::stop));
    events.back().inside = inside;
  };
  end_range(study.critical.low, 1);
  end_range(study.critical.high, -1);
  const auto end = [&](const Limit& until, const std::string& what, double Limit::*side,
                       int inside) {
    if (!std::isfinite(until.*side)) return;
    events.push_back(at_value(curves, until.quantity + what, until.quantity,
                              limit_of(until.quantity, side), piece, EventAction::stop));
    events.back().inside = inside;
  };
  for (const Limit& until : study.until) {
    end(until, " reaches its lower limit", &Limit::low, 1);
    end(until, " reaches its upper limit", &Limit::high, -1);
  }
  std::size_t number = 0;  // among those of a member's study, which has none of the parameter
  for (const Mark& mark : study.marks) {
    if (mark.quantity == curves.name()) {
      events.push_back(at_parameter(curves, mark.quantity, mark.value, EventAction::record));
      continue;
    }
    const auto value = [k = number++](const Member& member) { return member.study.marks[k].value; };
    events.push_back(
        at_value(curves, mark.quantity, mark.quantity, value, piece, EventAction::record));
  }
  return events;
}

std::vector<CriticalEvent> first_point_events(const CaseCurves& curves, const Study& study,
                                              const Piece& piece) {
  std::vector<CriticalEvent> events = critical_events(curves, study, piece);
  events.push_back({"it reaches the start of the path",
                    [&curves](const CriticalPoint& p) {
                      const Member* member = curves.equations_at(p.mu);
                      if (member == nullptr) return std::numeric_limits<double>::quiet_NaN();
                      return p.lambda - member->setup.lambda_start;
                    },
                    EventAction::stop, true});
  events.back().inside = 1;
  events.back().tag = start_of_path;
  return events;
}

bool ends_at_start_of_path(const continuation::CriticalCurve& curve) {
  return curve.stop == continuation::StopReason::event && !curve.hits.empty() &&
         curve.hits.back().tag == start_of_path;
}

void say_start_or_its_load(const CaseCurves& curves, continuation::CriticalCurve& curve) {
  constexpr double one_state = 1e-6;  // where curves end, states are known better
  if (!ends_at_start_of_path(curve)) return;
  continuation::CriticalHit& end = curve.hits.back();
  const Member* member = curves.at(end.point.mu);
  // Where the start is lost they have met, whatever start there is from there on.
  if (member == nullptr) return;
  const double ahead = end.point.dmu < 0 ? -1 : 1;
  const Member* before = curves.at(beyond_value(end.point.mu, ahead, -nearest_beside));
  if (before != nullptr && before->sheet != member->sheet) return;
  const Vector start = member->start().x;
  if (start.size() == end.point.x.size() && (end.point.x - start).norm() <= one_state) return;
  end.name = curve.stop_detail = "its load is that at which the path starts";
}

}  // namespace springfold::analysis
