// Ways between two minima that are relaxed as a whole, and the saddles on them. Private to analysis.
#pragma once

#include "state_book.hpp"

namespace springfold::analysis {

/// Images of a way from one minimum to another.
struct RelaxedWay {
  std::vector<Vector> images{};  ///< both ends among them
  std::vector<double> energies{};
  bool is_whole = false;  ///< no gap: neighbours are near each other, on the closures all along
};

/// The simplified string method: images go downhill, across the way, and are spread evenly again, until they rest.
/// Source: E, Ren, Vanden-Eijnden, "Simplified and improved string method for computing the minimum energy paths in
/// barrier-crossing events", J. Chem. Phys. 126 (2007).
RelaxedWay relaxed_way(const Landscape& landscape, const Vector& from, const Vector& to);

/// The saddles with one unstable mode to which the highest places of the way lead, polished as all states of rest.
std::vector<RestState> saddles_on(const Landscape& landscape, const RelaxedWay& way);

/// Ways between minima that no known saddle joins, nearest ones first, until all are joined or no way helps; where
/// there are few minima, between all pairs. Saddles and minima that are met go to the book.
void join_by_strings(StateBook& book);

}  // namespace springfold::analysis
