#include "switched_springs.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::analysis {
namespace {

/// Does the spring of a switch store energy in a state? Those of shapes do.
bool stores_energy(const Frozen& frozen, const Vector& x, const statics::Switch& at) {
  if (at.of_shape()) return true;
  const statics::CoordinateSpring& spring = frozen.problem().layout().springs[at.spring];
  const double c = frozen.unknowns(x)[spring.coordinate];
  return std::abs(spring.law.energy(spring.law.segment_at(c), c)) > 0;
}

}  // namespace

std::vector<std::string> switched_springs(const PathProblem& traced, const Frozen& frozen,
                                          const Vector& before, const RestState& landing) {
  std::vector<std::string> names;
  const std::vector<Piece> pieces = frozen.landscape().pieces_beside(before);
  for (std::size_t j = 0; !pieces.empty() && j < landing.piece.size(); ++j) {
    const auto side = pieces.front()[j];
    const bool rests = std::any_of(pieces.begin(), pieces.end(),
                                   [&](const Piece& other) { return other[j] != side; });
    const bool is_switched =
        rests ? stores_energy(frozen, landing.x, frozen.problem().layout().switches[j])
              : side != landing.piece[j];
    if (is_switched) names.push_back(traced.switch_name(static_cast<Index>(j)));
  }
  return names;
}

}  // namespace springfold::analysis
