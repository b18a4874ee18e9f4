// The states of a jump in their order. Private to io.
#pragma once

#include <vector>

#include "springfold/analysis/snap.hpp"

namespace springfold::io {

/// The motion as far as it was kept, then the landing itself, to which a motion only comes near within a finite time.
inline std::vector<analysis::SnapMoment> moments_to_landing(const analysis::Jump& jump) {
  std::vector<analysis::SnapMoment> moments = jump.motion;
  analysis::SnapMoment last = moments.empty() ? analysis::SnapMoment{} : moments.back();
  last.state = jump.landing;
  if (!jump.landing.values.empty()) moments.push_back(std::move(last));
  return moments;
}

}  // namespace springfold::io
