#include "path_problem.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "quaternion.hpp"
#include "springfold/continuation/problem.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {

static_assert(continuation::PiecewiseSmoothProblem<PathProblem>);

PathProblem::PathProblem(statics::System system, const PathRule& rule)
    : PathProblem(std::make_shared<const statics::System>(std::move(system)), rule) {}

PathProblem::PathProblem(std::shared_ptr<const statics::System> system, const PathRule& rule)
    : kept_{std::move(system)}, system_{*kept_} {
  renew(rule);
}

void PathProblem::renew(const PathRule& rule) {
  rule_ = rule;
  rotations_.clear();
  family_.reset();
  stages_.reset();
  const auto& body = system_.body_slices[static_cast<std::size_t>(rule_.body - 1)];
  t_ = body.t;
  d_ = body.count;
  plain_size_ = system_.size - d_ + rule_.N.cols();
  assert(rule_.N.rows() == d_);
  is_whole_ = rule_.N.cols() == d_ && rule_.N.isIdentity(0);
  moves_pose_ = !rule_.t_rate.isZero(0);
  moves_commands_ = !rule_.rho_rate.isZero(0);
  moves_wrench_ = !rule_.W_rate.isZero(0);
  moves_loads_ = !rule_.load_rate.isZero(0);
  find_free_rotations();
  if (!rotations_.empty()) turned_ = system_;
  find_stages();
  knows_second_ =
      !rule_.family && rotations_.empty() && !stages_ && has_second_derivatives(system_);
  for (KnownMatrix& known : known_) {
    known.lambda = std::numeric_limits<double>::quiet_NaN();
    if (is_whole() || stages_) continue;
    known.y.resize(size_);
    known.piece.reserve(system_.switches.size());
    known.A.resize(system_.size, system_.size);
  }
}

/// All rotations of the other spatial bodies, and of the study's body if it turns as it likes: the
/// last columns of N are then its rotation vector.
void PathProblem::find_free_rotations() {
  const Index free = rule_.N.cols(), shift = free - d_;
  place_.assign(static_cast<std::size_t>(plain_size_), 0);
  for (std::size_t b = 0; b < system_.body_slices.size(); ++b) {
    const statics::BodySlice& body = system_.body_slices[b];
    if (system_.mechanism.bodies[b].task_space != model::TaskSpace::spatial || !rule_.quaternions)
      continue;
    if (body.t == t_) {
      const bool turns_freely = free >= 3 && rule_.N.bottomRightCorner(3, 3).isIdentity(0) &&
                                rule_.N.bottomLeftCorner(3, free - 3).isZero(0) &&
                                rule_.N.topRightCorner(3, 3).isZero(0) &&
                                rule_.t_rate.tail(3).isZero(0);
      if (turns_freely) rotations_.push_back({t_ + 3, t_ + free - 3, 0, b});
    } else {
      rotations_.push_back({body.t + 3, body.t + 3 + (body.t > t_ ? shift : 0), 0, b});
    }
  }
  size_ = 0;
  for (Index v = 0; v < plain_size_; ++v) {
    const auto rotation = std::find_if(rotations_.begin(), rotations_.end(),
                                       [v](const auto& r) { return r.v <= v && v < r.v + 3; });
    const bool turns = rotation != rotations_.end();
    place_[static_cast<std::size_t>(v)] = turns ? -1 : size_;
    if (turns && v == rotation->v) rotation->y = size_;
    size_ += !turns ? 1 : v == rotation->v ? 4 : 0;
  }
}

const statics::System& PathProblem::system(double lambda) const {
  if (!rule_.family) return system_;
  if (!family_ || family_lambda_ != lambda) {
    family_ = rule_.family(lambda);
    family_lambda_ = lambda;
    const statics::System& now = family_->first;
    if (now.size != system_.size || now.switches.size() != system_.switches.size() ||
        now.closure_count() != system_.closure_count() ||
        now.body_slices.size() != system_.body_slices.size())
      throw std::invalid_argument(
          "the mechanism changes its shape along the parameter: its joints, bodies, springs and "
          "breakpoints must "
          "stay the same in number");
    if (!rotations_.empty()) turned_ = family_->first;
  }
  return family_->first;
}

