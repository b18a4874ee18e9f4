// What is checked once where a problem enters the engine, so that nothing inside needs to ask.
#pragma once

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/diagram.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/continuation/problem.hpp"
#include "springfold/continuation/ray.hpp"
#include "springfold/continuation/search.hpp"

namespace springfold::continuation {

/// Sizes of all that the problem gives at (x, lambda), of x and of the piece; options that can be used.
/// @throws std::invalid_argument with what is wrong and what is needed
void check_entry(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
                 const TraceOptions& options);

/// The same without options.
/// @throws std::invalid_argument
void check_point(ProblemView problem, const Vector& x, double lambda, const Piece& piece);

/// The same of the box in which solutions are searched for, and of those that are known.
/// @throws std::invalid_argument
void check_search(ProblemView problem, double lambda, const std::vector<Vector>& known,
                  const SearchOptions& options);

/// Options of a diagram that can be used.
/// @throws std::invalid_argument
void check_diagram(const DiagramOptions& options);

/// The same of a curve that was traced before: its points have as many unknowns as the problem.
/// @throws std::invalid_argument
void check_curve(ProblemView problem, const Curve& curve);

/// Every event has a value to watch.
/// @throws std::invalid_argument
void check_events(const std::vector<Event>& events);

/// The same of the ray along which a curve is to be followed.
/// @throws std::invalid_argument
void check_ray(ProblemView problem, const Ray& ray);

}  // namespace springfold::continuation
