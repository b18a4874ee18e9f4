// The whole bifurcation diagram: all branches of all special points that can be reached.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

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
  /// Why a curve that leaves this start or special point along the point's tangent ends right there, in words; empty:
  /// it goes on. For points on the edge of the range that is wanted: a stopping event is not met where a curve begins.
  std::function<std::string(const CurvePoint&)> ends_at{};
  /// Is this special point outside of the range that is wanted? It is then no junction, and the branch goes no farther.
  std::function<bool(const CurvePoint&)> outside{};
};

/// Every rule the options break, as sentences a user can act on; empty when usable.
std::vector<std::string> problems_in(const DiagramOptions& options);

/// One way to leave a special point.
struct Way {
  CurvePoint point{};  ///< the special point with the way's outward tangent and its piece
  CurvePoint start{};  ///< where a trace along it may begin
  int branch = -1;     ///< which branch runs along it; -1: none was traced
  /// Farther out than the first switching surface, on the smooth continuation of the piece, where that surface lies
  /// just beside the point.
  std::optional<CurvePoint> beyond{};
  double accuracy = 0;  ///< of the tangent at the point: it may be off by this, in the metric
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
  int start = -1;  ///< the caller's start that is this point
  /// Distance within which other branch points of the same piece belong to this junction; 0: none does. Modes that
  /// vanish close together are branch points of their own on the curve, and one junction, at the first of them.
  double reach = 0;
};

/// One curve of the diagram. It begins at a start of the caller or at a junction and ends where its
/// stop reason says; junctions that it passes do not end it.
struct Branch {
  Curve curve{};
  int start = -1;     ///< number of the caller's start on which it begins
  int junction = -1;  ///< or number of the junction
  int depth = 0;
};

enum class DoubtKind {
  ways_missing,   ///< not all ways out of a junction or a start could be found
  no_such_way,    ///< a branch passes a junction in a direction that is none of its ways
  not_attached,   ///< a branch could not be traced back to the junction at which it begins
  stopped_early,  ///< a branch ended where it need not: `Branch::curve` says why
  bounds,         ///< the options' bounds leave ways out
};

/// Something that may be missing or wrong.
struct Doubt {
  DoubtKind kind = DoubtKind::ways_missing;
  std::string text{};                 ///< the same in words, without the place
  std::optional<CurvePoint> place{};  ///< where; nothing: the diagram as a whole
  int junction = -1;                  ///< of this junction
  int branch = -1;                    ///< of this branch

  const char* c_str() const { return text.c_str(); }
  operator const std::string&() const { return text; }  // NOLINT: doubts were texts once
  friend std::ostream& operator<<(std::ostream& out, const Doubt& doubt) {
    return out << doubt.text;
  }
};

struct Diagram {
  std::vector<Branch> branches{};
  std::vector<Junction> junctions{};
  int not_followed = 0;         ///< ways left out because of the options' bounds
  std::vector<Doubt> doubts{};  ///< what may be missing; empty: nothing known
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
/// that lies on a branch is not traced again; a start that is singular, or on switching surfaces with more or
/// fewer than two ways out, is a junction itself. An ordinary kink at a start is a junction of two ways, of kind
/// `kink`; its branches belong to the start.
///
/// Nothing is claimed about branches that are not connected to the starts: search.hpp looks for some.
/// @pre each start satisfies F = 0 to the residual tolerance
/// @throws std::invalid_argument as trace() does, and where problems_in(options) is not empty
Diagram trace_diagram(ProblemView problem, const std::vector<DiagramStart>& starts,
                      const std::vector<Event>& events, const DiagramOptions& options,
                      const StepObserver& observer = {});

/// Does the branch pass through this point, with this piece and along its tangent's line?
bool passes_through(ProblemView problem, const Curve& curve, const CurvePoint& point,
                    const TraceOptions& options);

}  // namespace springfold::continuation
