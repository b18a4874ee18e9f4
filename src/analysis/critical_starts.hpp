// Special points of paths as the engine follows them in a parameter. Private to analysis.
#pragma once

#include "base_path.hpp"

namespace springfold::analysis {

/// A start as that of a limit point of the force on the piece of `at`, where d(force)/ds is zero: kind, function and
/// equations.
void make_limit_of_force(const CaseCurves& curves, const continuation::CurvePoint& at,
                         continuation::CriticalStart& start);

/// What is zero at a marked value, or at the extremum of a column, as a function of states on a piece. Empty: no such
/// column.
continuation::StateFunction marked_value_on(const CaseCurves& curves, const Member& member,
                                            const SpecialPoint& point, const Piece& piece);

/// How the engine follows this special point; nothing for kinds that cannot be followed (`why` says it).
std::optional<continuation::CriticalStart> critical_start(const CaseCurves& curves,
                                                          const Member& member,
                                                          const SpecialPoint& point,
                                                          std::string& why);

/// The same for critical curves, on which of several springs that switch at once another one may be the first on each
/// side: one start for each of them, where the parameter parts them. Empty: `why`.
std::vector<continuation::CriticalStart> critical_starts(const CaseCurves& curves,
                                                         const Member& member,
                                                         const SpecialPoint& point,
                                                         std::string& why);

/// A start on a critical curve of other curves, at its place and at the first value of these: the same kind of
/// point. More than one as above.
/// @param member, point  what that curve is one of, with the member on whose path it lies
std::vector<continuation::CriticalStart> critical_starts_again(const CaseCurves& curves,
                                                               const Member& member,
                                                               const SpecialPoint& point,
                                                               continuation::CriticalStart same);

}  // namespace springfold::analysis
