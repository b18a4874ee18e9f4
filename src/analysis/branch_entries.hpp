// The points of a branch in their order, and their rows. Private to analysis.
#pragma once

#include <vector>

#include "asking.hpp"
#include "quantities.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// A row to be: a point, and the special point that it belongs to.
struct Entry {
  continuation::CurvePoint point{};
  const continuation::Hit* hit = nullptr;
  bool leaving = false;     ///< second row of a kink
  bool is_between = false;  ///< no accepted point, for a row between those of the steps
  Turns turns{};            ///< rotation vectors that continue those of the row before
  KnownSwitches known{};    ///< what the rest of the curve says of those near their threshold
};

/// Points and special points of one direction in the order of s, without the start.
std::vector<Entry> entries_of(const continuation::Curve& curve,
                              std::vector<continuation::CurvePoint>&& between);

/// The start, once for every special point that lies on it.
std::vector<Entry> entries_at(const continuation::CurvePoint& start,
                              const std::vector<continuation::Hit>& hits);

/// The same curve walked the other way: s and tangents change sign, kinks swap their sides.
std::vector<Entry> reversed(std::vector<Entry> entries);

/// What all pieces together say of a state at which springs rest; nothing where none rests, or nothing decides.
std::optional<RestingRows> resting_rows(const continuation::CurvePoint& point,
                                        const KnownSwitches& known, std::size_t row,
                                        const Evaluator& evaluator);

/// What rows are made with; the references must outlive it.
struct RowMaking {
  const Evaluator& evaluator;
  const std::vector<QuantityDefinition>& quantities;
  const PathProblem& problem;
  const Asking* asking = nullptr;  ///< nullptr: all rows are wanted
};

/// Makes the rows of a branch that has its start_row. Interrupted, it takes out the entries, and moves the start_row:
/// special points, the ends, the start and the accepted points beside them have a row in any case, the other accepted
/// points if they take a moment, points between them as far as they were done and as many as are soon written.
/// @returns whether every entry has its row
bool add_rows(const RowMaking& making, std::vector<Entry>& entries, Branch& branch);

}  // namespace springfold::analysis
