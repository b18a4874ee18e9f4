// A problem in units of the engine's own, so that its tolerances mean the same in the units of
// every caller. Private to the engine.
#pragma once

#include <utility>
#include <vector>

#include "continuation/points/growing_units.hpp"
#include "springfold/continuation/diagram.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// F(x, lambda) = 0 in other unknowns and with other factors. Those of this class are powers of two: nothing is
/// rounded, and changing the caller's units by powers of two changes no bit inside.
///
///     x = unit * y,   G = force unit * F (symmetric problems: dG/dy stays symmetric)  or  force * F,
///     h_j = surface_j g_j
///
/// The metric gives the units: its weights become numbers in [1, 4). The largest entry of [dG/dy dG/dlambda] at and
/// near the start becomes about 1, and so does the gradient of each h_j. Unknowns of weight zero keep their unit.
/// lambda and the arc length are the caller's, but where the problem has lambda measured otherwise (LambdaMeasure), or
/// members so stiff beside others that they count by their energy: units grow with lambda then (GrowingUnits), and
/// in parts of lambda tangents outside are rates by the arc length inside.
class Normalised {
 public:
  /// @param x, lambda, piece  a point of the curve
  Normalised(ProblemView problem, const Vector& x, double lambda, const Piece& piece);
  Normalised(const Normalised&) = delete;
  Normalised& operator=(const Normalised&) = delete;

  // What the engine asks for.
  Index size() const { return problem_.size(); }
  bool residual(const Vector& y, double lambda, const Piece& piece, Vector& G) const;
  bool derivatives(const Vector& y, double lambda, const Piece& piece, Matrix& dG_dy,
                   Vector& dG_dlambda) const;
  bool equations(const Vector& y, double lambda, const Piece& piece, Vector& G, Matrix& dG_dy,
                 Vector& dG_dlambda) const;
  bool structured() const { return problem_.structured(); }
  bool structured_derivatives(const Vector& y, double lambda, const Piece& piece,
                              StructuredMatrix& dG_dy, Vector& dG_dlambda) const;
  Index switch_count() const { return problem_.switch_count(); }
  bool switches(const Vector& y, double lambda, Vector& h) const;
  bool switch_gradients(const Vector& y, double lambda, Matrix& dh_dy, Vector& dh_dlambda) const;
  bool symmetric() const { return problem_.symmetric(); }
  Vector metric() const { return problem_.metric().cwiseProduct(unit_.cwiseAbs2()); }
  Vector periods() const { return problem_.periods().cwiseQuotient(unit_); }
  std::vector<Index> double_covers() const { return problem_.double_covers(); }
  std::string switch_name(Index j) const { return problem_.switch_name(j); }
  double growth(const Piece& piece) const;

  CurvePoint inside(const Vector& x, double lambda) const;
  /// @param at  where it begins, inside
  Ray inside(const Ray& ray, const CurvePoint& at) const;
  CurvePoint inside(const CurvePoint& point) const;
  CurvePoint outside(CurvePoint point) const;
  Hit outside(const Hit& hit) const;
  Ray outside(const Ray& ray, const CurvePoint& at) const;
  std::vector<Event> inside(const std::vector<Event>& events) const;
  StepObserver inside(const StepObserver& observer) const;
  HitObserver inside(const HitObserver& observer) const;
  DiagramOptions inside(const DiagramOptions& options) const;

  Curve outside(Curve curve) const;
  Diagram outside(Diagram diagram) const;

 private:
  Vector in_units(const Vector& x) const { return x.cwiseQuotient(unit_); }
  CurvePoint in_own(CurvePoint point) const;
  void scale(Matrix& dG_dy, Vector& dG_dlambda) const;
  double largest_in(const Linearisation& at) const;
  template <class See>
  void each_about_start(const See& see) const;
  double largest_that_stays(const Vector& x, double lambda, const Piece& piece) const;
  double largest_about_start() const;
  double size_of_places() const;
  void scale_switches(const Vector& x, double lambda);

  GrowingUnits growing_;  ///< used where units grow with lambda
  ProblemView problem_;
  Vector unit_{};     ///< n
  Vector force_{};    ///< n: factors of the equations
  Vector surface_{};  ///< factors of the switching functions
  Vector start_{};    ///< n, in the units of problem_, with its lambda and piece
  double start_lambda_ = 0;
  Piece start_piece_{};
  double places_ = 1;  ///< what equations are rounded to, beside 1

  mutable std::vector<std::pair<Piece, double>> growths_{};
  mutable Vector x_{};
  mutable ScaledMatrices matrices_{};
};

/// What becomes of a curve in the middle of which the problem throws Interrupted.
enum class IfInterrupted {
  give_up,  ///< it is thrown on: what is half a curve says nothing
  keep,     ///< the curve ends at the last accepted point, as if its observer had stopped it
};

/// trace() without a change of units: for callers that have changed them already.
Curve trace_in_own_units(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                         const std::vector<Event>& events, const TraceOptions& options,
                         const StepObserver& observer, const HitObserver& at_hit,
                         IfInterrupted interrupted = IfInterrupted::give_up);

}  // namespace springfold::continuation
