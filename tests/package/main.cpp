// Two springs at right angles under a dead load: x = 1/2, y = 3/3, stiffness diag(2, 3).
#include <cmath>
#include <cstdio>
#include <springfold/analysis/run.hpp>
#include <springfold/version.hpp>

namespace model = springfold::model;
namespace analysis = springfold::analysis;

model::Joint slide(const char* name, const model::Vec3<double>& axis, double stiffness) {
  model::Joint joint{.name = name, .kind = model::JointKind::prismatic, .axis = axis};
  joint.role = model::JointRole::compliant;
  joint.spring = model::LinearSpring{.stiffness = stiffness};
  return joint;
}

int main() {
  const model::Chain chain{.name = "arm",
                           .elements = {slide("x", {1, 0, 0}, 2), slide("y", {0, 1, 0}, 3)}};
  const model::Mechanism mechanism{.bodies = {{.name = "tool",
                                               .task_space = model::TaskSpace::xy,
                                               .pose = Eigen::Vector2d(0, 0)}},
                                   .chains = {chain}};
  analysis::Study study{.name = "hold", .kind = analysis::StudyKind::equilibrium};
  study.constant_load = Eigen::Vector2d(1, 3);

  const analysis::StudyResult result = analysis::run_study(mechanism, study);

  const springfold::Matrix K = result.start.stiffness;
  const bool right = result.start.found && K.rows() == 2 && std::abs(K(0, 0) - 2) < 1e-12 &&
                     std::abs(K(1, 1) - 3) < 1e-12;
  std::printf("springfold %s: %s\n", springfold::version.data(), right ? "right" : "wrong");
  return right ? 0 : 1;
}