const statics::System& PathProblem::turned(const Vector& y, double lambda) const {
  const statics::System& plain = system(lambda);
  if (rotations_.empty()) return plain;
  turn_frames(plain, frames(y), turned_);
  return turned_;
}

const statics::System& PathProblem::turned_to_pose(const Vector& y, double lambda,
                                                   Vector& z) const {
  const statics::System& plain = system(lambda);
  put_expanded(y, lambda, nullptr, z);
  std::vector<model::Mat3<double>>& list = frames_;
  list.assign(plain.body_slices.size(), model::Mat3<double>::Identity());
  bool any = false;
  for (std::size_t b = 0; b < list.size(); ++b) {
    if (plain.mechanism.bodies[b].task_space != model::TaskSpace::spatial) continue;
    auto phi = z.segment<3>(plain.body_slices[b].t + 3);
    list[b] = model::exp_rotation<double>(model::Vec3<double>(phi));
    phi.setZero();
    any = true;
  }
  if (!any) return plain;
  if (rotations_.empty()) turned_ = plain;
  turn_frames(plain, list, turned_);
  return turned_;
}

Turns PathProblem::turns(const Vector& y, const Turns* before) const {
  constexpr double clear_of_whole_turns = 0.5;
  Turns list;
  for (std::size_t k = 0; k < rotations_.size(); ++k) {
    const Quaternion q = y.segment<4>(rotations_[k].y);
    const RotationVector phi = rotation_vector_of(q);
    Turn turn{phi, phi, q};
    if (before != nullptr) {
      const Turn& last = (*before)[k];
      const Rotation motion = rotation_of(q) * rotation_of(last.q).transpose();
      turn.expected = last.expected + model::log_rotation<double>(motion);
      turn.phi = nearest_turn(phi, turn.expected);
    }
    if (std::abs(std::remainder(phi.norm(), 2 * std::numbers::pi)) > clear_of_whole_turns)
      turn.expected = turn.phi;
    list.push_back(turn);
  }
  return list;
}

Vector PathProblem::expand(const Vector& y, double lambda, const Turns* turns_of_y) const {
  Vector z;
  put_expanded(y, lambda, turns_of_y, z);
  return z;
}

void PathProblem::put_expanded(const Vector& y, double lambda, const Turns* turns_of_y,
                               Vector& z) const {
  put_local(y, lambda, z);
  if (rotations_.empty()) return;
  const Turns phi = turns_of_y != nullptr ? *turns_of_y : turns(y);
  for (std::size_t k = 0; k < rotations_.size(); ++k) z.segment<3>(rotations_[k].z) = phi[k].phi;
}

Vector PathProblem::expand_rate(const Vector& y, const Vector& dy, double dlambda,
                                const Turns* turns_of_y) const {
  Vector dz = local_rate(y, dy, dlambda);
  const Turns phi = turns_of_y != nullptr ? *turns_of_y : turns(y);
  for (std::size_t k = 0; k < rotations_.size(); ++k) {
    const Index z = rotations_[k].z;
    dz.segment<3>(z) =
        model::inverse_left_jacobian(phi[k].phi) * model::Vec3<double>(dz.segment<3>(z));
  }
  return dz;
}

