// A problem whose lambda is measured in parts of itself. Private to the engine.
#pragma once

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// F(x, lambda) = 0 as LambdaMeasure wants it: mu instead of lambda, and with r = dlambda/dmu
///
///     x_i = r y_i  for unknowns of weight zero, forces that grow with lambda;  x_i = y_i for the others
///     G_i = F_i    in the rows of the former,                                  G_i = F_i / r in those of the latter
///
///     [dG/dy] = [ 1/r    ] [ A  B' ] [ 1    ] = [ A/r  B'  ]      row i belongs to unknown i; what is symmetric stays so
///               [      1 ] [ B  C  ] [    r ]   [ B    C r ]
///
/// A matrix A that grows with lambda, and forces that do, are then of moderate size all along. Curves are the same
/// ones; their tangents inside are rates by an arc length in which mu stands for lambda.
class GrowingUnits {
 public:
  explicit GrowingUnits(ProblemView problem);

  /// lambda as it is: then nothing else here is to be called.
  bool is_plain() const;

  Index size() const { return problem_.size(); }
  bool residual(const Vector& y, double mu, const Piece& piece, Vector& G) const;
  bool derivatives(const Vector& y, double mu, const Piece& piece, Matrix& dG_dy,
                   Vector& dG_dmu) const;
  bool structured() const { return problem_.structured(); }
  bool structured_derivatives(const Vector& y, double mu, const Piece& piece,
                              StructuredMatrix& dG_dy, Vector& dG_dmu) const;
  Index switch_count() const { return problem_.switch_count(); }
  bool switches(const Vector& y, double mu, Vector& g) const;
  bool switch_gradients(const Vector& y, double mu, Matrix& dg_dy, Vector& dg_dmu) const;
  bool symmetric() const { return problem_.symmetric(); }
  Vector metric() const { return problem_.metric(); }
  Vector periods() const { return problem_.periods(); }
  std::vector<Index> double_covers() const { return problem_.double_covers(); }
  std::string switch_name(Index j) const { return problem_.switch_name(j); }

  /// @param x, lambda  of a point  @returns its x and lambda inside
  CurvePoint inside(const Vector& x, double lambda) const;
  CurvePoint inside(CurvePoint point) const;
  CurvePoint outside(CurvePoint point) const;
  /// Directions at such a point.
  Direction inside(Direction direction, const CurvePoint& at) const;
  Direction outside(Direction direction, const CurvePoint& at) const;
  double r_at(double mu) const;

 private:
  double lambda_at(double mu) const;
  double growth_of(double mu) const;  ///< dr/dmu, relative to r
  void put(const Vector& y, double mu) const;
  void put_rate(double mu, const Vector& image, Vector& dG_dmu) const;
  Vector forces_of(const Vector& y) const;

  ProblemView problem_;
  LambdaMeasure measure_{};
  Vector moves_{};                     ///< n: 1 for unknowns of the arc length, 0 for the others
  mutable Vector x_{}, F_{};           ///< in the caller's units
  mutable Vector rows_{}, columns_{};  ///< factors of the matrix, at the last mu
  mutable ScaledMatrices matrices_{};
};

}  // namespace springfold::continuation
