// A critical curve that is put together from pieces. Private to analysis.
#pragma once

#include <optional>
#include <vector>

#include "case_curves.hpp"

namespace springfold::analysis {

/// In all unknowns, lambda and the parameter, as the family scales them.
double distance(const continuation::CriticalPoint& a, const continuation::CriticalPoint& b);

/// The start with another point of its curve.
continuation::CriticalStart moved_to(continuation::CriticalStart start,
                                     const continuation::CriticalPoint& point);

/// The point of the curve at this value of the parameter that Newton's method finds from the guess.
std::optional<continuation::CriticalPoint> point_at(const CaseCurves& curves,
                                                    const continuation::CriticalStart& start,
                                                    continuation::CriticalPoint guess, double mu);

/// Does no switch contradict the piece on which the point is followed? Those that are zero there do not.
bool is_on_piece(const CaseCurves& curves, const continuation::CriticalStart& start,
                 const continuation::CriticalPoint& point);

/// The point of the curve at the guess's value of the parameter; nothing where Newton's method goes elsewhere.
/// @param from  the point before, from which the guess was made
std::optional<continuation::CriticalPoint> point_near(const CaseCurves& curves,
                                                      const continuation::CriticalStart& start,
                                                      const continuation::CriticalPoint& guess,
                                                      const continuation::CriticalPoint& from);

/// Puts a piece behind a curve, of which it begins at the last point.
void append(continuation::CriticalCurve piece, continuation::CriticalCurve& curve);

/// Leads a curve on to a point nearby, with the events between, each located by the curve's own points.
/// @returns whether one of them ends the curve
bool close_gap(const CaseCurves& curves, const continuation::CriticalStart& start,
               const std::vector<continuation::CriticalEvent>& events,
               const continuation::CriticalPoint& to, continuation::CriticalCurve& curve);

/// A curve that has come round once more ends at its start. One that does not pass it is left as it is.
/// @param s  behind this it passes its start again
void end_at_start(double s, continuation::CriticalCurve& curve);

}  // namespace springfold::analysis
