// One step along a curve as a function of values: a refused step cannot leave a trace. Private to the engine.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "springfold/continuation/newton.hpp"

namespace springfold::continuation {

/// Derivatives and factorisations at the last few places, and vectors that are used again: a walk does not ask the
/// heap for memory with every step, and what is known of a place is not computed twice.
struct Workspace;
std::shared_ptr<Workspace> workspace();

/// What the engine needs beside the problem while it walks.
struct Walker {
  ProblemView problem;
  Vector weights{};  ///< metric of x
  TraceOptions options{};
  /// Copies of a walker share it; they and the walker serve one thread, and one problem.
  std::shared_ptr<Workspace> memory = workspace();
};

/// How nonlinear the curve was over one step.
struct StepMeasures {
  double contraction = 0;  ///< largest ratio of neighbouring Newton corrections [-]
  double turn = 0;         ///< angle between the tangents [rad]
  double deviation = 0;    ///< from the tangent to the corrected point, over step length [-]
};

struct StepReport {
  StepMeasures measures{};
  std::string refusal{};  ///< in words, where it was refused
};

struct StepResult : StepReport {
  std::optional<CurvePoint> point{};  ///< empty: refused
};

/// A point of the curve near point.x and point.lambda, in their place: residual at tolerance, tangent along
/// `reference`, inertia counted. Corrects within the hyperplane across `reference`. @param report for who asks how, or
/// why not
bool find_point(const Walker& walker, const Piece& piece, const Direction& reference,
                CurvePoint& point, StepReport* report = nullptr);

/// What rounding may leave of F at a point, row by row: some units of the terms of that row, with lengths of unknowns
/// against max(1, their size), unknowns without a length as they are.
Vector rounding_of_rows(const Linearisation& at, const Vector& weights, const Vector& x,
                        double lambda);

/// The same on a piece. @returns false outside the domain
bool rounding_of_rows(const Walker& walker, const Piece& piece, const CurvePoint& point,
                      Vector& rounding);

/// Predicts along the tangent by ds, corrects, and judges the step by StepOptions. The piece stays
/// that of `from`, also beyond its switching surfaces.
StepResult try_step(const Walker& walker, const CurvePoint& from, double ds);

/// Length for the next step from the measures of the last accepted one.
double next_step_length(double ds, const StepMeasures& measures, const StepOptions& options);

}  // namespace springfold::continuation
