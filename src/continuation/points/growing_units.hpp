// A problem whose lambda is measured in parts of itself. Private to the engine.
#pragma once

#include <optional>

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// So many times stiffer than others is what counts by its energy. Less is as any mechanism has it.
inline constexpr double stiff_beside_others = 0x1p10;

/// F(x, lambda) = 0 as LambdaMeasure wants it: mu instead of lambda, and with r = dlambda/dmu
///
///     x_i = r y_i    for unknowns of weight zero, forces that grow with lambda;  x_i = c_i y_i    for the others
///     G_i = F_i      in the rows of the former,                                  G_i = c_i/r F_i  in those of the latter
///
///     [dG/dy] = [ c/r    ] [ A  B' ] [ c    ] = [ c A c/r  c B' ]      row i belongs to unknown i; what is symmetric
///               [      1 ] [ B  C  ] [    r ]   [ B c      C r  ]      stays so
///
/// A matrix A that grows with lambda, and forces that do, are then of moderate size all along. What is stiff beside
/// lambda all the same, and stays as it is, is counted in the root of its energy until lambda has grown up to it: c_i =
/// 1 / sqrt(1 + k_i / (r stiff)), k_i the largest entry of A's row at the start, as far as it is there in all pieces.
/// Curves are the same ones; their tangents inside are rates by an arc length in which mu stands for lambda, and y for
/// x.
class GrowingUnits {
 public:
  /// @param x, lambda, piece  of a point of the curve, as the caller has them
  GrowingUnits(ProblemView problem, const Vector& x, double lambda, const Piece& piece);

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
  /// What counts by its energy has none.
  Vector periods() const { return (stiff_.array() > 0).select(0, problem_.periods()); }
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
  /// c of the motions, 1 for forces.
  Vector motions_at(double mu) const;

 private:
  double lambda_at(double mu) const;
  double growth_of(double mu) const;  ///< dr/dmu, relative to r
  void put(const Vector& y, double mu) const;
  void put_rate(double mu, const Vector& image, Vector& dG_dmu) const;
  std::optional<Vector> lasting_stiffness(const Vector& x, double lambda, const Piece& piece) const;
  void count_by_energy(const Vector& x, double lambda, const Piece& piece);
  /// Rates of the logarithms of the factors of unknowns and rows, in parts of that of r.
  Vector column_rates(double mu) const;
  Vector row_rates(double mu) const;

  ProblemView problem_;
  LambdaMeasure measure_{};
  Vector moves_{};  ///< n: 1 for unknowns of the arc length, 0 for the others
  Vector stiff_{};  ///< n: value of r up to which an unknown counts by its energy; 0: it never does
  mutable Vector x_{}, F_{};           ///< in the caller's units
  mutable Vector rows_{}, columns_{};  ///< factors of the matrix, at the last mu
  mutable ScaledMatrices matrices_{};
};

}  // namespace springfold::continuation
