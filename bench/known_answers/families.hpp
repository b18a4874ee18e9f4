// The families of the campaign; main.cpp says what each one is.
#pragma once

#include "draw.hpp"
#include "random.hpp"

namespace springfold::known_answers {

Draw fold_ladder(Random& random);
Draw strands(Random& random);
Draw pitchfork(Random& random);
Draw two_mode(Random& random);
Draw n_pod_dome(Random& random);
Draw von_mises_sway(Random& random);
Draw link_column(Random& random);
Draw trammel(Random& random);
Draw one_sided(Random& random);
Draw crossing(Random& random);
Draw opposite(Random& random);

}  // namespace springfold::known_answers
