// The energy along jumps as a figure. Private to io.
#pragma once

#include "figure.hpp"

namespace springfold::io {

/// Of a run with jumps whose motions are known: energy over the length of way, one curve per jump, without axes yet. No
/// curves: there is none.
Figure motion_figure(const Case& the_case, const analysis::StudyResult& result);

}  // namespace springfold::io
