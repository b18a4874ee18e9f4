#include <algorithm>
#include <cmath>
#include <limits>

#include "springfold/model/spring_law.hpp"

namespace springfold::model {
namespace {

/// Where between low and high, which may be infinite, the torque of segment i vanishes; `from` if nowhere
/// near. By halving, after steps of growing length where an end is infinite.
double zero_of_curve(const CompiledSpring& law, std::size_t i, double from, double low,
                     double high) {
  const auto torque = [&law, i](double c) { return law.torque(i, c); };
  const bool down = torque(from) > 0;
  constexpr int longest = 40;  // doublings
  double a = from, b = from;
  for (int k = -longest; k <= longest; ++k) {
    b = std::clamp(from + (down ? -1 : 1) * std::ldexp(1.0, k), low, high);
    if (!std::isfinite(torque(b))) return from;
    if ((torque(b) > 0) != down) break;
    if (b == low || b == high) return from;
    a = b;
  }
  if ((torque(b) > 0) == down) return from;
  for (double middle = 0.5 * (a + b); middle != a && middle != b; middle = 0.5 * (a + b))
    ((torque(middle) > 0) == down ? a : b) = middle;
  return b;
}

}  // namespace

double relaxed_coordinate(const CompiledSpring& law, double initial) {
  const std::size_t here = law.segment_at(initial);
  const double torque = law.torque(here, initial);
  if (torque == 0) return initial;
  // Walk to the segment in which the torque changes sign.
  std::size_t i = here;
  const auto end_of = [&](std::size_t segment) {  // towards zero torque
    if (torque > 0)
      return segment > 0 ? law.breakpoints[segment - 1] : -std::numeric_limits<double>::infinity();
    return segment < law.breakpoints.size() ? law.breakpoints[segment]
                                            : std::numeric_limits<double>::infinity();
  };
  while (true) {
    const double end = end_of(i);
    const auto& s = law.segments[i];
    if (!law.is_straight(i) && (!std::isfinite(end) || law.torque(i, end) * torque <= 0)) {
      const double from = i == here    ? initial
                          : torque > 0 ? law.breakpoints[i]
                                       : law.breakpoints[i - 1];
      return torque > 0 ? zero_of_curve(law, i, from, end, from)
                        : zero_of_curve(law, i, from, from, end);
    }
    if (!std::isfinite(end) || law.torque(i, end) * torque <= 0)
      return s.stiffness > 0 ? s.anchor - s.torque / s.stiffness : initial;
    i = torque > 0 ? i - 1 : i + 1;
  }
}

}  // namespace springfold::model