bool PathProblem::switches(const Vector& y, double lambda, Vector& g) const {
  const auto& list = system(lambda).switches;
  g.resize(static_cast<Index>(list.size()));
  for (Index j = 0; j < g.size(); ++j) {
    const statics::Switch& s = list[static_cast<std::size_t>(j)];
    if (s.of_shape()) return put_shape_switches(y, lambda, j, g);  // they stand behind the others
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
  Index joints = 0;
  for (; joints < m && !list[static_cast<std::size_t>(joints)].of_shape(); ++joints)
    dg_dy(joints, list[static_cast<std::size_t>(joints)].coordinate) = 1;
  if (joints < m && !put_shape_gradients(y, lambda, joints, dg_dy, dg_dlambda)) return false;
  if (!rule_.family || m == 0) return true;
  const auto rate = joints < m ? six_point_derivative([&](double l) { return switches_at(y, l); },
                                                      lambda, rule_.family_step)
                               : six_point_derivative([this](double l) { return breakpoints(l); },
                                                      lambda, rule_.family_step);
  if (!rate) return false;
  dg_dlambda = joints < m ? *rate : Vector(-*rate);
  return true;
}

Vector PathProblem::metric() const {
  Vector weights = Vector::Ones(plain_size_);
  for (Index i = 0; i < t_; ++i)
    if (system_.is_wrench[static_cast<std::size_t>(i)]) weights[i] = 0;
  Vector metric;
  spread(weights, metric);
  for (const FreeRotation& r : rotations_) metric.segment<4>(r.y).setConstant(4);  // |dq| = angle/2
  return metric;
}

std::vector<bool> PathProblem::angles() const {
  const Index free = rule_.N.cols(), shift = free - d_;
  Vector angles = Vector::Zero(plain_size_);
  for (Index i = 0; i < system_.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (system_.is_wrench[k] || system_.is_length[k] || (i >= t_ && i < t_ + d_)) continue;
    angles[i < t_ ? i : i + shift] = 1;
  }
  // A free pose coordinate is an angle only if no other one takes part in it.
  for (Index c = 0; c < free; ++c)
    for (Index r = 0; r < d_; ++r)
      if (!system_.is_length[static_cast<std::size_t>(t_ + r)] &&
          std::abs(std::abs(rule_.N(r, c)) - 1) < 1e-14)
        angles[t_ + c] = 1;
  std::vector<bool> list;
  Vector in_y;
  spread(angles, in_y);
  for (const double angle : in_y) list.push_back(angle > 0);
  return list;
}

Vector PathProblem::periods() const {
  Vector periods = Vector::Zero(plain_size_);
  const std::vector<bool> is_angle = angles();
  for (Index i = 0; i < plain_size_; ++i)
    if (const Index p = place_[static_cast<std::size_t>(i)];
        p >= 0 && is_angle[static_cast<std::size_t>(p)])
      periods[i] = 2 * std::numbers::pi;
  // Joints stand before all poses, at the same place in y and in z.
  // A stiffness of 0 leaves an angle as free as no spring does, if it stays so.
  for (const statics::CoordinateSpring& spring : system_.springs)
    if (rule_.family || !spring.law.is_free()) periods[spring.coordinate] = 0;
  for (const statics::CoordinateGroup& group : system_.coupled)
    for (const Index i : group.coordinates) periods[i] = 0;
  if (system_.mechanism.bodies[static_cast<std::size_t>(rule_.body - 1)].task_space ==
      model::TaskSpace::spatial)
    periods.segment(t_, rule_.N.cols()).setZero();  // rotation vectors
  Vector in_y;
  spread(periods, in_y);
  return in_y;
}

std::vector<Index> PathProblem::double_covers() const {
  std::vector<Index> list;
  for (const FreeRotation& r : rotations_) list.push_back(r.y);
  return list;
}

std::string PathProblem::switch_name(Index j) const {
  const statics::Switch& s = system_.switches[static_cast<std::size_t>(j)];
  if (s.of_shape()) return shape_switch_name(s, j);
  const statics::CoordinateSpring& spring = system_.springs[s.spring];
  const auto i = static_cast<std::size_t>(j - spring.first_switch);
  const double below = spring.law.stiffness(i, s.breakpoint);
  const double above = spring.law.stiffness(i + 1, s.breakpoint);
  const bool nothing_below = below == 0 && spring.law.is_straight(i);
  const bool nothing_above = above == 0 && spring.law.is_straight(i + 1);
  const char* what = nothing_below   ? "acts above "
                     : nothing_above ? "acts below "
                     : above > below ? "is stiffer above "
                                     : "is stiffer below ";
  const bool is_length = system_.is_length[static_cast<std::size_t>(s.coordinate)];
  return "spring " + spring.name + " (" + what +
         rounded(s.breakpoint * (is_length ? rule_.length : 1)) + ")";
}

}  // namespace springfold::analysis
