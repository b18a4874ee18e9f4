// A problem in few unknowns hidden in one with many.
#pragma once

#include <string>

#include "draw.hpp"
#include "random.hpp"

namespace springfold::known_answers {

/// V_n = V(z) + 1/2 sum k_i (w_i - g_i(z))^2 in q = Q S (z, w), Q orthogonal, S diagonal: events
/// stay where they are, every negative k_i adds one negative eigenvalue. A piecewise-smooth problem
/// for the engine, without switches where the base has none. |k_i| is 0.3 to 3, or, wide, 1e-2 to 1e2.
class Embedded {
 public:
  Embedded(const Base& base, Index n, bool wide, Random& random);

  Index size() const { return n_; }
  bool residual(const Vector& q, double lambda, const Piece& piece, Vector& F) const;
  bool derivatives(const Vector& q, double lambda, const Piece& piece, Matrix& dF_dq,
                   Vector& dF_dlambda) const;
  Index switch_count() const { return static_cast<Index>(base_.thresholds.size()); }
  bool switches(const Vector& q, double lambda, Vector& g) const;
  bool switch_gradients(const Vector& q, double lambda, Matrix& dg_dq, Vector& dg_dlambda) const;
  bool symmetric() const { return true; }
  Vector metric() const { return Vector::Constant(n_, 1 / (unit_ * unit_)); }

  Vector embed(const Vector& z) const;       ///< q of a point with w_i = g_i(z)
  Vector base_point(const Vector& q) const;  ///< z of q
  Piece piece_at(const Vector& z) const;
  Index negative_extra() const { return negative_extra_; }

  /// The same problem in R q, R orthogonal.
  Embedded turned(const Matrix& R) const;
  /// The same problem in unit * q, with the arc length as before; F keeps its numbers.
  Embedded in_units(double unit) const;
  /// The same problem with F multiplied by a number.
  Embedded with_forces(double factor) const;

 private:
  bool evaluate(const Vector& q, double lambda, const Piece& piece) const;
  Base base_;
  Index n_ = 1, k_ = 1, negative_extra_ = 0;
  double unit_ = 1;
  double force_ = 1;  ///< F = force S^-1 Q^T dV/d(z, w)
  Matrix to_zw_{};    ///< S^-1 Q^T
  Matrix to_q_{};     ///< Q S
  Vector stiffness_{}, amplitude_{}, frequency_{};
  std::vector<Index> follows_{};  ///< w_i follows this entry of z
  mutable Vector F_{}, F_lambda_{};
  mutable Matrix H_{};
};

/// Orthogonal n x n with the determinant +1 or -1.
Matrix random_orthogonal(Index n, double determinant, Random& random);

}  // namespace springfold::known_answers
