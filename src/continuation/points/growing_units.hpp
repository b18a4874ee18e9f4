// A problem in units that grow with lambda. Private to the engine.
#pragma once

#include <optional>
#include <vector>

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// So many times stiffer than others is what counts by its energy still. Less is as any mechanism has it.
inline constexpr double stiff_beside_others = 0x1p10;

/// What the equations are like at the start and beside it, in the units of the unknowns.
struct AboutStart {
  Vector
      own{};  ///< n: by how much the entries on the diagonal exceed the others, at the start; empty: not known
  Vector rows{};         ///< n: largest entry, that by lambda among them, at any of the places
  double by_lambda = 0;  ///< most that lambda does to a motion, per unit, at any of the places
};

/// @param at  dense, the start first  @param units  of the unknowns  @param weights  of the metric, 0 for forces
void take_in(const Linearisation& at, const Vector& units, const Vector& weights,
             AboutStart& about);

/// F(x, lambda) = 0 with lambda measured as LambdaMeasure wants it, or as it is, and with what is stiff beside the
/// others counted by the root of its energy. r is how far lambda has grown:
///
///                                         in parts of itself:     as it is: mu = lambda,
///                                         r = dlambda/dmu         r^2 = max(1, load)^2 + load^2 (lambda - start)^2
///     unknowns of weight zero, forces     x_i = r y_i,            x_i = y_i,
///                                         G_i = F_i               G_i = F_i
///     the others, motions                 x_i = o_i + c_i y_i,    x_i = o_i + c_i y_i,
///                                         G_i = c_i/r F_i         G_i = c_i F_i
///
///     [dG/dy] = [ c/r    ] [ A  B' ] [ c    ] = [ c A c/r  c B' ]      row i belongs to unknown i; what is symmetric
///               [      1 ] [ B  C  ] [    r ]   [ B c      C r  ]      stays so; as it is: with 1 for r
///
/// A matrix A that grows with lambda, and forces that do, are then of moderate size all along. What is stiff in every
/// piece beside others, so that rounding of its row would hide theirs, is so until lambda has grown up to it:
/// c_i = 1 / sqrt(1 + k_i / (r stiff)), k_i what A has for this motion alone at the start, where
/// x_i = o_i, and the load what a unit of lambda does, beside the least row. Curves are the same ones; their
/// tangents inside are rates by an arc length in which mu stands for lambda, and y for x. With lambda as it is tangents
/// outside have length 1 in the caller's metric.
class GrowingUnits {
 public:
  explicit GrowingUnits(ProblemView problem);

  /// Is lambda measured in parts of itself?
  bool in_parts() const;
  /// Are there motions that may be counted so?
  bool may_count_by_energy() const { return problem_.symmetric() && !problem_.structured(); }
  /// Finds what is stiff. @param units  of the unknowns  @param about  may be empty in parts of lambda
  void count_by_energy(const CurvePoint& start, const Vector& units, const AboutStart& about);
  /// Unknowns and lambda as they are: then nothing else here is to be called.
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
  Direction inside(Direction direction, const CurvePoint& point) const;
  Direction outside(Direction direction, const CurvePoint& point) const;
  double r_at(double mu) const { return growth_at(mu).r; }
  /// c of the motions, 1 for forces.
  Vector motions_at(double mu) const { return motions_at(growth_at(mu)); }
  /// How far away what counts by its energy is from the origin of x, in units of y; 0 for the others.
  Vector places_at(double mu) const { return centre_.cwiseAbs().cwiseQuotient(motions_at(mu)); }

 private:
  /// How far lambda has grown at one mu.
  struct Growth {
    double lambda = 0, r = 1;
    double lambda_rate = 1;  ///< dlambda/dmu
    double r_rate = 0;       ///< dr/dmu, relative to r
    double forces = 0;       ///< rate of the logarithm of dlambda/dmu, in parts of that of r
  };
  /// What motions count by their energy.
  struct Asked {
    double counts = 0;  ///< what is stiffer does
    double grown = 0;   ///< and does so until r is this part of its stiffness
    double load = 1;    ///< as `load_`
  };

  Growth growth_at(double mu) const;
  double mu_of(double lambda) const;
  Vector motions_at(const Growth& at) const;
  void put(const Vector& y, const Growth& at) const;
  void put_rate(const Growth& at, const Vector& columns, const Vector& image, Vector& dG_dmu) const;
  /// Rates of the logarithms of the factors of unknowns, in parts of that of r.
  Vector column_rates(const Growth& at) const;
  std::optional<Asked> asked_of_stiffness(const AboutStart& about) const;
  std::optional<Vector> lasting_stiffness(const CurvePoint& start, const Vector& units,
                                          Vector stiffness, double least) const;

  ProblemView problem_;
  LambdaMeasure measure_{};
  double start_ = 0,
         load_ = 1;  ///< lambda there; forces on motions per lambda, beside their least row
  Vector moves_{};   ///< n: 1 for unknowns of the arc length, 0 for the others
  Vector stiff_{};  ///< n: value of r up to which an unknown counts by its energy; 0: it never does
  Vector centre_{};           ///< n: x at the start of what counts by its energy, 0 of the others
  mutable Vector x_{}, F_{};  ///< in the caller's units
  mutable Vector rows_{}, columns_{};  ///< factors of the matrix, at the last mu
  mutable ScaledMatrices matrices_{};
};

}  // namespace springfold::continuation
