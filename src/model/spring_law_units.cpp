// Spring laws in other units and at other coordinates.
#include <algorithm>
#include <cmath>

#include "springfold/model/spring_law.hpp"

namespace springfold::model {
namespace {

struct Scaled {
  double coordinate, torque;

  SpringLaw operator()(LinearSpring s) const {
    s.stiffness = s.stiffness * coordinate / torque;
    s.free /= coordinate;
    return s;
  }
  SpringLaw operator()(const OneSidedSpring& s) const {
    return OneSidedSpring{s.stiffness * coordinate / torque, s.from / coordinate, s.side};
  }
  SpringLaw operator()(PiecewiseLinearSpring s) const {
    for (double& b : s.breakpoints) b /= coordinate;
    for (double& k : s.stiffnesses) k *= coordinate / torque;
    s.free /= coordinate;
    s.preload /= torque;
    return s;
  }
  SpringLaw operator()(TableSpring s) const {
    for (double& u : s.deformations) u /= coordinate;
    for (double& t : s.torques) t /= torque;
    s.free /= coordinate;
    return s;
  }
  SpringLaw operator()(PolynomialSpring s) const {
    double factor = 1 / torque;
    for (double& a : s.coefficients) {
      a *= factor;
      factor *= coordinate;
    }
    s.free /= coordinate;
    s.range.low /= coordinate;
    s.range.high /= coordinate;
    return s;
  }
  SpringLaw operator()(FormulaSpring s) const {
    s.free /= coordinate;
    s.coordinate_unit *= coordinate;
    s.torque_unit *= torque;
    return s;
  }
  SpringLaw operator()(LogarithmicSpring s) const {
    s.stiffness *= coordinate / torque;
    s.length /= coordinate;
    s.free /= coordinate;
    return s;
  }
  SpringLaw operator()(PowerSpring s) const {
    s.force /= torque;
    s.depth /= coordinate;
    s.from /= coordinate;
    return s;
  }
};

struct Moved {
  double by;

  SpringLaw operator()(OneSidedSpring s) const {
    s.from += by;
    return s;
  }
  SpringLaw operator()(PiecewiseLinearSpring s) const {
    for (double& b : s.breakpoints) b += by;
    s.free += by;
    return s;
  }
  SpringLaw operator()(PowerSpring s) const {
    s.from += by;
    return s;
  }
  template <class Law>
  SpringLaw operator()(Law s) const {
    s.free += by;
    return s;
  }
};

}  // namespace

SpringLaw scaled(const SpringLaw& law, double coordinate, double torque) {
  return std::visit(Scaled{coordinate, torque}, law);
}

SpringLaw moved(const SpringLaw& law, double by) { return std::visit(Moved{by}, law); }

SpringLaw with_breakpoint(const SpringLaw& law, double near, double to) {
  const CompiledSpring compiled = compile(law);
  const auto& places = compiled.breakpoints;
  const auto nearest =
      std::ranges::min_element(places, {}, [near](double place) { return std::abs(place - near); });
  if (nearest == places.end()) return law;
  const auto i = static_cast<std::size_t>(nearest - places.begin());
  const auto* const linear = std::get_if<PiecewiseLinearSpring>(&law);
  if (linear == nullptr || compiled.is_free(i) || compiled.is_free(i + 1) ||
      compiled.torque(i, *nearest) == 0)
    return moved(law, to - *nearest);
  PiecewiseLinearSpring other = *linear;
  other.breakpoints[i] = to;
  const bool is_ordered = (i == 0 || other.breakpoints[i - 1] < to) &&
                          (i + 1 == places.size() || to < other.breakpoints[i + 1]);
  if (!is_ordered) return law;
  const CompiledSpring there = compile(other);
  other.preload += compiled.torque(compiled.segment_at(to), to) - there.torque(i, to);
  return other;
}

}  // namespace springfold::model
