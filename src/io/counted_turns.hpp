// Angles of nodes that count whole turns. Private to io.
#pragma once

#include "mechanism_draft.hpp"

namespace springfold::io {

/// Gives both rays of every angle with `turns` a chain of a hinge and a slide, whose frame turns with the ray: nodes do
/// not turn themselves. They are called "<spring>.first" and "<spring>.last"; rays between fixed points need none.
/// @param mechanism  everything else is built
void add_ray_chains(const MechanismDraft& draft, model::Mechanism& mechanism);

}  // namespace springfold::io
