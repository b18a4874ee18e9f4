#include "one_freedom.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

struct Parts {
  std::vector<Index> moving{}, wrenches{};
};

Parts parts_of(const statics::System& system) {
  Parts parts;
  for (Index i = 0; i < system.size; ++i)
    (system.is_wrench[static_cast<std::size_t>(i)] ? parts.wrenches : parts.moving).push_back(i);
  return parts;
}

/// A configuration and the way on from it.
struct Place {
  Vector z{}, tangent{};
  int orientation =
      0;  ///< of the closures' derivatives and the tangent: kept where they keep their rank
};

class Walk {
 public:
  explicit Walk(const PathProblem& problem)
      : problem_{problem}, parts_{parts_of(problem.system(0))}, periods_{problem.periods()} {}

  bool comes_back(const Vector& z) const {
    constexpr int most_steps = 5000;
    constexpr double longest = 0.05, shortest = 1e-4;
    const Vector any = Vector::LinSpaced(std::ssize(parts_.moving), 0.7, 1.3).normalized();
    const auto first = corrected(z, any);
    if (!first) return false;
    Place at = *first;
    double h = longest, before = 0;
    for (int step = 0; step < most_steps; ++step) {
      Vector z_next = at.z;
      z_next(parts_.moving) += h * at.tangent;
      const auto next = corrected(z_next, at.tangent);
      constexpr double least_cosine = 0.98;
      if (!next || next->tangent.dot(at.tangent) < least_cosine) {
        h /= 2;
        if (h < shortest) return false;
        continue;
      }
      if (next->orientation != first->orientation) return false;
      at = *next;
      const Vector way = from(first->z, at.z);
      const double along = way.dot(first->tangent);
      if (before < 0 && along >= 0 && way.norm() < 2 * longest) return true;
      before = along;
      h = std::min(2 * h, longest);
    }
    return false;
  }

 private:
  Vector from(const Vector& a, const Vector& b) const {
    Vector d = b - a;
    for (Index i = 0; i < d.size(); ++i)
      if (periods_[i] > 0) d[i] = std::remainder(d[i], periods_[i]);
    return d(parts_.moving);
  }

  /// The configuration beside z across the direction.
  std::optional<Place> corrected(Vector z, const Vector& direction) const {
    constexpr int most = 8;
    const auto m = std::ssize(parts_.wrenches);
    Matrix bordered(m + 1, m + 1);
    for (int i = 0; i < most; ++i) {
      Matrix A;
      Vector r, b;
      const Piece piece = statics::piece_at(problem_.system(0), z);
      if (!problem_.residual(z, 0, piece, r) || !problem_.derivatives(z, 0, piece, A, b))
        return std::nullopt;
      bordered << A(parts_.wrenches, parts_.moving), direction.transpose();
      const Lu factors(bordered);
      Vector right = Vector::Zero(m + 1);
      const bool is_closed =
          r(parts_.wrenches).lpNorm<Eigen::Infinity>() <= continuation::promised_place;
      if (is_closed)
        right[m] = 1;
      else
        right.head(m) = -r(parts_.wrenches);
      const Vector answer = factors.solve(right);
      if (!answer.allFinite()) return std::nullopt;
      if (is_closed) return Place{z, answer.normalized(), factors.sign()};
      z(parts_.moving) += answer;
    }
    return std::nullopt;
  }

  const PathProblem& problem_;
  Parts parts_;
  Vector periods_;
};

}  // namespace

bool has_one_bounded_freedom(const statics::System& system) {
  for (Index i = 0; i < system.first_pose; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!system.is_wrench[k] && system.is_length[k]) return false;
  }
  for (const model::Body& body : system.mechanism.bodies)
    if (body.task_space == model::TaskSpace::spatial) return false;
  const Parts parts = parts_of(system);
  return system.redundant == 0 && std::ssize(parts.moving) == std::ssize(parts.wrenches) + 1;
}

bool is_closed_curve(const PathProblem& problem, const Vector& z) {
  return Walk(problem).comes_back(z);
}

}  // namespace springfold::analysis
