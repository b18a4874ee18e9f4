#include "spring_state.hpp"

#include <algorithm>

namespace springfold::drawing {
namespace {

bool is_free(const model::CompiledSpring::Segment& segment) {
  return segment.stiffness == 0 && segment.torque == 0;
}

}  // namespace

SpringState spring_state(const model::SpringLaw& law, double c) {
  const model::CompiledSpring spring = model::compile(law);
  const std::size_t here = spring.segment_at(c);
  return {std::any_of(spring.segments.begin(), spring.segments.end(), is_free),
          !is_free(spring.segments[here]), spring.torque(here, c), spring.energy(here, c)};
}

std::vector<double> thresholds_of(const model::SpringLaw& law) {
  const model::CompiledSpring spring = model::compile(law);
  std::vector<double> list;
  for (std::size_t i = 0; i < spring.breakpoints.size(); ++i)
    if (is_free(spring.segments[i]) != is_free(spring.segments[i + 1]))
      list.push_back(spring.breakpoints[i]);
  return list;
}

bool is_nothing(const model::SpringLaw& law) {
  const model::CompiledSpring spring = model::compile(law);
  return std::all_of(spring.segments.begin(), spring.segments.end(), is_free);
}

}  // namespace springfold::drawing
