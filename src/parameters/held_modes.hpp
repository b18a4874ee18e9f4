// Special points beside which other modes vanish that the curve does not move along. Private to the layer.
#pragma once

#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {

/// Whether a start holds modes.
inline bool holds_modes(const CriticalStart& start) { return start.held_right.cols() > 0; }

/// The forms by which they are held.
inline const Matrix& held_by(const CriticalStart& start) {
  return start.held_by.size() > 0 ? start.held_by : start.held_right;
}

/// One problem of a family, of n unknowns x, with h modes held:
///
///     | F(x, lambda) + B beta |            | dF/dx  B |
///     |                       | = 0,       |          |        for (x, beta)
///     | C^T (x - x0)          |            | C^T    0 |
///
/// Where the family keeps the symmetry that the modes break, beta = 0 all along.
class HeldProblem {
 public:
  HeldProblem(ProblemView inner, const CriticalStart& start) : inner_{inner}, start_{start} {}

  Index size() const { return inner_.size() + start_.held_right.cols(); }
  bool residual(const Vector& X, double lambda, const Piece& piece, Vector& F) const;
  bool derivatives(const Vector& X, double lambda, const Piece& piece, Matrix& dF_dX,
                   Vector& dF_dlambda) const;
  bool second_along(const Vector& X, double lambda, const Piece& piece, const Vector& w,
                    const Vector& V, Vector& value) const;
  Index switch_count() const { return inner_.switch_count(); }
  bool switches(const Vector& X, double lambda, Vector& g) const {
    return inner_.switches(X.head(inner_.size()), lambda, g);
  }
  bool switch_gradients(const Vector& X, double lambda, Matrix& dg_dX, Vector& dg_dlambda) const;
  bool symmetric() const;
  Vector metric() const;
  Vector periods() const;
  std::vector<Index> double_covers() const { return inner_.double_covers(); }
  std::string switch_name(Index j) const { return inner_.switch_name(j); }
  double growth(const Piece& piece) const { return inner_.growth(piece); }

 private:
  void add_modes(const Vector& X, Vector& F) const;

  ProblemView inner_;
  const CriticalStart& start_;
};

/// The family of such problems, and the start in it. Refers to what it is made of, and is referred to: it stays where
/// it is.
class HeldFamily {
 public:
  HeldFamily(const Family& family, const CriticalStart& start);
  HeldFamily(const HeldFamily&) = delete;
  HeldFamily& operator=(const HeldFamily&) = delete;

  const Family& family() const { return held_; }
  CriticalStart start() const;
  /// The point in the family's own unknowns.
  CriticalPoint own(CriticalPoint point) const;
  /// Largest beta of a point: zero where the parameter keeps the branch.
  double unfolding(const CriticalPoint& point) const;
  double unfolding_of_rate(const CriticalPoint& point) const;

 private:
  const CriticalStart& start_;
  std::optional<HeldProblem> problem_{};
  Family held_{};
};

/// Does the limit point that moves at this rate leave the zeros of the eigenvalues of the held modes behind?
bool parts_modes(const Family& family, const CriticalStart& start, const CriticalPoint& rate);

/// follow_critical() in the family in which the modes are held, as far as the parameter keeps the branch.
CriticalCurve follow_held(const Family& family, const CriticalStart& start, bool growing,
                          std::vector<CriticalEvent> events, const TraceOptions& options,
                          const std::function<bool(const CriticalPoint&)>& observer,
                          const FurtherPoints& further);

}  // namespace springfold::continuation
