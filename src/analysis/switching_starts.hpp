// Special points at switching springs as the engine follows them in a parameter. Private to analysis.
#pragma once

#include "base_path.hpp"

namespace springfold::analysis {

/// What turns back at a corner at which the force does and lambda does not: its rate along the curve of either side.
continuation::RateFunction force_turns(const CaseCurves& curves);

/// One where one spring switches, or several that the parameter keeps together, all at once behind the point; otherwise
/// one for each of them, with itself alone behind it: on either side of the parameter another one may be the first.
std::vector<continuation::CriticalStart> starts_on_surfaces(const CaseCurves& curves,
                                                            const std::vector<Index>& switches,
                                                            continuation::CriticalStart start);

/// The same at a switching or corner of a path. Empty: several_switch() says why.
std::vector<continuation::CriticalStart> starts_at_switching(const CaseCurves& curves,
                                                             const SpecialPoint& point,
                                                             continuation::CriticalStart start);

std::string several_switch(const SpecialPoint& point);

/// The way through this special point along which its springs rest, before it and behind it: none of them switches
/// there, the eigenvalue of a piece vanishes. Where branches meet it need not be the path's own. Nothing: there is
/// none.
std::optional<continuation::CurvePoint> way_at_rest(const Member& member,
                                                    const SpecialPoint& point);

/// The switches that are zero along the path before and behind a special point, though nothing of them happens there.
std::vector<Index> switches_at_rest(const Member& member, const SpecialPoint& point);

/// Where springs rest: the pieces in which half-branches leave or arrive, or the path's own where none does.
std::vector<Piece> pieces_at_rest(const Member& member, const SpecialPoint& point);

/// A point at which springs rest is a branch point of the piece of its half-branch, or of the path's own piece where
/// there is none, as long as the parameter lets them rest. Several pieces count as one where the parameter moves them
/// alike, as mirror images do. Nothing: `why`.
/// @param at  on the way along which they rest, way_at_rest()
std::optional<continuation::CriticalStart> start_at_rest(const CaseCurves& curves,
                                                         const Member& member,
                                                         const SpecialPoint& point,
                                                         const continuation::CurvePoint& at,
                                                         std::string& why);

}  // namespace springfold::analysis
