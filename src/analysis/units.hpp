// Units that a study asks for, and what springs say of the size of forces. Private to analysis.
#pragma once

#include <optional>
#include <vector>

#include "setup.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {

/// Physical units of force and lambda, powers of two.
struct Units {
  double force = 1;
  std::optional<double> lambda{};  ///< empty: from the rates of loads, pose, commands or parameter
};

/// set_up() in these units instead of those of the mechanism alone, which serve until something is known of its
/// equilibria.
Setup set_up(const model::Mechanism& mechanism, const Study& study, const ParameterFamily* family,
             const Units& units);

/// Wrenches of a start in a unit of force that is larger by the factor.
void change_force_unit(const statics::System& system, double factor,
                       statics::FirstEquilibrium& first);

/// Forces of springs, as below; zeros where there are none.
struct SpringRange {
  double softest = 0, stiffest = 0;
};
SpringRange range_of_springs(const model::Mechanism& mechanism, double length);

/// Forces of all springs that would be deflected by the length, or by one radian at that lever.
std::vector<double> spring_forces(const model::Mechanism& mechanism, double length);

}  // namespace springfold::analysis
