#include "path_problem.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "number_text.hpp"
#include "springfold/continuation/problem.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {

static_assert(continuation::PiecewiseSmoothProblem<PathProblem>);

PathProblem::PathProblem(statics::System system, PathRule rule)
    : system_{std::move(system)}, rule_{std::move(rule)} {
  const auto& body = system_.body_slices[static_cast<std::size_t>(rule_.body - 1)];
  t_ = body.t;
  d_ = body.count;
  size_ = system_.size - d_ + rule_.N.cols();
  assert(rule_.N.rows() == d_);
}

const statics::System& PathProblem::system(double lambda) const {
  if (!rule_.family) return system_;
  if (!family_ || family_lambda_ != lambda) {
    family_ = rule_.family(lambda);
    family_lambda_ = lambda;
  }
  return family_->first;
}

statics::Inputs PathProblem::inputs(double lambda) const {
  statics::Inputs in{rule_.rho_start + lambda * rule_.rho_rate,
                     rule_.W_start + lambda * rule_.W_rate};
  if (rule_.family) {
    in.rho = system(lambda).commands;
    in.W = family_->second;
  }
  return in;
}

Vector PathProblem::expand(const Vector& y, double lambda) const {
  const Index free = rule_.N.cols(), tail = system_.size - t_ - d_;
  Vector z(system_.size);
  z.head(t_) = y.head(t_);
  z.segment(t_, d_) = rule_.t_start + lambda * rule_.t_rate + rule_.N * y.segment(t_, free);
  z.tail(tail) = y.tail(tail);
  return z;
}

Vector PathProblem::expand_rate(const Vector& dy, double dlambda) const {
  const Index free = rule_.N.cols(), tail = system_.size - t_ - d_;
  Vector dz(system_.size);
  dz.head(t_) = dy.head(t_);
  dz.segment(t_, d_) = dlambda * rule_.t_rate + rule_.N * dy.segment(t_, free);
  dz.tail(tail) = dy.tail(tail);
  return dz;
}

Vector PathProblem::reduce(const Vector& z) const {
  Vector from_start = z;
  from_start.segment(t_, d_) -= rule_.t_start;
  return reduce_rows(from_start);
}

Vector PathProblem::reduce_rows(const Vector& r) const {
  const Index free = rule_.N.cols(), tail = system_.size - t_ - d_;
  Vector reduced(size_);
  reduced.head(t_) = r.head(t_);
  reduced.segment(t_, free) = rule_.N.transpose() * r.segment(t_, d_);
  reduced.tail(tail) = r.tail(tail);
  return reduced;
}

bool PathProblem::residual(const Vector& y, double lambda, const Piece& piece, Vector& F) const {
  const bool finite =
      equilibrium_residual(system(lambda), piece, expand(y, lambda), inputs(lambda), work_, r_);
  F = reduce_rows(r_);
  return finite;
}

bool PathProblem::derivatives(const Vector& y, double lambda, const Piece& piece, Matrix& dF_dy,
                              Vector& dF_dlambda) const {
  const Vector z = expand(y, lambda);
  if (!equilibrium_matrix(system(lambda), piece, z, inputs(lambda), work_, r_, A_, &dR_drho_))
    return false;
  const Index free = rule_.N.cols(), tail = system_.size - t_ - d_;
  Matrix columns(system_.size, size_);
  columns.leftCols(t_) = A_.leftCols(t_);
  columns.middleCols(t_, free) = A_.middleCols(t_, d_) * rule_.N;
  columns.rightCols(tail) = A_.rightCols(tail);
  dF_dy.resize(size_, size_);
  dF_dy.topRows(t_) = columns.topRows(t_);
  dF_dy.middleRows(t_, free) = rule_.N.transpose() * columns.middleRows(t_, d_);
  dF_dy.bottomRows(tail) = columns.bottomRows(tail);

  if (rule_.family) {
    const auto at = [&](double l) -> std::optional<Vector> {
      const auto [system, W] = rule_.family(l);
      Vector r;
      if (!equilibrium_residual(system, piece, z, {system.commands, W}, work_, r))
        return std::nullopt;
      return r;
    };
    const auto rate = six_point_derivative(at, lambda, rule_.family_step);
    if (!rate) return false;
    dF_dlambda = reduce_rows(*rate);
    return true;
  }
  Vector rate = A_.middleCols(t_, d_) * rule_.t_rate + dR_drho_ * rule_.rho_rate;
  if (!rule_.W_rate.isZero(0)) rate += load_columns(system_, z) * rule_.W_rate;
  dF_dlambda = reduce_rows(rate);
  return true;
}

