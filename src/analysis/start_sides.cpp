#include "start_sides.hpp"

#include <cmath>

#include "branch_rows.hpp"

namespace springfold::analysis {

std::vector<StartSide> sides_of_start(const Evaluator& evaluator,
                                      const continuation::CurvePoint& start) {
  constexpr double at_zero = 1e-10;
  constexpr std::size_t most = 4;
  const PathProblem& problem = evaluator.problem();
  Vector g;
  if (problem.switch_count() == 0 || !problem.switches(start.x, start.lambda, g)) return {};
  std::vector<std::size_t> resting;
  for (Index j = 0; j < g.size(); ++j)
    if (std::abs(g[j]) <= at_zero) resting.push_back(static_cast<std::size_t>(j));
  if (resting.empty() || resting.size() > most) return {};
  std::vector<StartSide> sides;
  for (std::size_t choice = 0; choice < (std::size_t{1} << resting.size()); ++choice) {
    continuation::CurvePoint beside = start;
    for (std::size_t k = 0; k < resting.size(); ++k)
      beside.piece[resting[k]] = (choice >> k & 1) != 0 ? std::int8_t{1} : std::int8_t{-1};
    sides.push_back({piece_text(problem.system(start.lambda), beside.piece),
                     evaluator.platform_stiffness(beside), evaluator.rigid_compliance(beside)});
  }
  return sides;
}

}  // namespace springfold::analysis
