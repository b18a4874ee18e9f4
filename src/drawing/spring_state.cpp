#include "spring_state.hpp"

namespace springfold::drawing {
namespace {

/// How many of the segments have no force.
std::size_t free_segments(const model::CompiledSpring& spring) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < spring.segments.size(); ++i) count += spring.is_free(i) ? 1 : 0;
  return count;
}

}  // namespace

SpringState spring_state(const model::SpringLaw& law, double c) {
  const model::CompiledSpring spring = model::compile(law);
  const std::size_t here = spring.segment_at(c);
  return {free_segments(spring) > 0, !spring.is_free(here), spring.torque(here, c),
          spring.energy(here, c)};
}

std::vector<double> thresholds_of(const model::SpringLaw& law) {
  const model::CompiledSpring spring = model::compile(law);
  std::vector<double> list;
  for (std::size_t i = 0; i < spring.breakpoints.size(); ++i)
    if (spring.is_free(i) != spring.is_free(i + 1)) list.push_back(spring.breakpoints[i]);
  return list;
}

bool is_nothing(const model::SpringLaw& law) {
  const model::CompiledSpring spring = model::compile(law);
  return free_segments(spring) == spring.segments.size();
}

}  // namespace springfold::drawing
