#include "stage_chain.hpp"

#include <cmath>

namespace springfold::statics {
namespace {

using model::CompiledChain;
using model::cross;
using model::dot;
using model::LoadKind;
using model::Mat3;
using model::Pose;
using model::TaskSpace;
using model::Vec3;

double displacement(const ChainSlice& slice, std::size_t j, const Vector& z, const Vector& rho) {
  const Index x = slice.joint_coordinate[j], command = slice.joint_command[j];
  return (x >= 0 ? z[x] : 0.0) + (command >= 0 ? rho[command] : 0.0);
}

/// Two numbers instead of nine where all axes are along z.
Pose<double> walk_in_plane(const CompiledChain& chain, const ChainSlice& slice, const Vector& z,
                           const Vector& rho, Pose<double> frame, ChainSums& out) {
  const auto n = chain.joints.size();
  const Index from = chain.first_joint();
  double c = frame.R(0, 0), s = frame.R(1, 0), x = frame.p[0], y = frame.p[1];
  const auto put = [&](Pose<double>& to) {
    to.R << c, -s, 0, s, c, 0, 0, 0, 1;
    to.p << x, y, 0;
  };
  const auto turn_by = [&](double cosine, double sine) {
    const double turned = c * cosine - s * sine;
    s = s * cosine + c * sine;
    c = turned;
  };
  for (std::size_t j = 0; j < n; ++j) {
    const auto& step = chain.joints[j];
    const Index k = from + static_cast<Index>(j);
    const double v = displacement(slice, j, z, rho);
    const Vec3<double>& link = step.before.p;
    x += c * link[0] - s * link[1];
    y += s * link[0] + c * link[1];
    turn_by(step.before.R(0, 0), step.before.R(1, 0));
    put(out.frames[j]);
    if (step.revolute) {
      out.dp.col(k) << 0, 0, step.axis[2];
      out.turn.col(k) << 0, 0, step.axis[2];
      turn_by(std::cos(v), step.axis[2] * std::sin(v));
    } else {
      const double along = c * step.axis[0] - s * step.axis[1];
      const double across = s * step.axis[0] + c * step.axis[1];
      out.dp.col(k) << along, across, 0;
      out.turn.col(k).setZero();
      x += v * along;
      y += v * across;
    }
  }
  put(out.frames[n]);
  return out.frames[n] * chain.last;
}

/// Frames out to the end; turn and dp hold axis and origin until the way back.
Pose<double> walk_out(const CompiledChain& chain, const ChainSlice& slice, const Vector& z,
                      const Vector& rho, Pose<double> frame, ChainSums& out) {
  const auto n = chain.joints.size();
  const Index from = chain.first_joint();
  out.frames.resize(n + 1);
  if (chain.flat) return walk_in_plane(chain, slice, z, rho, frame, out);
  for (std::size_t j = 0; j < n; ++j) {
    const auto& step = chain.joints[j];
    const Index k = from + static_cast<Index>(j);
    const double v = displacement(slice, j, z, rho);
    frame = frame * step.before;
    const Vec3<double> axis = frame.R * step.axis;
    out.frames[j] = frame;
    out.dp.col(k) = axis;
    if (step.revolute) {
      out.turn.col(k) = axis;
      frame.R = frame.R * model::rotation_about(step.axis, v);
    } else {
      out.turn.col(k).setZero();
      frame.p += v * axis;
    }
  }
  out.frames[n] = frame;
  return frame * chain.last;
}

/// The chain as one rigid link between its end bodies: closure and everything about their poses.
CompiledChain rigid(const CompiledChain& chain, const Pose<double>& front,
                    const Pose<double>& end) {
  CompiledChain link;
  link.space = chain.space;
  link.from_space = chain.from_space;
  link.to_space = chain.to_space;
  link.from_moves = chain.from_moves;
  link.to_moves = chain.to_moves;
  link.to_attachment = chain.to_attachment;
  link.last = {front.R.transpose() * end.R, front.R.transpose() * (end.p - front.p)};
  return link;
}

/// Wrench of the closure: force, and what the rotation's logarithm makes of the moment.
struct EndWrench {
  Vec3<double> f = Vec3<double>::Zero(), h = Vec3<double>::Zero();
  Mat3<double> log_J = Mat3<double>::Identity(), log_S = Mat3<double>::Zero();

  bool spatial = false;

