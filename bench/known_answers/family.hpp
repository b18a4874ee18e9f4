// Problems with closed-form answers for the known-answer campaign.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::known_answers {

/// A potential problem in few unknowns z: F = dV/dz, and its derivatives.
struct Base {
  Index size = 1;
  /// F (k), H = dF/dz (k x k), dF/dlambda (k); false outside the domain.
  std::function<bool(const Vector& z, double lambda, Vector& F, Matrix& H, Vector& F_lambda)> at{};
};

enum class AnswerKind { fold, branch_point, corner, touch };

struct Answer {
  AnswerKind kind = AnswerKind::fold;
  double lambda = 0;
  Vector z{};
  int multiplicity = 1;
};

/// One random problem, embedded in n unknowns, with everything that must be found on its curve.
struct Draw {
  std::string family{};
  Base base{};
  Vector z_start{};
  double lambda_start = 0;
  double lambda_low = 0, lambda_high = 0;  ///< the curve ends where lambda leaves this range
  double z_low = -1e9, z_high = 1e9;       ///< or the first entry of z leaves this one
  double size = 1;                         ///< of the curve, for relative tolerances
  double gap = 1;                          ///< distance of the nearest other branch over size
  std::vector<Answer> answers{};           ///< on the curve through the start
  std::function<bool(const Vector& z, double lambda)> on_curve{};  ///< empty: not checked
};

/// V_n = V(z) + 1/2 sum k_i (w_i - g_i(z))^2 in q = Q S (z, w): events stay where they are, every
/// negative k_i adds one negative eigenvalue.
class Embedded {
 public:
  Embedded(const Base& base, Index n, std::mt19937_64& random);

  Index size() const { return n_; }
  bool residual(const Vector& q, double lambda, Vector& F) const;
  bool derivatives(const Vector& q, double lambda, Matrix& dF_dq, Vector& dF_dlambda) const;
  bool symmetric() const { return true; }

  Vector embed(const Vector& z) const;       ///< q of a point with w_i = g_i(z)
  Vector base_point(const Vector& q) const;  ///< z of q
  Index negative_extra() const { return negative_extra_; }

 private:
  bool evaluate(const Vector& q, double lambda) const;
  const Base& base_;
  Index n_ = 1, k_ = 1, negative_extra_ = 0;
  Matrix to_zw_{};  ///< S^-1 Q^T
  Matrix to_q_{};   ///< Q S
  Vector stiffness_{}, amplitude_{}, frequency_{};
  std::vector<Index> follows_{};  ///< w_i follows this entry of z
  mutable Vector F_{}, F_lambda_{};
  mutable Matrix H_{};
};

double uniform(std::mt19937_64& random, double low, double high);
double log_uniform(std::mt19937_64& random, double low, double high);

Draw fold_ladder(std::mt19937_64& random);
Draw strands(std::mt19937_64& random);
Draw pitchfork(std::mt19937_64& random);
Draw two_mode(std::mt19937_64& random);
Draw n_pod_dome(std::mt19937_64& random);
Draw von_mises_sway(std::mt19937_64& random);
Draw link_column(std::mt19937_64& random);
Draw trammel(std::mt19937_64& random);

}  // namespace springfold::known_answers
