// The end of a curve that goes to infinite forces. Private to analysis.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/options.hpp"

namespace springfold::analysis {

/// Where chains lose rank wrenches grow as the inverse of the way that is left, w = c / (s_end - s): 1/w is linear in
/// s, and its zero is a pole, at which there is no equilibrium. Behind it the wrenches come back from the other
/// infinity. From two points of a curve before its pole, solved points are sought nearer and nearer to it.
/// @param earlier, last  of one piece, in their order
/// @returns the nearest one, on the side of `last`: as near to the pole as special points are placed, or as rounding
///          lets it be solved; nothing where the wrenches do not grow a hundredfold, or another piece begins before
std::optional<continuation::CurvePoint> beside_infinite_force(
    const PathProblem& problem, const continuation::CurvePoint& earlier,
    const continuation::CurvePoint& last);

/// Is it an equilibrium, with wrenches in the sense of those of `before`?
bool is_solved_on_side_of(const PathProblem& problem, const continuation::CurvePoint& point,
                          const continuation::CurvePoint& before);

/// Watches a curve while it is traced, and ends it where it goes to infinite forces. Rounding would bring touches and
/// branch points where they are very large, and in a diagram branches of them.
class InfiniteForceWatch {
 public:
  /// @param events  of the trace: one that lies before the pole is met first. Both must outlive this
  InfiniteForceWatch(const PathProblem& problem, const std::vector<continuation::Event>& events);

  /// To be told every point of a curve, in order; one that is not reached from the last one by its arc length begins
  /// another.
  /// @returns whether the curve ends behind this point: forces have grown ten thousandfold since the first one, the
  ///          pole is no farther than the next two steps, solved points up to it show that it is one and no finite
  ///          peak, and nothing happens before: no event, switch, turn of lambda, or eigenvalue that changes its sign
  bool sees(const continuation::CurvePoint& point);

  /// Puts the solved point beside the pole behind a curve that was ended for this reason, and says so.
  void end(continuation::Curve& curve, const continuation::TraceOptions& options) const;

 private:
  struct End {
    continuation::CurvePoint seen{}, at{};
    std::string text{};
    bool moves_on = false;  ///< StretchedChains::moves_on
  };

  /// Forces so much larger than at the first point: what happens before, the engine finds; ten times as large, rounding
  /// begins to make events.
  static constexpr double looked_at_from = 1e4;

  void begin(const continuation::CurvePoint& point, double force);
  bool goes_on_at(const continuation::CurvePoint& point) const;
  bool meets_event(const continuation::CurvePoint& from, const continuation::CurvePoint& to) const;
  bool ends_behind(const continuation::CurvePoint& before, const continuation::CurvePoint& point,
                   double force);

  const PathProblem& problem_;
  const std::vector<continuation::Event>& events_;
  Vector weights_{};
  std::vector<Index> wrenches_{};                ///< their places among the unknowns
  std::vector<continuation::CurvePoint> far_{};  ///< the 1st, 2nd, 4th, 8th ... point
  continuation::CurvePoint last_{};
  std::size_t count_ = 0;
  double asked_at_ = 0;  ///< from which force on it is looked again
  std::vector<End> ends_{};
};

}  // namespace springfold::analysis
