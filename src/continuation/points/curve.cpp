#include "springfold/continuation/curve.hpp"

namespace springfold::continuation {

bool is_same(const CurvePoint& a, const CurvePoint& b) {
  const auto same = [](const Vector& p, const Vector& q) { return p.size() == q.size() && p == q; };
  return a.s == b.s && a.lambda == b.lambda && a.tangent.dlambda == b.tangent.dlambda &&
         a.piece == b.piece && same(a.x, b.x) && same(a.tangent.dx, b.tangent.dx);
}

std::string_view to_string(StopReason reason) {
  switch (reason) {
    case StopReason::event:
      return "end of the range";
    case StopReason::closed:
      return "closed curve, back at its start";
    case StopReason::joined:
      return "goes on along a branch traced before";
    case StopReason::max_points:
      return "largest number of points reached";
    case StopReason::step_too_small:
      return "unresolved: a smaller step than allowed would be needed";
    case StopReason::no_way_out:
      return "unresolved: no piece continues the curve";
    case StopReason::several_ways:
      return "unresolved: several pieces continue the curve";
    case StopReason::bad_start:
      return "the start is not a regular point of a curve";
    case StopReason::observer:
      return "stopped on request";
    case StopReason::unbounded:
      return "lambda grows without bound";
    case StopReason::pole:
      return "unknowns go to infinity";
    case StopReason::turns_upon_itself:
      return "the curve turns back upon itself";
  }
  return "unknown";
}

bool ended_as_asked(StopReason reason) {
  return reason == StopReason::event || reason == StopReason::closed ||
         reason == StopReason::turns_upon_itself;
}

}  // namespace springfold::continuation
