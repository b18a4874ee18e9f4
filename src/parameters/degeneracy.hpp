// What is looked for along a critical curve. Private to the layer.
#pragma once

#include <vector>

#include "parameters/augmented.hpp"

namespace springfold::continuation {

/// A zero of `value` on the augmented curve, and what it stands for.
struct Watch {
  Degeneracy kind = Degeneracy::user;
  std::string name{};
  std::function<double(const CurvePoint&)> value{};
  EventAction action = EventAction::record;
  std::function<Degeneracy(const CurvePoint&)>
      refine{};           ///< tells kinds apart at the located point
  bool of_place = false;  ///< the value needs no tangent
  int inside = 0;         ///< as CriticalEvent has it
  /// What is called otherwise at another place: its name at the located point.
  std::function<std::string(const CurvePoint&)> name_there{};
  double noise = 0;  ///< values that are no larger are not told from zero, and have no sign
  int tag = 0;       ///< as CriticalEvent has it
};

/// A point of the augmented curve, of n unknowns of the family.
CriticalPoint critical_point(const CurvePoint& p, Index n);

/// The watches of this kind of critical point, then the caller's events. They refer to `system`.
std::vector<Watch> watches_of(const Augmented& system, const std::vector<CriticalEvent>& events);

}  // namespace springfold::continuation
