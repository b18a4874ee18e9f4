// A piecewise-smooth problem of which some surfaces are ignored. Private to the engine.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// The same equations, but the switches `ignored` keep the sides that they have in `piece`. Where a curve comes to a
/// known point at which it touches a surface, the switch is rounding before it is zero: nothing can be told of it
/// there.
class WithoutSurfaces {
 public:
  WithoutSurfaces(ProblemView problem, std::vector<Index> ignored, const Piece& piece)
      : problem_{problem}, ignored_{std::move(ignored)}, piece_{piece} {}

  Index size() const { return problem_.size(); }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    return problem_.residual(x, lambda, piece, F);
  }
  bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    return problem_.derivatives(x, lambda, piece, dF_dx, dF_dlambda);
  }
  bool equations(const Vector& x, double lambda, const Piece& piece, Vector& F, Matrix& dF_dx,
                 Vector& dF_dlambda) const {
    return problem_.equations(x, lambda, piece, F, dF_dx, dF_dlambda);
  }
  bool structured() const { return problem_.structured(); }
  bool structured_derivatives(const Vector& x, double lambda, const Piece& piece,
                              StructuredMatrix& dF_dx, Vector& dF_dlambda) const {
    return problem_.structured_derivatives(x, lambda, piece, dF_dx, dF_dlambda);
  }
  Index switch_count() const { return problem_.switch_count(); }
  bool switches(const Vector& x, double lambda, Vector& g) const {
    if (!problem_.switches(x, lambda, g)) return false;
    for (const Index j : ignored_) g[j] = piece_[static_cast<std::size_t>(j)];
    return true;
  }
  bool switch_gradients(const Vector& x, double lambda, Matrix& dg_dx, Vector& dg_dlambda) const {
    if (!problem_.switch_gradients(x, lambda, dg_dx, dg_dlambda)) return false;
    for (const Index j : ignored_) {
      dg_dx.row(j).setZero();
      dg_dlambda[j] = 0;
    }
    return true;
  }
  bool symmetric() const { return problem_.symmetric(); }
  Vector metric() const { return problem_.metric(); }
  Vector periods() const { return problem_.periods(); }
  std::vector<Index> double_covers() const { return problem_.double_covers(); }
  std::string switch_name(Index j) const { return problem_.switch_name(j); }
  double growth(const Piece& piece) const { return problem_.growth(piece); }

 private:
  ProblemView problem_;
  std::vector<Index> ignored_{};
  Piece piece_{};
};

}  // namespace springfold::continuation
