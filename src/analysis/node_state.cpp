#include "node_state.hpp"

#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {
namespace {

/// Commands of plain inverse kinematics: the platform settles nearby.
NotHeld settle(const CommandSetup& setup, statics::KinematicInverse plain, CommandedState& state) {
  statics::ControlSolver solver = equilibrium_solver(setup.system, plain.z, plain.rho);
  solver.inputs.W = setup.W;
  if (!solve_control_globally(setup.system, solver))
    return {.why = "no equilibrium near the node with these commands"};
  state = {.z = solver.z,
           .inputs = solver.inputs,
           .piece = solver.piece,
           .plain = std::move(plain),
           .iterations = static_cast<double>(solver.iterations)};
  return {};
}

NotHeld settle_from_guess(const CommandSetup& setup, Index body, const Vector& pose,
                          CommandedState& state) {
  statics::StartProblem start{.body = body};
  start.z = statics::guess(setup.system);
  start.z.segment(setup.t, setup.d) = pose.cwiseQuotient(setup.pose_scale);
  start.inputs = {setup.system.commands, setup.W};
  const statics::FirstEquilibrium found = first_equilibrium(setup.system, start);
  if (found.status == statics::StartStatus::no_assembly)
    return {.is_unreachable = true, .why = "the chains cannot be closed", .is_shown = true};
  if (found.status != statics::StartStatus::found)
    return {.why = "no equilibrium found with these commands"};
  state = {.z = found.z, .inputs = found.inputs, .piece = found.piece};
  state.iterations = found.iterations;
  const Vector target = found.z.segment(setup.t, setup.d)(setup.task.prescribed);
  state.plain = kinematic_inverse(setup.system, setup.task, target, found.z, setup.system.commands);
  return {};
}

}  // namespace

NotHeld solve_node(const Study& study, const CommandSetup& setup, const Vector& pose,
                   statics::KinematicInverse& near, CommandedState& state) {
  if (study.map.command == NodeCommand::given)
    return settle_from_guess(setup, study.body, pose, state);
  const Vector scaled = pose.cwiseQuotient(setup.pose_scale);
  const Vector target = scaled(setup.task.prescribed);
  statics::KinematicInverse plain = approach(setup, target, near);
  if (plain.closed) near = plain;
  const bool kinetostatic = study.map.command == NodeCommand::kinetostatic;
  if (!kinetostatic && plain.closed) return settle(setup, std::move(plain), state);
  if (!kinetostatic)
    return why_not_held(setup, target, setup.W,
                        {.status = statics::ControlStatus::unreachable, .plain = std::move(plain)});
  statics::ControlProblem problem{
      .task = setup.task, .target = target, .W = setup.W, .z = plain.z, .rho = plain.rho};
  if (study.command.method == CommandMethod::paper) problem.method = statics::ControlMethod::paper;
  const statics::ControlResult found =
      kinetostatic_control(setup.system, problem, std::move(plain));
  if (found.status != statics::ControlStatus::converged)
    return why_not_held(setup, target, setup.W, found);
  state = {.z = found.z,
           .inputs = found.inputs,
           .piece = found.piece,
           .plain = found.plain,
           .iterations = static_cast<double>(found.iterations)};
  return {};
}

}  // namespace springfold::analysis