  EndWrench(const CompiledChain& chain, const Vector& F, const Vector& e)
      : spatial{chain.space == TaskSpace::spatial} {
    f.head(translations(chain.space)) = F.head(translations(chain.space));
    if (!spatial) return;
    const Vec3<double> phi = e.tail(3), moment = F.tail(3);
    log_J = model::inverse_left_jacobian(phi);
    log_S = model::log_hessian(phi, moment);
    h = log_J.transpose() * moment;
  }
  Vec3<double> moment_rate(const Vec3<double>& dp, const Vec3<double>& turn) const {
    if (!spatial) return cross<double>(dp, f);
    return cross<double>(dp, f) + 0.5 * cross<double>(turn, h) + log_S * turn;
  }
};

void set_column(const CompiledChain& chain, const EndWrench& wrench, const Vec3<double>& dp,
                const Vec3<double>& turn, Matrix& J, Index k) {
  const Index lengths = translations(chain.space);
  for (Index r = 0; r < lengths; ++r) J(r, k) = dp[r];
  if (chain.space == TaskSpace::planar) J(2, k) = turn[2];
  if (chain.space == TaskSpace::spatial) J.col(k).tail(3) = wrench.log_J * turn;
}

/// Loads outboard of a place: force, moment of couples, and arm x force as a tensor.
struct Outboard {
  Vec3<double> force = Vec3<double>::Zero(), couple = Vec3<double>::Zero();
  Mat3<double> T = Mat3<double>::Zero();  ///< sum of (p - at) f^T
  Vec3<double> at = Vec3<double>::Zero();

