// Units of force and lambda from how the curve of a study responds at its start. Private to analysis.
#pragma once

#include "setup.hpp"
#include "springfold/continuation/curve.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {

/// Lets a study begin at an equilibrium: pose and commands are counted from there, and a start that was held by a
/// wrench stays held in the directions that the study leaves free.
void begin_at(const Study& study, const statics::FirstEquilibrium& first, Setup& setup);

/// The start of the study's curve. Where the residual is not at tolerance in the units at hand, a few Newton steps
/// bring it there.
continuation::CurvePoint start_point(const PathProblem& problem, const Setup& setup,
                                     const statics::FirstEquilibrium& first);

/// The same setup in units in which the curve leaves its start with a slope of order one:
///
///   lambda   some times |dlambda| for |dx| = 1, bounded by what K and dK/dlambda promise of the first critical load, and
///            by the range of lambda that is asked for;
///   force    the largest wrench of a chain at the start, its change while x moves by 1 or lambda by its unit, or the
///            least stiffness, whichever is largest.
///
/// They are powers of two times those before, so that the equilibrium is carried over exactly. Where the curve has no
/// slope at the start (limit and branch points), or nothing to be measured, the units stay as they are.
void settle_units(const model::Mechanism& mechanism, const Study& study,
                  const ParameterFamily* family, statics::FirstEquilibrium& first, Setup& setup);

/// The same setup with a unit of lambda that is larger by the factor, a power of two, but not beyond the range that is
/// asked for.
void enlarge_lambda_unit(const model::Mechanism& mechanism, const Study& study,
                         const ParameterFamily* family, double factor,
                         statics::FirstEquilibrium& first, Setup& setup);

/// Where x stands still at the start its response says nothing, and the unit of lambda comes from the first critical
/// load. The others may be orders of magnitude away: then the unit grows until a finite range is so many units long, or
/// lambda is measured in parts of itself.
void reach_range(const model::Mechanism& mechanism, const Study& study,
                 const ParameterFamily* family, statics::FirstEquilibrium& first, Setup& setup);

/// Units of lambda along a straight branch; beyond, the next larger unit is taken.
inline constexpr double longest_straight_way = 64;

/// Length of the range of lambda that is asked for, in its unit; infinity: none is.
double range_of_lambda(const Study& study, const Setup& setup);

/// Where a curve goes straight along lambda, or becomes so many times steeper, and its range of lambda is so many times
/// longer than the unit of its start serves, no unit may serve both: lambda is measured in parts of itself beyond that
/// one.
inline constexpr double long_beside_first_load = 0x1p8;

/// Does such a range of lambda span orders of magnitude between what the unit serves and the limits?
bool is_of_many_sizes(double range);

void measure_lambda_in_parts(Setup& setup);

}  // namespace springfold::analysis
