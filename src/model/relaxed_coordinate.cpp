#include <algorithm>
#include <cmath>
#include <limits>

#include "springfold/core/overloaded.hpp"
#include "springfold/model/spring_law.hpp"

namespace springfold::model {
namespace {

/// A place of a torque, or where the search for it ended.
struct PlaceOnLaw {
  double at = 0;
  bool found = true;
};

/// Where between low and high, which may be infinite, segment i has the torque; `from` if nowhere near. By halving,
/// after steps of growing length where an end is infinite.
PlaceOnLaw place_on_curve(const CompiledSpring& law, std::size_t i, double wanted, double from,
                          double low, double high) {
  const auto torque = [&law, i, wanted](double c) { return law.torque(i, c) - wanted; };
  const bool down = torque(from) > 0;
  constexpr int longest = 40;  // doublings
  double a = from, b = from;
  for (int k = -longest; k <= longest; ++k) {
    b = std::clamp(from + (down ? -1 : 1) * std::ldexp(1.0, k), low, high);
    if (!std::isfinite(torque(b))) return {from, false};
    if ((torque(b) > 0) != down) break;
    if (b == low || b == high) return {from, false};
    a = b;
  }
  if ((torque(b) > 0) == down) return {from, false};
  for (double middle = 0.5 * (a + b); middle != a && middle != b; middle = 0.5 * (a + b))
    ((torque(middle) > 0) == down ? a : b) = middle;
  return {b};
}

/// Walks from `initial` to the segment in which the torque passes the wanted one.
PlaceOnLaw place_of(const CompiledSpring& law, double wanted, double initial) {
  const std::size_t here = law.segment_at(initial);
  const double torque = law.torque(here, initial) - wanted;
  if (torque == 0) return {initial};
  std::size_t i = here;
  const auto end_of = [&](std::size_t segment) {  // towards the wanted torque
    if (torque > 0)
      return segment > 0 ? law.breakpoints[segment - 1] : -std::numeric_limits<double>::infinity();
    return segment < law.breakpoints.size() ? law.breakpoints[segment]
                                            : std::numeric_limits<double>::infinity();
  };
  while (true) {
    const double end = end_of(i);
    const auto& s = law.segments[i];
    const bool is_last = !std::isfinite(end) || (law.torque(i, end) - wanted) * torque <= 0;
    if (!law.is_straight(i) && is_last) {
      const double from = i == here    ? initial
                          : torque > 0 ? law.breakpoints[i]
                                       : law.breakpoints[i - 1];
      return torque > 0 ? place_on_curve(law, i, wanted, from, end, from)
                        : place_on_curve(law, i, wanted, from, from, end);
    }
    if (is_last)
      return s.stiffness > 0 ? PlaceOnLaw{s.anchor - (s.torque - wanted) / s.stiffness}
                             : PlaceOnLaw{initial, false};
    i = torque > 0 ? i - 1 : i + 1;
  }
}

bool curve_never_falls(const SpringCurve& curve) {
  return std::visit(Overloaded{[](const PolynomialSpring& law) { return !law.falling; },
                               [](const FormulaSpring& law) { return !law.falling; },
                               [](const CubicPieces& law) {
                                 for (std::size_t i = 0; i < law.pieces.size(); ++i)
                                   if (law.pieces[i].slope < 0 ||
                                       (i > 0 && law.pieces[i].value < law.pieces[i - 1].value))
                                     return false;
                                 return true;
                               },
                               [](const auto&) { return true; }},
                    curve);
}

}  // namespace

double relaxed_coordinate(const CompiledSpring& law, double initial) {
  return place_of(law, 0, initial).at;
}

std::optional<double> coordinate_of_torque(const CompiledSpring& law, double torque, double near) {
  const PlaceOnLaw place = place_of(law, torque, near);
  return place.found ? std::optional(place.at) : std::nullopt;
}

bool never_falls(const CompiledSpring& law) {
  for (const CompiledSpring::Segment& segment : law.segments)
    if (segment.curve >= 0 ? !curve_never_falls(law.curves[static_cast<std::size_t>(segment.curve)])
                           : segment.stiffness < 0)
      return false;
  return true;
}

}  // namespace springfold::model
