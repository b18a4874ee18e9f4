#include <algorithm>
#include <cmath>

#include "springfold/core/scaling.hpp"
#include "stage_chain.hpp"

namespace springfold::statics {
namespace {

using model::CompiledChain;
using model::Vec3;

/// So many joints may be far softer than the others without setting the scale.
constexpr Index few_soft_joints = 8;

/// Rows of a chain's end, columns of a body's root unknowns: on the stack.
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 8>;

}  // namespace

void scale_chain(const StagePlan& plan, const System& system, std::size_t i, StageMatrix& matrix) {
  const ChainStages& stages = plan.chains[i];
  const ChainSlice& slice = system.chain_slices[i];
  const ChainSums& sums = matrix.sums[i];
  const Index from = system.chains[i].first_joint(), n = slice.x_count, r = stages.rank;
  Vector& scale = matrix.scale;
  std::vector<double>&diagonal = matrix.diagonal, &sorted = matrix.sorted;
  diagonal.assign(static_cast<std::size_t>(n), 0.0);
  for (const StageGroup& entry : stages.groups) {
    const CoordinateGroup& group = system.coupled[entry.group];
    for (std::size_t a = 0; a < group.coordinates.size(); ++a)
      diagonal[static_cast<std::size_t>(group.coordinates[a] - slice.x)] +=
          group.stiffness(static_cast<Index>(a), static_cast<Index>(a));
  }
  for (Index a = 0; a < n; ++a) {
    const Index k = from + stages.joints[static_cast<std::size_t>(a)];
    double& entry = diagonal[static_cast<std::size_t>(a)];
    entry =
        std::abs(entry + matrix.stiffness[slice.x + a] - sums.turn.col(k).dot(sums.moment.col(k)));
  }
  double usual = 1;
  if (n > 0) {
    sorted = diagonal;
    const auto middle = sorted.begin() + std::min(few_soft_joints, (n - 1) / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    usual = *middle > 0 ? *middle : *std::max_element(diagonal.begin(), diagonal.end());
    if (!(usual > 0) || !std::isfinite(usual)) usual = 1;
  }
  Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();
  Vec3<double> turn = Vec3<double>::Zero();
  for (Index a = 0; a < n; ++a) {
    const Index k = from + stages.joints[static_cast<std::size_t>(a)];
    const double stiffness = std::max(diagonal[static_cast<std::size_t>(a)], usual);
    scale[slice.x + a] = power_of_two_near(1 / std::sqrt(stiffness));
    for (Index c = 0; c < slice.F_count; ++c) wrench[c] += sums.J(c, k) * sums.J(c, k) / stiffness;
    turn += sums.turn.col(k).cwiseAbs2() / stiffness;
  }
  const auto inverse_root = [](double v) {
    return v > 0 && std::isfinite(v) ? power_of_two_near(1 / std::sqrt(v)) : 1.0;
  };
  // A stretched chain does not give way to a force along it, but for rounding.
  const double stiff = 1e-4 * wrench.maxCoeff();
  for (Index c = 0; c < slice.F_count; ++c)
    scale[slice.F + c] = inverse_root(std::max(wrench[c], stiff));
  // moment and turn that come into a stage: their product has size one, and so have the larger of
  // compliance and of the loads' part in the stage.
  const bool moves = system.chains[i].from_moves;
  for (Index s = moves ? 0 : 1; s < stages.stage_count(); ++s) {
    const Index own = stages.auxiliary + 2 * r * (moves ? s : s - 1);
    for (Index c = 0; c < r; ++c) {
      const Index axis = r == 1 ? 2 : c;
      double loads = 0;
      for (Index a = stages.first[static_cast<std::size_t>(s)];
           a < stages.first[static_cast<std::size_t>(s) + 1]; ++a) {
        const Index k = from + stages.joints[static_cast<std::size_t>(a)];
        loads = std::max(loads, std::abs(sums.moment(axis, k)) * scale[slice.x + a]);
      }
      const double size =
          std::max(inverse_root(turn[axis]), loads > 0 ? power_of_two_near(loads) : 0.0);
      scale[own + c] = size;
      scale[own + r + c] = 1 / size;
    }
  }
}

namespace {

/// The lower triangle of one front, order as in the plan.
class StageFiller {
 public:
  StageFiller(const StagePlan& plan, const System& system, std::size_t i, StageMatrix& matrix)
      : plan_{plan},
        stages_{plan.chains[i]},
        slice_{system.chain_slices[i]},
        chain_{system.chains[i]},
        system_{system},
        sums_{matrix.sums[i]},
        matrix_{matrix},
        from_basis_{matrix.from_basis[i]},
        to_basis_{matrix.to_basis[i]},
        r_{stages_.rank},
        c0_{stages_.rank == 1 ? 2 : 0} {}

  void fill() {
    group_ = 0;
    for (Index s = 0; s < stages_.stage_count(); ++s) {
      begin(s);
      add_coordinates(s);
      add_sums(s);
      if (s == 0 && chain_.from_moves) add_front_body();
      if (s + 1 == stages_.stage_count() && chain_.to_moves) add_end_body(s);
      apply_scale(s);
    }
  }

 private:
  void begin(Index s) {
    const auto f = stages_.first_front + static_cast<std::size_t>(s);
    const auto& pattern = plan_.pattern;
    size_ = static_cast<Index>(pattern.first_variable[f + 1] - pattern.first_variable[f]);
    values_ = matrix_.values.data() + pattern.first_value[f];
    std::fill(values_, values_ + size_ * size_, 0.0);
    first_ = stages_.first[static_cast<std::size_t>(s)];
    m_ = stages_.first[static_cast<std::size_t>(s) + 1] - first_;
    const bool in = chain_.from_moves || s > 0, out = s + 1 < stages_.stage_count();
    moment_ = in ? m_ : -1;
    turn_ = in ? m_ + r_ : -1;
    next_ = out ? m_ + (in ? 2 * r_ : 0) : -1;
    F_ = m_ + (in ? 2 * r_ : 0) + (out ? r_ : 0);
    pose_ = F_ + slice_.F_count;
  }
  double& at(Index row, Index column) { return values_[column * size_ + row]; }
  Index column_of(Index a) const {
    return chain_.first_joint() + stages_.joints[static_cast<std::size_t>(first_ + a)];
  }

  void add_coordinates(Index s) {
    for (Index b = 0; b < m_; ++b) {
      const Index kb = column_of(b);
      const double* turn = sums_.turn.data() + 3 * kb;
      for (Index a = b; a < m_; ++a) {
        const double* moment = sums_.moment.data() + 3 * column_of(a);
        at(a, b) = -(turn[0] * moment[0] + turn[1] * moment[1] + turn[2] * moment[2]);
      }
      at(b, b) += matrix_.stiffness[slice_.x + first_ + b];
      for (Index c = 0; c < slice_.F_count; ++c) at(F_ + c, b) = -sums_.J(c, kb);
    }
    for (; group_ < stages_.groups.size() && stages_.groups[group_].stage == s; ++group_) {
      const CoordinateGroup& group = system_.coupled[stages_.groups[group_].group];
      const auto n = group.coordinates.size();
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          const Index a = group.coordinates[i] - slice_.x - first_;
          const Index b = group.coordinates[j] - slice_.x - first_;
          if (a >= b) at(a, b) += group.stiffness(static_cast<Index>(i), static_cast<Index>(j));
        }
    }
  }

  /// turn . (moment - next - sum moment_k x_k) and - x . turn_k next.
  void add_sums(Index) {
    for (Index c = 0; c < r_; ++c) {
      if (moment_ >= 0) at(turn_ + c, moment_ + c) = 1;
      if (moment_ >= 0 && next_ >= 0) at(next_ + c, turn_ + c) = -1;
      for (Index b = 0; b < m_; ++b) {
        const Index k = column_of(b);
        if (moment_ >= 0) at(turn_ + c, b) = -sums_.moment(c0_ + c, k);
        if (next_ >= 0) at(next_ + c, b) = -sums_.turn(c0_ + c, k);
      }
    }
  }

  void add_front_body() {
    const Index from = chain_.first_joint();
    const Small moment = -sums_.turn.leftCols(from) * from_basis_;
    const Small wrench = -sums_.J.leftCols(from) * from_basis_;
    for (Index v = 0; v < from_basis_.cols(); ++v) {
      for (Index c = 0; c < r_; ++c) at(pose_ + v, moment_ + c) = moment(c0_ + c, v);
      for (Index c = 0; c < slice_.F_count; ++c) at(pose_ + v, F_ + c) = wrench(c, v);
    }
  }

  void add_end_body(Index s) {
    const Index first = pose_ + (s == 0 && chain_.from_moves ? from_basis_.cols() : 0);
    const Small moment = -sums_.to_moment * to_basis_, wrench = -sums_.J_to * to_basis_;
    for (Index v = 0; v < to_basis_.cols(); ++v) {
      for (Index b = 0; b < m_; ++b)
        at(first + v, b) = sums_.turn.col(column_of(b)).dot(moment.col(v));
      for (Index c = 0; turn_ >= 0 && c < r_; ++c) at(first + v, turn_ + c) = moment(c0_ + c, v);
      for (Index c = 0; c < slice_.F_count; ++c) at(first + v, F_ + c) = wrench(c, v);
    }
  }

  void apply_scale(Index s) {
    const auto f = stages_.first_front + static_cast<std::size_t>(s);
    const Index* ids = plan_.pattern.variables.data() + plan_.pattern.first_variable[f];
    for (Index c = 0; c < size_; ++c)
      for (Index row = c; row < size_; ++row)
        at(row, c) *= matrix_.scale[ids[row]] * matrix_.scale[ids[c]];
  }

  const StagePlan& plan_;
  const ChainStages& stages_;
  const ChainSlice& slice_;
  const CompiledChain& chain_;
  const System& system_;
  const ChainSums& sums_;
  StageMatrix& matrix_;
  const Matrix &from_basis_, &to_basis_;
  Index r_, c0_;
  std::size_t group_ = 0;
  double* values_ = nullptr;
  Index size_ = 0, first_ = 0, m_ = 0, moment_ = -1, turn_ = -1, next_ = -1, F_ = 0, pose_ = 0;
};

}  // namespace

void fill_chain(const StagePlan& plan, const System& system, std::size_t i, StageMatrix& matrix) {
  StageFiller(plan, system, i, matrix).fill();
}

}  // namespace springfold::statics