  void move_to(const Vec3<double>& place) {
    T += (at - place) * force.transpose();
    at = place;
  }
  void add(const Vec3<double>& p, const Vec3<double>& f) {
    T += (p - at) * f.transpose();
    force += f;
  }
  Vec3<double> moment() const {
    return couple + Vec3<double>(T(1, 2) - T(2, 1), T(2, 0) - T(0, 2), T(0, 1) - T(1, 0));
  }
  /// sum of (turn x arm) x f.
  Vec3<double> moment_rate(const Vec3<double>& turn) const { return T * turn - T.trace() * turn; }
};

void add_load(const System& system, const StageLoad& entry, const Inputs& inputs,
              const Pose<double>& frame, Outboard& sum) {
  const PointLoad& load = system.loads[entry.load];
  const Pose<double> at = frame * system.points[load.point].point.last;
  const double factor = load.number < 0 || inputs.loads.size() == 0 ? 1 : inputs.loads[load.number];
  const Vec3<double> vector = factor * load.vector;
  const Vec3<double> world = load.follows ? Vec3<double>(at.R * vector) : vector;
  if (load.kind == LoadKind::force)
    sum.add(at.p, world);
  else
    sum.couple += world;
}

/// Second derivatives of the loads' work by the front body's rotation, and its generalised forces.
void add_front_loads(const CompiledChain& chain, const model::detail::BodyFrame<double>& front,
                     const Outboard& sum, ChainSums& out) {
  const Index lengths = translations(chain.from_space), count = chain.first_joint();
  for (Index i = 0; i < lengths; ++i) out.force_from[i] = sum.force[i];
  for (Index i = lengths; i < count; ++i) {
    const Vec3<double> a = out.turn.col(i);
    out.force_from[i] = a.dot(sum.moment());
    for (Index k = lengths; k < count; ++k) {
      const Vec3<double> b = out.turn.col(k);
      double value = 0.5 * (a.dot(sum.T * b) + b.dot(sum.T * a)) - a.dot(b) * sum.T.trace();
      if (chain.from_space == TaskSpace::spatial)
        value += model::detail::second_rotation(front.dJ_l, static_cast<int>(i - lengths),
                                                static_cast<int>(k - lengths))
                     .dot(sum.moment() - sum.couple);
      out.H_from(i, k) += value;
    }
  }
}

/// The way back: loads gathered from the end inwards.
void add_loads(const ChainStages& stages, const System& system, const CompiledChain& chain,
               const model::detail::BodyFrame<double>& front, const Inputs& inputs,
               ChainSums& out) {
  const Index from = chain.first_joint();
  Outboard sum;
  sum.at = out.frames.back().p;
  std::size_t l = 0;
  const auto frame_of = [&](Index joints) -> Pose<double> {  // behind so many joints
    if (joints == 0) return front.pose;
    const auto j = static_cast<std::size_t>(joints);
    if (j == chain.joints.size()) return out.frames[j];
    // the frame before the next joint, without the rigid link between them
    const Pose<double>& before = chain.joints[j].before;
    const Mat3<double> R = out.frames[j].R * before.R.transpose();
    return {R, out.frames[j].p - R * before.p};
  };
  for (Index j = chain.joint_count(); j-- > 0;) {
    for (; l < stages.loads.size() && stages.loads[l].joints > j; ++l)
      add_load(system, stages.loads[l], inputs, frame_of(stages.loads[l].joints), sum);
    const Vec3<double> turn = out.turn.col(from + j);
    sum.move_to(out.frames[static_cast<std::size_t>(j)].p);
    if (chain.joints[static_cast<std::size_t>(j)].revolute) {
      out.moment.col(from + j) += sum.moment_rate(turn);
      out.force[from + j] = turn.dot(sum.moment());
    } else {
      const Vec3<double> along = out.dp.col(from + j);
      out.moment.col(from + j) += cross<double>(along, sum.force);
      out.force[from + j] = along.dot(sum.force);
    }
  }
  if (from == 0) return;
  for (; l < stages.loads.size(); ++l) add_load(system, stages.loads[l], inputs, front.pose, sum);
  sum.move_to(front.pose.p);
  add_front_loads(chain, front, sum, out);
}

}  // namespace

void evaluate_chain(const ChainStages& stages, const System& system, std::size_t i, const Vector& z,
                    const Inputs& inputs, ChainSums& out) {
  const CompiledChain& chain = system.chains[i];
  const ChainSlice& slice = system.chain_slices[i];
  const Index from = chain.first_joint(), to = chain.to_count(), n = chain.first_to();
  out.turn.resize(3, n);
  out.dp.resize(3, n);
  out.moment.resize(3, n);
  out.J.resize(chain.dimension(), n);
  out.force.setZero(n);
  out.force_from.setZero(from);
  Vector& poses = out.end_poses;
  poses.resize(from + to);
  model::detail::BodyFrame<double> front;
  if (chain.from_moves) {
    poses.head(from) = z.segment(slice.from, from);
    front = model::detail::body_frame<double>(chain.from_space, poses.head(from), true);
  }
  if (chain.to_moves) poses.tail(to) = z.segment(slice.to, to);
  const Pose<double> end = walk_out(chain, slice, z, inputs.rho, front.pose, out);

  Vector& F = out.wrench;
  F = z.segment(slice.F, slice.F_count);
  model::evaluate_closure<double>(rigid(chain, front.pose, end), poses, &F, out.ends);
  out.e = out.ends.e;
  const EndWrench wrench(chain, F, out.e);
  for (Index k = 0; k < from; ++k) {
    const auto& motion = out.ends.motions[static_cast<std::size_t>(k)];
    out.turn.col(k) = motion.spin;
    out.dp.col(k) = motion.dp;
    out.moment.col(k) = wrench.moment_rate(motion.dp, motion.spin);
    set_column(chain, wrench, motion.dp, motion.spin, out.J, k);
  }
  for (Index k = from; k < n; ++k) {
    const auto j = static_cast<std::size_t>(k - from);
    const Vec3<double> turn = out.turn.col(k);
    const Vec3<double> dp = chain.joints[j].revolute ? cross<double>(turn, end.p - out.frames[j].p)
                                                     : Vec3<double>(out.dp.col(k));
    out.moment.col(k) = wrench.moment_rate(dp, turn);
    set_column(chain, wrench, dp, turn, out.J, k);
  }
  out.to_moment.resize(3, to);
  for (Index k = 0; k < to; ++k) {
    const Vec3<double> omega = out.ends.motions[static_cast<std::size_t>(from + k)].omega;
    out.to_moment.col(k) = 0.5 * cross<double>(omega, wrench.h) + wrench.log_S * omega;
  }
  out.J_to = out.ends.J.rightCols(to);
  out.H_from = out.ends.H.topLeftCorner(from, from);
  out.H_to = out.ends.H.bottomRightCorner(to, to);
  if (!stages.loads.empty()) add_loads(stages, system, chain, front, inputs, out);
}

void add_chain_residual(const System& system, std::size_t i, const Vector& z, const ChainSums& sums,
                        Vector& residual) {
  const ChainSlice& slice = system.chain_slices[i];
  const CompiledChain& chain = system.chains[i];
  const Index from = chain.first_joint();
  const auto F = z.segment(slice.F, slice.F_count);
  residual.segment(slice.F, slice.F_count) -= sums.e;
  if (from > 0) {
    residual.segment(slice.from, from).noalias() -= sums.J.leftCols(from).transpose() * F;
    residual.segment(slice.from, from) -= sums.force_from;
  }
  if (chain.to_moves)
    residual.segment(slice.to, chain.to_count()).noalias() -= sums.J_to.transpose() * F;
  for (std::size_t j = 0; j < slice.joint_coordinate.size(); ++j) {
    const Index row = slice.joint_coordinate[j], k = from + static_cast<Index>(j);
    if (row < 0) continue;
    double value = sums.force[k];
    for (Index r = 0; r < slice.F_count; ++r) value += sums.J(r, k) * F[r];
    residual[row] -= value;
  }
}

}  // namespace springfold::statics
