// Do two points, or a point and a curve, coincide? Angles are compared modulo their periods. Private
// to the engine.
#pragma once

#include "continuation/points/step.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// The tangent at a point as it is at the copy of the point that is nearest to `near`.
Direction direction_seen_from(const Walker& walker, const Vector& near, const CurvePoint& point);

/// b - a, with every periodic unknown taken the short way round and b as its copy nearest to a.
Direction between(const Walker& walker, const CurvePoint& a, const CurvePoint& b);

inline Direction difference(const CurvePoint& a, const CurvePoint& b) {
  return {a.x - b.x, a.lambda - b.lambda};
}
inline Direction difference(const Direction& a, const Direction& b) {
  return {a.dx - b.dx, a.dlambda - b.dlambda};
}

double length_of(const Walker& walker, const Direction& d);

/// What lengths at a point are judged against.
double scale_of(const CurvePoint& point);

/// Largest magnitude of the unknowns and lambda.
inline double size_of(const CurvePoint& p) {
  return std::max(p.x.size() > 0 ? p.x.lpNorm<Eigen::Infinity>() : 0.0, std::abs(p.lambda));
}

/// The direction (dx, dlambda) with length one.
Direction unit_direction(const Walker& walker, const Vector& u);
Direction unit_direction(const Walker& walker, Direction d);

inline Direction opposite(const Direction& d) { return {-d.dx, -d.dlambda}; }

/// Cosine of the angle between two directions.
double cosine(const Walker& walker, const Direction& a, const Direction& b);

/// Same point to `same_point`, same piece, tangents along one line.
bool coincide(const Walker& walker, const CurvePoint& a, const CurvePoint& b);

/// Do two points lie on different sides of a surface, clear of it? Then they are two, however near: beside springs that
/// are nearly at rest special points of several pieces crowd together.
bool are_in_different_pieces(const Walker& walker, const CurvePoint& a, const CurvePoint& b);

/// Does a located special point lie on the surfaces of these switches?
bool lies_on(const Walker& walker, const CurvePoint& point, const std::vector<Index>& switches);

/// The point `target` of the branch, if the step from -> to passes it. Given with the tangent and the arc length of
/// this passage.
std::optional<CurvePoint> passes(const Walker& walker, const CurvePoint& target,
                                 const CurvePoint& from, const CurvePoint& to);

/// The start of a curve, if the step passes it again in the direction in which the curve left it.
std::optional<CurvePoint> start_again(const Walker& walker, const CurvePoint& start,
                                      const CurvePoint& from, const CurvePoint& to);

}  // namespace springfold::continuation
