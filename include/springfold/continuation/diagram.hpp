// The whole bifurcation diagram: all branches of all special points that can be reached.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "springfold/continuation/exits.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {

struct DiagramOptions {
  TraceOptions trace{};
  int maximum_branches = 100;  ///< the two curves that leave a start count as one
  int maximum_depth = 4;       ///< special points between a branch and the start; 0: no branching
  double same_place = 1e-6;   ///< special points closer than this, relative to max(1, |x|), are one
  bool through_kinks = true;  ///< also follow the ways out of branching kinks
  /// Why the ways out of a special point are not searched for, in words; empty: they are. A point that
  /// is left out so is passed along the curve that meets it, and is a doubt.
  std::function<std::string(const CurvePoint&)> left_out{};
};

/// One way to leave a special point.
struct Way {
  CurvePoint point{};  ///< the special point with the way's outward tangent and its piece
  CurvePoint start{};  ///< where a trace along it may begin
  int branch = -1;     ///< which branch runs along it; -1: none was traced
};

/// A point at which branches meet, with all its ways.
struct Junction {
  HitKind kind = HitKind::branch_point;
  CurvePoint point{};
  int multiplicity = 1;
  int depth = 0;  ///< that of the branch on which it was found
  std::vector<Way> ways{};
  bool complete = true;  ///< false: ways may be missing; `why` says what went wrong
  std::string why{};
};

/// One curve of the diagram. It begins at a start of the caller or at a junction and ends where its
/// stop reason says; junctions that it passes do not end it.
struct Branch {
  Curve curve{};
  int start = -1;     ///< number of the caller's start on which it begins
  int junction = -1;  ///< or number of the junction
  int depth = 0;
};

struct Diagram {
  std::vector<Branch> branches{};
  std::vector<Junction> junctions{};
  int not_followed = 0;               ///< ways left out because of the options' bounds
  std::vector<std::string> doubts{};  ///< what may be missing, in words; empty: nothing known
};

/// Where to begin: a solution and the piece it is on.
struct DiagramStart {
  Vector x{};
  double lambda = 0;
  Piece piece{};
};

/// Traces every start in all its directions, and every branch of every branch point, touch or
/// branching kink that is met on the way, first in first out, to the options' depth and number. At
/// each junction it is recorded which of its ways the curves passed so far run along, so that no way
/// is traced twice and a branch ends where it would go on along one that was traced before. A start
/// that lies on a branch is not traced again; a start that is singular is a junction itself.
///
/// Nothing is claimed about branches that are not connected to the starts: search.hpp looks for some.
/// @pre each start satisfies F = 0 to the residual tolerance
Diagram trace_diagram(ProblemView problem, const std::vector<DiagramStart>& starts,
                      const std::vector<Event>& events, const DiagramOptions& options,
                      const StepObserver& observer = {});

/// Does the branch pass through this point, with this piece and along its tangent's line?
bool passes_through(ProblemView problem, const Curve& curve, const CurvePoint& point,
                    const TraceOptions& options);

}  // namespace springfold::continuation
