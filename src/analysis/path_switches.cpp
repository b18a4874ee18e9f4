// Switches of springs of shapes along a path: functions of the positions of points.
#include "path_problem.hpp"
#include "shape_units.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {

bool PathProblem::put_shape_switches(const Vector& y, double lambda, Index first, Vector& g) const {
  if (!has_rotations(y)) return false;
  put_local(y, lambda, z_);
  put_inputs(lambda, inputs_);
  const statics::System& present = turned(y, lambda);
  put_switch_values(present, static_cast<std::size_t>(first), z_, inputs_.rho, g);
  return g.allFinite();
}

/// Rows of the derivatives by z, reduced as those of the equations are.
bool PathProblem::put_shape_gradients(const Vector& y, double lambda, Index first, Matrix& dg_dy,
                                      Vector& dg_dlambda) const {
  if (!has_rotations(y)) return false;
  put_local(y, lambda, z_);
  put_inputs(lambda, inputs_);
  const statics::System& present = turned(y, lambda);
  for (Index j = first; j < dg_dy.rows(); ++j) {
    const auto number = static_cast<std::size_t>(j);
    if (j > first && same_spring(present.switches[number], present.switches[number - 1])) {
      dg_dy.row(j) = dg_dy.row(j - 1);
      dg_dlambda[j] = dg_dlambda[j - 1];
      continue;
    }
    statics::SwitchGradient& at = switch_gradient_;
    if (!switch_gradient(present, number, z_, inputs_.rho, at)) return false;
    reduce_rows(at.z, v_);
    put_quaternions(y, v_, F_);
    dg_dy.row(j) = F_.transpose();
    dg_dlambda[j] = at.z.segment(t_, d_).dot(rule_.t_rate);
    if (moves_commands_) dg_dlambda[j] += at.rho.dot(rule_.rho_rate);
  }
  return true;
}

std::optional<Vector> PathProblem::switches_at(const Vector& y, double lambda) const {
  Vector g;
  if (!switches(y, lambda, g)) return std::nullopt;
  return g;
}

std::string PathProblem::shape_switch_name(const statics::Switch& s, Index j) const {
  const statics::PointShape& shape = system_.shapes[s.spring];
  const auto i = static_cast<std::size_t>(j - shape.first_switch);
  const double below = shape.law.stiffness(i, s.breakpoint);
  const double above = shape.law.stiffness(i + 1, s.breakpoint);
  const bool nothing_below = below == 0 && shape.law.is_straight(i);
  const bool nothing_above = above == 0 && shape.law.is_straight(i + 1);
  const char* what = nothing_below   ? "acts above "
                     : nothing_above ? "acts below "
                     : above > below ? "is stiffer above "
                                     : "is stiffer below ";
  const double unit = unit_of_value(shape.shape.kind, {.length = rule_.length});
  return "spring " + shape.name + " (" + what + rounded(s.breakpoint * unit) + ")";
}

}  // namespace springfold::analysis
