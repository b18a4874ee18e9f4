// Minimally augmented systems of special points, F~(X; mu) = 0 with X = (x, lambda, ...). Private to the layer.
#pragma once

#include <optional>

#include "parameters/family_differences.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {

/// What M = [dF/dx B; C^T 0] defines at one place.
struct BorderedPlace {
  BaseTerms base{};
  Matrix V{}, W{};  ///< n x k
  Matrix G{};       ///< k x k
  double largest()
      const;  ///< norm of the longest column of V and W: beyond a few the borders are poor
};

/// @param storage  of equations that are not needed any more
std::optional<BorderedPlace> bordered_place(const Family& family, const Vector& x, double lambda,
                                            double mu, const Piece& piece, const Matrix& B,
                                            const Matrix& C, BaseTerms storage = {});

/// Left and right singular vectors of the k smallest singular values of dF/dx; for symmetric problems the same
/// eigenvectors for both.
struct NullVectors {
  Matrix left{}, right{};
};
std::optional<NullVectors> null_vectors(const Family& family, const CriticalStart& at, int k);

/// All kinds as one SmoothProblem with the parameter mu.
class Augmented {
 public:
  Augmented(const Family& family, const CriticalStart& start, NullVectors borders);

  Index size() const { return n_ + 1 + k_; }
  bool residual(const Vector& X, double mu, Vector& F) const;
  bool derivatives(const Vector& X, double mu, Matrix& dF_dX, Vector& dF_dmu) const;
  /// The same where no jump, bend or end of the family beside mu makes them inexact.
  bool sure_derivatives(const Vector& X, double mu, Matrix& dF_dX, Vector& dF_dmu) const;
  /// Both from one factorisation.
  bool equations(const Vector& X, double mu, Vector& F, Matrix& dF_dX, Vector& dF_dmu) const;
  Vector metric() const;
  Vector periods() const;
  std::vector<Index> double_covers() const { return covers_; }

  Vector state(const Vector& X) const { return X.head(n_); }
  double lambda(const Vector& X) const { return X[n_]; }
  /// Coefficients beta of a branch point: zero where the parameter keeps the branch.
  double unfolding(const Vector& X) const;
  /// Of a branch point of corank 2 or more: the largest entry of G, zero where all its eigenvalues still vanish
  /// together.
  double parting(const Vector& X, double mu) const;
  /// The same of G's rate. @param rate  of X by mu
  double rate_of_parting(const Vector& X, double mu, const Vector& rate) const;
  Vector start_unknowns() const;
  Index n() const { return n_; }
  const CriticalStart& start() const { return start_; }
  /// Where what is called lambda stands: of limit points of the force the coordinate that is free.
  Index place_of_lambda() const { return has_force() ? start_.driven : n_; }
  const Family& family() const { return family_; }
  const NullVectors& borders() const { return borders_; }
  std::optional<BorderedPlace> place(const Vector& X, double mu) const;
  /// The switch, or the caller's function.
  std::optional<double> surface(const Vector& x, double lambda, double mu) const;
  /// @param error  expected of differences, relative, if it is larger
  std::optional<Vector> surface_gradient(const Vector& x, double lambda, double mu,
                                         double* error = nullptr) const;

 private:
  bool is_bordered() const;
  /// In the place of lambda stands a force, which does not enter the arc length.
  bool has_force() const { return start_.driven >= 0; }
  /// All terms at one place; V, W and G of bordered kinds only. `last`: the last equation: trace of G, or the surface.
  struct Terms {
    BorderedPlace at{};
    Matrix along{};  ///< branch points: (-y, 1) with M (y, eta) = (dF/dlambda, 0), a column
    Vector load{};   ///< branch points: eta = W^T dF/dlambda
    double last = 0;
  };
  std::optional<Terms> terms(const Vector& X, double mu) const;
  /// What only differences give of the derivatives at one place.
  struct Differences {
    Vector X{};
    double mu = 0;
    Matrix
        by_X{};  ///< (x, lambda): of the equations W^T dF/dlambda, where there are any, and of the last one
    Vector by_mu{};    ///< of F, of those equations and of the last one
    double error = 0;  ///< expected of exact by_mu, relative
  };
  /// Where the equations are affine in mu from here on, as the family knows.
  std::optional<double> far_on_line(double mu) const;
  bool differences(const Vector& X, double mu, const Terms& terms, Exactness exactness,
                   Differences& found) const;
  /// Its by_X. @param rows  zero, of the right size
  bool put_rows(const Vector& X, double mu, const Terms& terms, Exactness exactness,
                Matrix& rows) const;
  /// Exact ones at this place, or as near to it as the corrector comes.
  const Differences* known_differences(const Vector& X, double mu) const;
  bool put_residual(const Vector& X, const Terms& terms, Vector& F) const;
  bool put_derivatives(const Vector& X, double mu, const Terms& terms, Exactness exactness,
                       Matrix& dF_dX, Vector& dF_dmu) const;

  const Family& family_;
  CriticalStart start_;
  NullVectors borders_;  ///< B = left, C = right
  Index n_ = 0, k_ = 0;  ///< k: unfolding coefficients, of branch points only
  Vector weights_{}, periods_{};
  std::vector<Index> covers_{};
  mutable Differences exact_{};        ///< the last ones
  mutable BaseTerms spare_{}, far_{};  ///< storage: of terms(), of another member
};

}  // namespace springfold::continuation
