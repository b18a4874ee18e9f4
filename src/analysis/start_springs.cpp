// Springs that are counted from the start pose, for those who look at a mechanism from outside.
#include "scales.hpp"
#include "spring_origins.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

model::Mechanism with_springs_from_start(const model::Mechanism& mechanism, const Study& study,
                                         const model::Mechanism& now) {
  const Scales scales = scales_for(mechanism, study.constant_load);
  const statics::System system = statics::prepare(dimensionless(mechanism, scales));
  Vector z = statics::guess(system);
  const auto b = static_cast<std::size_t>(study.body - 1);
  const model::TaskSpace space = mechanism.bodies[b].task_space;
  if (study.start.pose.size() > 0)
    z.segment(system.body_slices[b].t, dimension(space)) =
        study.start.pose.cwiseQuotient(pose_scales(space, scales));
  auto origins = spring_origins(system.mechanism, study, system, z);
  if (!origins) return now;
  for (std::size_t c = 0; c < origins->size(); ++c)
    for (std::size_t i = 0; i < (*origins)[c].size(); ++i)
      if (const auto* joint = std::get_if<model::Joint>(&mechanism.chains[c].elements[i]);
          joint && joint->kind == model::JointKind::prismatic)
        (*origins)[c][i] *= scales.length;
  return with_origins(now, *origins);
}

}  // namespace springfold::analysis
