// What a walk keeps from step to step. Private to the engine.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "continuation/points/arc.hpp"
#include "continuation/points/step.hpp"
#include "springfold/core/arnoldi.hpp"
#include "springfold/core/bordered_factors.hpp"

namespace springfold::continuation {

/// What is known at one place. Its factors look at its derivatives: it stays where it is.
struct LinearisedPoint {
  LinearisedPoint() {}  // of most factors nothing is ever touched, and nothing is to be set to zero
  LinearisedPoint(const LinearisedPoint&) = delete;
  LinearisedPoint& operator=(const LinearisedPoint&) = delete;

  Vector x{};
  double lambda = std::numeric_limits<double>::quiet_NaN();
  Piece piece{};
  Linearisation at{};
  BorderedFactors factors;
  Vector F{};  ///< where it is known
  bool knows_F = false;
  long request = 0;  ///< the last one that asked for it
};

struct Workspace {
  /// Of two steps and their middles there are about this many: a guess or two and the point itself.
  static constexpr std::size_t most_linearised = 12;
  std::vector<std::unique_ptr<LinearisedPoint>> places{};
  long requests = 0;  ///< for places, so far
  NewtonResult newton{};
  Vector F{}, step{}, sizes{}, x{}, bound{};
  Direction direction{};
  Matrix inverse{}, motion{};
  Arnoldi arnoldi{};
  std::vector<Index> moving_rows{};
  CurvePoint next{}, middle{};  ///< of the step that is being taken
  CurvePoint trial{};           ///< between them
  struct Switches {
    Vector g{}, dg_dlambda{};
    Matrix dg_dx{};
  };
  Switches at_from{}, at_to{};
  /// The caller's events at the end of the last step, where the next one begins.
  struct EventValues {
    struct Value {
      double value = 0, noise = 0;
    };
    const Event* events = nullptr;  ///< which ones
    CurvePoint point{};
    std::vector<Value> values{}, next{};  ///< next: of the step that is being looked at
  };
  EventValues at_end{};
  Vector g{};

  bool asked = false;  ///< what follows is the problem's
  Vector periods{};
  std::vector<Index> double_covers{};
  ArcModel behind{}, chord{};  ///< the last step as a model, and a step between its ends only
  ArcModel ahead{};            ///< the last step and the first half of the next one
};

/// The derivatives at a place, with factors to be asked for; computed unless it is one of the last few. Valid until
/// eleven others have been asked for.
/// @returns nullptr outside the domain
LinearisedPoint* linearised_at(ProblemView problem, Workspace& memory, const Vector& x,
                               double lambda, const Piece& piece);

/// The same with F, which is evaluated together with them. Also nullptr where F is defined and its derivatives are not.
LinearisedPoint* linearised_with_residual(ProblemView problem, Workspace& memory, const Vector& x,
                                          double lambda, const Piece& piece);

/// F at a place where it was asked for not long ago; nullptr where nobody did.
const Vector* known_residual(const Workspace& memory, const Vector& x, double lambda,
                             const Piece& piece);

/// correct() from memory.newton.x and .lambda on, with the result there.
void correct(ProblemView problem, const Vector& weights, const Piece& piece,
             const Direction& border, const NewtonOptions& options, Workspace& memory);

/// The unit tangent of tangent_at(), from the factors at hand. @returns false when the bordered matrix is singular
bool tangent_at(Workspace& memory, LinearisedPoint& place, const Vector& weights,
                const Direction& reference, Direction& tangent);

/// try_step(), point_at() and examine() with their results in storage of the caller's.
/// @param model  the curve behind `from`, its origin, which is continued where it promises an even way; or nullptr
bool try_step(const Walker& walker, const CurvePoint& from, double ds, const ArcModel* model,
              CurvePoint& to, StepReport& report);
bool find_point_at(const Walker& walker, const CurvePoint& from, double ds, CurvePoint& point);
/// @param doubt   why the step is not to be trusted; empty: it is
/// @returns whether the middle was found
/// @param model  as for try_step()
bool examine(const Walker& walker, const ArcModel* model, const CurvePoint& from,
             const CurvePoint& to, CurvePoint& middle, std::string& doubt);

/// Where the model expects the curve at the way `ahead` from its origin. @returns false where it bends too much to be
/// believed, or where there is no model
bool expect(const Walker& walker, const ArcModel* model, const CurvePoint& origin, double ahead,
            CurvePoint& point);

}  // namespace springfold::continuation