bool PathProblem::switches(const Vector& y, double lambda, Vector& g) const {
  const auto& list = system(lambda).switches;
  g.resize(static_cast<Index>(list.size()));
  for (Index j = 0; j < g.size(); ++j) {
    const statics::Switch& s = list[static_cast<std::size_t>(j)];
    g[j] = y[s.coordinate] - s.breakpoint;
  }
  return g.allFinite();
}

std::optional<Vector> PathProblem::breakpoints(double lambda) const {
  const auto family = rule_.family(lambda);
  Vector b(static_cast<Index>(family.first.switches.size()));
  for (Index j = 0; j < b.size(); ++j)
    b[j] = family.first.switches[static_cast<std::size_t>(j)].breakpoint;
  return b;
}

bool PathProblem::switch_gradients(const Vector& y, double lambda, Matrix& dg_dy,
                                   Vector& dg_dlambda) const {
  const auto& list = system(lambda).switches;
  const auto m = static_cast<Index>(list.size());
  dg_dy = Matrix::Zero(m, y.size());
  dg_dlambda = Vector::Zero(m);
  for (Index j = 0; j < m; ++j) dg_dy(j, list[static_cast<std::size_t>(j)].coordinate) = 1;
  if (!rule_.family || m == 0) return true;
  const auto rate =
      six_point_derivative([this](double l) { return breakpoints(l); }, lambda, rule_.family_step);
  if (!rate) return false;
  dg_dlambda = -*rate;
  return true;
}

Vector PathProblem::metric() const {
  Vector weights = Vector::Ones(size_);
  for (Index i = 0; i < t_; ++i)
    if (system_.is_wrench[static_cast<std::size_t>(i)]) weights[i] = 0;
  return weights;
}

std::vector<bool> PathProblem::angles() const {
  const Index free = rule_.N.cols(), shift = free - d_;
  std::vector<bool> angles(static_cast<std::size_t>(size_), false);
  for (Index i = 0; i < system_.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (system_.is_wrench[k] || system_.is_length[k] || (i >= t_ && i < t_ + d_)) continue;
    angles[static_cast<std::size_t>(i < t_ ? i : i + shift)] = true;
  }
  // A free pose coordinate is an angle only if no other one takes part in it.
  for (Index c = 0; c < free; ++c)
    for (Index r = 0; r < d_; ++r)
      if (!system_.is_length[static_cast<std::size_t>(t_ + r)] &&
          std::abs(std::abs(rule_.N(r, c)) - 1) < 1e-14)
        angles[static_cast<std::size_t>(t_ + c)] = true;
  return angles;
}

Vector PathProblem::periods() const {
  const std::vector<bool> is_angle = angles();
  Vector periods = Vector::Zero(size_);
  for (Index i = 0; i < size_; ++i)
    if (is_angle[static_cast<std::size_t>(i)]) periods[i] = 2 * std::numbers::pi;
  // Joints stand before all poses, at the same place in y and in z.
  for (const statics::CoordinateSpring& spring : system_.springs) periods[spring.coordinate] = 0;
  for (const statics::CoordinateGroup& group : system_.coupled)
    for (const Index i : group.coordinates) periods[i] = 0;
  for (std::size_t b = 0; b < system_.body_slices.size(); ++b) {
    if (system_.mechanism.bodies[b].task_space != model::TaskSpace::spatial) continue;
    const statics::BodySlice& body = system_.body_slices[b];
    const Index shift = body.t > t_ ? rule_.N.cols() - d_ : 0;
    const Index count = body.t == t_ ? rule_.N.cols() : body.count;
    periods.segment(body.t + shift, count).setZero();  // rotation vectors
  }
  return periods;
}

std::string PathProblem::switch_name(Index j) const {
  const statics::Switch& s = system_.switches[static_cast<std::size_t>(j)];
  const statics::CoordinateSpring& spring = system_.springs[s.spring];
  const auto i = static_cast<std::size_t>(j - spring.first_switch);
  const double below = spring.law.segments[i].stiffness;
  const double above = spring.law.segments[i + 1].stiffness;
  const char* what = below == 0      ? "acts above "
                     : above == 0    ? "acts below "
                     : above > below ? "is stiffer above "
                                     : "is stiffer below ";
  const bool is_length = system_.is_length[static_cast<std::size_t>(s.coordinate)];
  return "spring " + spring.name + " (" + what +
         rounded(s.breakpoint * (is_length ? rule_.length : 1)) + ")";
}

}  // namespace springfold::analysis
