// Events on one step, for the tracer. Private to the engine.
#pragma once

#include <string>
#include <vector>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// All smooth special points on the step from -> to (same piece), in order.
struct StepEvents {
  std::vector<Hit> hits{};
  std::string doubt{};   ///< set: something happens here that these hits do not explain;
                         ///< a shorter step may separate it
  int unexplained = 1;   ///< with a doubt: how many eigenvalues change sign unexplained
  bool passing = false;  ///< with a doubt: branches pass each other closely; the curve turns aside
  bool flat = false;  ///< with a doubt: lambda stands still to rounding; shorter steps do not help
  bool of_caller = false;  ///< with a doubt: it is about an event of the caller
};

/// In the order of s; hits at one place as they were.
void sort_by_place(std::vector<Hit>& hits);

/// @param middle  the curve's point half-way, or nullptr: then only the ends are compared
StepEvents events_on_step(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          const CurvePoint* middle, const std::vector<Event>& events);

}  // namespace springfold::continuation
