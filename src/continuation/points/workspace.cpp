#include "continuation/points/workspace.hpp"

#include <algorithm>
#include <limits>

#include "springfold/core/finite.hpp"

namespace springfold::continuation {

std::shared_ptr<Workspace> workspace() { return std::make_shared<Workspace>(); }

namespace {

LinearisedPoint* known_place(Workspace& memory, const Vector& x, double lambda,
                             const Piece& piece) {
  for (const auto& p : memory.places)
    if (p->lambda == lambda && p->x == x && p->piece == piece) {
      p->request = ++memory.requests;
      return p.get();
    }
  return nullptr;
}

/// The place that has not been asked for the longest, for another one; it is known as that only once take() is called.
LinearisedPoint& place_to_use(Workspace& memory) {
  auto& places = memory.places;
  if (places.size() < Workspace::most_linearised) {
    places.push_back(std::make_unique<LinearisedPoint>());
    return *places.back();
  }
  const auto oldest = std::min_element(
      places.begin(), places.end(),
      [](const auto& one, const auto& other) { return one->request < other->request; });
  LinearisedPoint& place = **oldest;
  place.lambda = std::numeric_limits<double>::quiet_NaN();
  place.knows_F = false;
  return place;
}

LinearisedPoint* take(ProblemView problem, Workspace& memory, LinearisedPoint& place,
                      const Vector& x, double lambda, const Piece& piece) {
  place.x = x;
  place.lambda = lambda;
  place.piece = piece;
  place.request = ++memory.requests;
  place.factors.begin(place.at, problem.symmetric());
  return &place;
}

}  // namespace

LinearisedPoint* linearised_at(ProblemView problem, Workspace& memory, const Vector& x,
                               double lambda, const Piece& piece) {
  if (LinearisedPoint* known = known_place(memory, x, lambda, piece)) return known;
  LinearisedPoint& place = place_to_use(memory);
  if (!linearise(problem, x, lambda, piece, place.at)) return nullptr;
  return take(problem, memory, place, x, lambda, piece);
}

LinearisedPoint* linearised_with_residual(ProblemView problem, Workspace& memory, const Vector& x,
                                          double lambda, const Piece& piece) {
  if (LinearisedPoint* known = known_place(memory, x, lambda, piece)) {
    if (!known->knows_F)
      known->knows_F = problem.residual(x, lambda, piece, known->F) && all_finite(known->F);
    return known->knows_F ? known : nullptr;
  }
  LinearisedPoint& place = place_to_use(memory);
  place.at.structured.reset();
  if (!problem.equations(x, lambda, piece, place.F, place.at.dF_dx, place.at.dF_dlambda) ||
      !all_finite(place.F) || !all_finite(place.at.dF_dx) || !all_finite(place.at.dF_dlambda))
    return nullptr;
  place.knows_F = true;
  return take(problem, memory, place, x, lambda, piece);
}

const Vector* known_residual(const Workspace& memory, const Vector& x, double lambda,
                             const Piece& piece) {
  for (const auto& p : memory.places)
    if (p->knows_F && p->lambda == lambda && p->x == x && p->piece == piece) return &p->F;
  return nullptr;
}

}  // namespace springfold::continuation
