#include "equilibrium_families.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// Lines are not walked in larger systems: each step factorises a dense matrix.
constexpr Index most_walked = 300;
/// A step is so long that a point beside a singular one, on no family, misses the equations by far.
constexpr double family_step = 0.05;
constexpr int most_family_steps = 400;

/// The line through one equilibrium.
class FamilyLine {
 public:
  FamilyLine(const PathProblem& problem, const FoundEquilibrium& at)
      : problem_{problem}, piece_{at.piece}, weights_{problem.metric()}, z_{at.z} {
    Vector F_lambda;
    Matrix J;
    if (!problem.derivatives(z_, 0, piece_, J, F_lambda)) return;
    const Matrix kernel = kernel_of(J, continuation::poor);
    if (kernel.cols() == 1) set_direction(kernel.col(0));
  }

  bool has_direction() const { return along_.size() > 0; }
  const Vector& here() const { return z_; }
  void turn_round() { along_ = -along_; }

  /// Signed way along the line to another state.
  double way_to(const Vector& z) const { return weighted(along_).dot(between_states(z)); }

  double distance_to(const Vector& z) const {
    const Vector d = between_states(z);
    return std::sqrt(weighted(d).dot(d));
  }

  /// The point of the line so far ahead; nothing where the equations are not satisfied there.
  std::optional<Vector> point_ahead(double way) const {
    const Index n = z_.size();
    const continuation::NewtonOptions options;
    Vector z = z_ + way * along_, F, F_lambda;
    Matrix J;
    double aside = 0;  // of the equations, along the null vector: zero on a family
    for (int k = 0; k <= options.maximum_iterations; ++k) {
      if (!problem_.residual(z, 0, piece_, F) || !F.allFinite()) return std::nullopt;
      const double scale = std::max(1.0, z.lpNorm<Eigen::Infinity>());
      if (F.lpNorm<Eigen::Infinity>() <= options.residual_tolerance * scale) return z;
      if (!problem_.derivatives(z, 0, piece_, J, F_lambda)) return std::nullopt;
      Vector right(n + 1);
      right << -(F + aside * along_), way - weighted(along_).dot(z - z_);
      const Vector step = Lu(bordered(J)).solve(right);
      if (!step.allFinite()) return std::nullopt;
      z += step.head(n);
      aside += step[n];
    }
    return std::nullopt;
  }

  /// @returns whether the line goes on there
  bool move_to(const Vector& z) {
    Vector F_lambda, right = Vector::Unit(z.size() + 1, z.size());
    Matrix J;
    if (!problem_.derivatives(z, 0, piece_, J, F_lambda)) return false;
    const Vector tangent = Lu(bordered(J)).solve(right);
    if (!tangent.allFinite()) return false;
    z_ = z;
    set_direction(tangent.head(z.size()));
    return true;
  }

 private:
  void set_direction(const Vector& v) {
    const double size = std::sqrt(weighted(v).dot(v));
    if (size > 0) along_ = v / size;
  }

  Vector weighted(const Vector& v) const { return weights_.cwiseProduct(v); }

  Matrix bordered(const Matrix& J) const {
    const Index n = J.rows();
    Matrix B = Matrix::Zero(n + 1, n + 1);
    B.topLeftCorner(n, n) = J;
    B.col(n).head(n) = along_;
    B.row(n).head(n) = weighted(along_).transpose();
    return B;
  }

  /// From here to a state, angles the short way round.
  Vector between_states(const Vector& z) const {
    Vector d = z - z_;
    const Vector periods = problem_.periods();
    for (Index i = 0; i < d.size(); ++i)
      if (periods[i] > 0) d[i] -= periods[i] * std::round(d[i] / periods[i]);
    return d;
  }

  const PathProblem& problem_;
  Piece piece_;
  Vector weights_, z_, along_{};
};

/// Walks one way, and marks the equilibria that lie on the line.
/// @returns whether the first step stays in equilibrium
bool walk(FamilyLine line, const std::vector<FoundEquilibrium>& found,
          const std::vector<std::size_t>& singular, std::vector<bool>& on_line,
          const std::function<bool()>& goes_on) {
  const Vector start = line.here();
  bool is_family = false;
  for (int k = 0; k < most_family_steps && goes_on(); ++k) {
    for (const std::size_t i : singular) {
      const double way = line.way_to(found[i].z);
      if (on_line[i] || !(way >= 0 && way <= family_step) ||
          line.distance_to(found[i].z) > 2 * family_step)
        continue;
      const auto there = line.point_ahead(way);
      FamilyLine at = line;
      on_line[i] = there && at.move_to(*there) && at.distance_to(found[i].z) <= continuation::poor;
    }
    const auto next = line.point_ahead(family_step);
    if (!next || !line.move_to(*next)) return is_family;
    is_family = true;
    if (k > 1 && line.distance_to(start) < family_step) return true;  // once round
  }
  return is_family;
}

}  // namespace

std::vector<EquilibriumFamily> equilibrium_families(const PathProblem& problem,
                                                    const std::vector<FoundEquilibrium>& found,
                                                    const std::vector<std::size_t>& singular,
                                                    const std::function<bool()>& goes_on) {
  std::vector<EquilibriumFamily> families;
  if (problem.size() > most_walked) return families;
  std::vector<bool> is_member(found.size(), false);
  for (const std::size_t i : singular) {
    if (is_member[i]) continue;
    FamilyLine line(problem, found[i]);
    if (!line.has_direction()) continue;
    std::vector<bool> on_line(found.size(), false);
    on_line[i] = true;
    const bool ahead = walk(line, found, singular, on_line, goes_on);
    line.turn_round();
    const bool behind = walk(line, found, singular, on_line, goes_on);
    if (!ahead && !behind) continue;
    EquilibriumFamily family{.shown = i};
    for (const std::size_t k : singular)
      if (on_line[k] && k != i && !is_member[k]) family.others.push_back(k);
    is_member[i] = true;
    for (const std::size_t k : family.others) is_member[k] = true;
    families.push_back(std::move(family));
  }
  return families;
}

}  // namespace springfold::analysis
