// Random guyed columns and frames: a case file and its closed forms.
#pragma once

#include <string>
#include <vector>

#include "../known_answers/random.hpp"
#include "cones.hpp"

namespace springfold::guyed {

using known_answers::Random;

/// A column of the branch table that tells a coordinate of the sway.
struct Sway {
  std::string quantity{};
  double upright = 0;
};

struct Draw {
  std::string family{};  ///< "column", "column in space", "frame", "frame in space"
  double pretension =
      0;  ///< of the length of the cables; negative: slack; not a number: of each pair its own
  std::string text{};  ///< the case file
  Structure structure{};
  std::vector<Sway> sways{};  ///< in the order of Structure's coordinates
  double from = 0, to = 0;    ///< loads that the study asks for
};

/// Cables stretched or slack by less than this part of their length may be told as just at rest.
inline constexpr double told_as_resting = 1e-10;

/// What is drawn.
struct Kind {
  bool space_frame = false;  ///< a frame in space; otherwise one of the other families
  bool mixed =
      false;  ///< every cable, or pair of them, has a pretension of its own; otherwise all have one
  bool wide = false;  ///< stiffnesses of cables from 1e-4 to 1e4; otherwise from 0.3 to 3
};

/// One of the families, with 1 to 6 cables that are stretched, slack or just at rest.
Draw draw(Random& random, const Kind& kind);

}  // namespace springfold::guyed
