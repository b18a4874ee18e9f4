#include "switched_springs.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::analysis {
namespace {

/// Does the spring of a switch store energy in a state?
bool stores_energy(const Frozen& frozen, const Vector& x, const statics::Switch& at) {
  const statics::System& system = frozen.problem().layout();
  const Vector z = frozen.unknowns(x);
  const auto stores = [](const model::CompiledSpring& law, double c) {
    return std::abs(law.energy(law.segment_at(c), c)) > 0;
  };
  if (!at.of_shape()) {
    const statics::CoordinateSpring& spring = system.springs[at.spring];
    return stores(spring.law, z[spring.coordinate]);
  }
  const double own = shape_state(system, at.spring, z, frozen.problem().inputs(0)).own;
  return stores(system.shapes[at.spring].law, own);
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
