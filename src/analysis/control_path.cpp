#include "control_path.hpp"

#include <algorithm>
#include <cmath>

#include "shape_units.hpp"
#include "springfold/continuation/problem.hpp"
#include "springfold/core/number_text.hpp"
#include "springfold/statics/shapes.hpp"

namespace springfold::analysis {

static_assert(continuation::PiecewiseSmoothProblem<ControlProblem>);

TargetPath::TargetPath(const CommandSetup& setup, const ControlPath& path) : count_{path.count()} {
  for (const Vector& target : path.targets) targets_.push_back(setup.target_of(target));
  if (path.circle) {
    const CirclePath& c = *path.circle;
    circle_ = true;
    centre_ = setup.target_of(c.centre);
    axis_1_ = setup.target_of(c.radius * Vector::Unit(c.centre.size(), c.first));
    axis_2_ = setup.target_of(c.radius * Vector::Unit(c.centre.size(), c.second));
    from_ = c.from;
    to_ = c.to;
  }
  for (int k = 0; k < count_; ++k) {
    Vector load;
    if (path.loads.size() == 2 && count_ != 2)
      load =
          path.loads[0] + (path.loads[1] - path.loads[0]) * (static_cast<double>(k) / (count_ - 1));
    else if (!path.loads.empty())
      load = path.loads[static_cast<std::size_t>(k)];
    loads_.push_back(setup.load_of(load));
  }
  // The way of the point: translations only.
  const model::TaskSpace space =
      setup.system.mechanism.bodies[static_cast<std::size_t>(setup.task.body - 1)].task_space;
  Vector translation(std::ssize(setup.task.prescribed));
  for (Index k = 0; k < translation.size(); ++k)
    translation[k] =
        setup.task.prescribed[static_cast<std::size_t>(k)] < translations(space) ? 1 : 0;
  ways_.push_back(0);
  for (int k = 1; k < count_; ++k) {
    const double way =
        circle_ ? translation.cwiseProduct(axis_1_).norm() * std::abs(to_ - from_) / (count_ - 1)
                : translation.cwiseProduct(target(k + 1) - target(k)).norm();
    ways_.push_back(ways_.back() + way);
  }
}

int TargetPath::leg_at(double place) const {
  return std::clamp(static_cast<int>(std::floor(place)), 1, std::max(1, count_ - 1));
}

double TargetPath::angle(double place) const {
  if (place == count_) return to_;
  return from_ + (to_ - from_) * ((place - 1) / (count_ - 1));
}

Vector TargetPath::target(double place, int leg) const {
  if (circle_) {
    const double a = angle(place);
    return centre_ + std::cos(a) * axis_1_ + std::sin(a) * axis_2_;
  }
  const auto k = static_cast<std::size_t>(leg - 1);
  const double part = place - leg;
  if (part == 0) return targets_[k];
  if (part == 1) return targets_[k + 1];
  return targets_[k] + part * (targets_[k + 1] - targets_[k]);
}

Vector TargetPath::target_rate(double place, int leg) const {
  if (circle_) {
    const double a = angle(place), rate = (to_ - from_) / (count_ - 1);
    return rate * (std::cos(a) * axis_2_ - std::sin(a) * axis_1_);
  }
  const auto k = static_cast<std::size_t>(leg - 1);
  return targets_[k + 1] - targets_[k];
}

Vector TargetPath::load(double place, int leg) const {
  const auto k = static_cast<std::size_t>(leg - 1);
  const double part = place - leg;
  if (part == 0) return loads_[k];
  return loads_[k] + part * (loads_[k + 1] - loads_[k]);
}

Vector TargetPath::load_rate(int leg) const {
  const auto k = static_cast<std::size_t>(leg - 1);
  return loads_[k + 1] - loads_[k];
}

double TargetPath::way(double place) const {
  const int leg = leg_at(place);
  const auto k = static_cast<std::size_t>(leg - 1);
  const double part = place - leg;
  return part == 0 ? ways_[k] : ways_[k] + part * (ways_[k + 1] - ways_[k]);
}

ControlProblem::ControlProblem(const CommandSetup& setup, const TargetPath& path, int leg)
    : setup_{setup}, path_{path}, leg_{leg} {
  const statics::System& system = setup.system;
  for (const Index k : setup.task.prescribed) held_.push_back(setup.t + k);
  for (Index i = 0; i < system.size; ++i)
    if (std::find(held_.begin(), held_.end(), i) == held_.end()) unknowns_.push_back(i);
  for (const Index k : setup.task.commands) unknowns_.push_back(system.size + k);
  // lambda is about the way that the target goes, so that its arc length suits the others'.
  length_ = std::max({path.target_rate(leg, leg).norm(), path.load_rate(leg).norm(), 1e-6});
}

Vector ControlProblem::reduce(const Vector& z, const Vector& rho) const {
  Vector y(std::ssize(unknowns_));
  for (Index k = 0; k < y.size(); ++k) {
    const Index at = unknowns_[static_cast<std::size_t>(k)];
    y[k] = at < size() ? z[at] : rho[at - size()];
  }
  return y;
}

Vector ControlProblem::expand(const Vector& y, double lambda) const {
  Vector z(size());
  for (Index k = 0; k < y.size(); ++k) {
    const Index at = unknowns_[static_cast<std::size_t>(k)];
    if (at < size()) z[at] = y[k];
  }
  z(held_) = path_.target(place(lambda), leg_);
  return z;
}

statics::Inputs ControlProblem::inputs(const Vector& y, double lambda) const {
  statics::Inputs inputs{setup_.system.commands, path_.load(place(lambda), leg_)};
  for (Index k = 0; k < y.size(); ++k) {
    const Index at = unknowns_[static_cast<std::size_t>(k)];
    if (at >= size()) inputs.rho[at - size()] = y[k];
  }
  return inputs;
}

bool ControlProblem::residual(const Vector& y, double lambda, const Piece& piece, Vector& F) const {
  return equilibrium_residual(setup_.system, piece, expand(y, lambda), inputs(y, lambda), work_, F);
}

bool ControlProblem::derivatives(const Vector& y, double lambda, const Piece& piece, Matrix& dF_dy,
                                 Vector& dF_dlambda) const {
  const Vector z = expand(y, lambda);
  if (!equilibrium_matrix(setup_.system, piece, z, inputs(y, lambda), work_, r_, A_, &dR_drho_))
    return false;
  dF_dy.resize(size(), size());
  for (Index k = 0; k < size(); ++k) {
    const Index at = unknowns_[static_cast<std::size_t>(k)];
    if (at < size())
      dF_dy.col(k) = A_.col(at);
    else
      dF_dy.col(k) = dR_drho_.col(at - size());
  }
  const Vector load_rate = path_.load_rate(leg_);
  dF_dlambda = A_(Eigen::all, held_) * path_.target_rate(place(lambda), leg_);
  if (!load_rate.isZero(0)) dF_dlambda += load_columns(setup_.system, z) * load_rate;
  dF_dlambda /= length_;
  return true;
}

bool ControlProblem::switches(const Vector& y, double lambda, Vector& g) const {
  const Vector z = expand(y, lambda);
  const Vector rho = inputs(y, lambda).rho;
  g.resize(switch_count());
  put_switch_values(setup_.system, 0, z, rho, g);
  return g.allFinite();
}

bool ControlProblem::switch_gradients(const Vector& y, double lambda, Matrix& dg_dy,
                                      Vector& dg_dlambda) const {
  const Vector z = expand(y, lambda), target_rate = path_.target_rate(place(lambda), leg_);
  const Vector rho = inputs(y, lambda).rho;
  dg_dy.resize(switch_count(), y.size());
  dg_dlambda.resize(switch_count());
  statics::SwitchGradient at;
  for (Index j = 0; j < dg_dy.rows(); ++j) {
    if (!switch_gradient(setup_.system, static_cast<std::size_t>(j), z, rho, at)) return false;
    for (Index k = 0; k < y.size(); ++k) {
      const Index i = unknowns_[static_cast<std::size_t>(k)];
      dg_dy(j, k) = i < size() ? at.z[i] : at.rho[i - size()];
    }
    dg_dlambda[j] = at.z(held_).dot(target_rate) / length_;
  }
  return true;
}

Vector ControlProblem::metric() const {
  Vector weights = Vector::Ones(size());
  for (Index k = 0; k < size(); ++k) {
    const Index at = unknowns_[static_cast<std::size_t>(k)];
    if (at < size() && setup_.system.is_wrench[static_cast<std::size_t>(at)]) weights[k] = 0;
  }
  return weights;
}

std::string ControlProblem::switch_name(Index j) const {
  const statics::Switch& s = setup_.system.switches[static_cast<std::size_t>(j)];
  if (s.of_shape()) {
    const statics::PointShape& shape = setup_.system.shapes[s.spring];
    return "spring " + shape.name + " passes " +
           rounded(unit_of_value(shape.shape.kind, setup_.scales) * s.breakpoint);
  }
  const double unit =
      setup_.system.is_length[static_cast<std::size_t>(s.coordinate)] ? setup_.scales.length : 1;
  return "spring " + setup_.system.springs[s.spring].name + " passes " +
         rounded(unit * s.breakpoint);
}

}  // namespace springfold::analysis
