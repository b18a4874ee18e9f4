#include "parameters/freed.hpp"

#include <utility>

namespace springfold::continuation {

Vector freed_unknowns(const Freed& freed, const Vector& x, double lambda) {
  Vector X(x.size() + 1);
  X << x.head(freed.place), freed.unit * lambda, x.tail(x.size() - freed.place);
  return X;
}

bool FreedProblem::residual(const Vector& X, double force, const Piece& piece, Vector& F) const {
  if (!inner_.residual(X, 0, piece, F)) return false;
  F[place_] -= force;
  return true;
}

bool FreedProblem::derivatives(const Vector& X, double, const Piece& piece, Matrix& dF_dX,
                               Vector& dF_dforce) const {
  if (!inner_.derivatives(X, 0, piece, dF_dX, dF_dforce)) return false;
  dF_dforce = -Vector::Unit(X.size(), place_);
  return true;
}

/// The force enters linearly, and alone.
bool FreedProblem::second_along(const Vector& X, double, const Piece& piece, const Vector& w,
                                const Vector& V, Vector& value) const {
  Vector along = V;
  along[X.size()] = 0;
  if (!inner_.second_along(X, 0, piece, w, along, value)) return false;
  value[X.size()] = 0;
  return true;
}

bool FreedProblem::switch_gradients(const Vector& X, double, Matrix& dg_dX,
                                    Vector& dg_dforce) const {
  if (!inner_.switch_gradients(X, 0, dg_dX, dg_dforce)) return false;
  dg_dforce.setZero();
  return true;
}

Vector FreedProblem::metric() const {
  Vector weights = inner_.metric();
  weights[place_] = 1 / (unit_ * unit_);
  return weights;
}

FreedFamily::FreedFamily(const Family& family, Freed freed) : of_{std::move(freed)} {
  freed_.step = family.step;
  freed_.line = family.line;
  freed_.at = [this](double mu) -> std::optional<ProblemView> {
    const auto inner = of_.at(mu);
    if (!inner) return std::nullopt;
    problem_.emplace(*inner, of_);
    return ProblemView(*problem_);
  };
}

std::optional<double> FreedFamily::force(const Vector& x, double lambda, double mu,
                                         const Piece& piece) const {
  const auto problem = of_.at(mu);
  Vector E;
  if (!problem || !problem->residual(freed_unknowns(of_, x, lambda), 0, piece, E))
    return std::nullopt;
  return E[of_.place];
}

std::optional<CriticalStart> FreedFamily::start(const CriticalStart& own) const {
  const auto p = force(own.x, own.lambda, own.mu, own.piece);
  if (!p) return std::nullopt;
  CriticalStart start = own;
  start.kind = CriticalKind::limit_point;
  start.x = freed_unknowns(of_, own.x, own.lambda);
  start.lambda = *p;
  start.value = {};
  start.freed = {};
  start.driven = of_.place;
  return start;
}

CriticalPoint FreedFamily::own(const CriticalPoint& point) const {
  const auto without = [place = of_.place](const Vector& X) {
    Vector x(X.size() - 1);
    x << X.head(place), X.tail(X.size() - 1 - place);
    return x;
  };
  CriticalPoint own = point;
  own.x = without(point.x);
  own.lambda = point.x[of_.place] / of_.unit;
  if (point.dx.size() == 0) return own;
  own.dx = without(point.dx);
  own.dlambda = point.dx[of_.place] / of_.unit;
  return own;
}

CriticalCurve follow_freed(const Family& family, const CriticalStart& start, bool growing,
                           std::vector<CriticalEvent> events, const TraceOptions& options,
                           const std::function<bool(const CriticalPoint&)>& observer,
                           const FurtherPoints& further) {
  const FreedFamily freed(family, start.freed);
  const auto begin = freed.start(start);
  if (!begin) return {.stop_detail = "the equations are not defined at the special point"};
  for (CriticalEvent& event : events)
    event.value = [&freed, of = std::move(event.value)](const CriticalPoint& p) {
      return of(freed.own(p));
    };
  std::function<bool(const CriticalPoint&)> observe;
  if (observer) observe = [&](const CriticalPoint& p) { return observer(freed.own(p)); };
  CriticalCurve curve =
      follow_critical(freed.family(), *begin, growing, events, options, observe, further);
  for (CriticalPoint& p : curve.points) p = freed.own(p);
  for (CriticalHit& hit : curve.hits) {
    hit.point = freed.own(hit.point);
    if (hit.kind == Degeneracy::hilltop) hit.name = of_the_force;
  }
  return curve;
}

}  // namespace springfold::continuation
