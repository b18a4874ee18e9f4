// Curves of which lambda is a prescribed coordinate, seen with this coordinate free and its force given. Private to the
// layer.
#pragma once

#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {

/// What a hilltop of the force is called beside one of lambda.
inline constexpr const char* of_the_force = "limit point of the force";

/// Whether a start is one of an extremum of the force, to be followed as a limit point of the equations with the
/// coordinate free.
inline bool is_of_freed(const CriticalStart& start) {
  return start.kind == CriticalKind::zero && start.freed.at;
}

/// (x, lambda) as the unknowns of the equations with the coordinate free, and back.
Vector freed_unknowns(const Freed& freed, const Vector& x, double lambda);

/// E(X) - p e of one mu, for the unknowns X and the force p.
class FreedProblem {
 public:
  FreedProblem(ProblemView inner, const Freed& freed)
      : inner_{inner}, place_{freed.place}, unit_{freed.unit} {}

  Index size() const { return inner_.size(); }
  bool residual(const Vector& X, double force, const Piece& piece, Vector& F) const;
  bool derivatives(const Vector& X, double force, const Piece& piece, Matrix& dF_dX,
                   Vector& dF_dforce) const;
  bool second_along(const Vector& X, double force, const Piece& piece, const Vector& w,
                    const Vector& V, Vector& value) const;
  Index switch_count() const { return inner_.switch_count(); }
  bool switches(const Vector& X, double, Vector& g) const { return inner_.switches(X, 0, g); }
  bool switch_gradients(const Vector& X, double force, Matrix& dg_dX, Vector& dg_dforce) const;
  bool symmetric() const { return inner_.symmetric(); }
  Vector metric() const;  ///< that of (x, lambda)
  Vector periods() const { return inner_.periods(); }
  std::vector<Index> double_covers() const { return inner_.double_covers(); }
  std::string switch_name(Index j) const { return inner_.switch_name(j); }
  double growth(const Piece& piece) const { return inner_.growth(piece); }

 private:
  ProblemView inner_;
  Index place_;
  double unit_;
};

/// The family of such problems. It is referred to: it stays where it is.
class FreedFamily {
 public:
  /// @param family  with lambda prescribed
  FreedFamily(const Family& family, Freed freed);
  FreedFamily(const FreedFamily&) = delete;
  FreedFamily& operator=(const FreedFamily&) = delete;

  const Family& family() const { return freed_; }
  /// The force at a state of the family; nothing outside of its domain.
  std::optional<double> force(const Vector& x, double lambda, double mu, const Piece& piece) const;
  /// The limit point of the force, `driven` being the coordinate; nothing where the equations are not defined.
  std::optional<CriticalStart> start(const CriticalStart& own) const;
  /// The point in the family's own unknowns.
  CriticalPoint own(const CriticalPoint& point) const;

 private:
  Freed of_;
  std::optional<FreedProblem> problem_{};
  Family freed_{};
};

/// follow_critical() of a start that is_of_freed().
CriticalCurve follow_freed(const Family& family, const CriticalStart& start, bool growing,
                           std::vector<CriticalEvent> events, const TraceOptions& options,
                           const std::function<bool(const CriticalPoint&)>& observer,
                           const FurtherPoints& further);

}  // namespace springfold::continuation
