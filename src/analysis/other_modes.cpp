#include "other_modes.hpp"

#include <algorithm>

#include "springfold/continuation/newton.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// As many as are negative once all are greater by what vanishes beside the largest.
/// @param known  the matrix there, where it is known
std::optional<double> unstable_modes(const PathProblem& problem,
                                     const continuation::CurvePoint& point, const Piece& piece,
                                     const Matrix* known) {
  constexpr double vanishing = 1e-9;
  continuation::Linearisation at;
  if (!problem.symmetric()) return std::nullopt;
  if (known != nullptr)
    at.dF_dx = *known;
  else if (!continuation::linearise_densely(problem, point.x, point.lambda, piece, at))
    return std::nullopt;
  const double largest = at.dF_dx.cwiseAbs().colwise().sum().maxCoeff();
  at.dF_dx.diagonal().array() += vanishing * largest;
  const auto negative = negative_eigenvalues(at);
  if (!negative) return std::nullopt;
  return static_cast<double>(*negative - problem.closures());
}

}  // namespace

void count_other_modes(const Member& member, const continuation::CriticalStart& of,
                       const continuation::CurvePoint& point, std::vector<double>& values) {
  using continuation::CriticalKind;
  if (of.kind == CriticalKind::zero) return;
  auto count = unstable_modes(*member.problem, point, of.piece,
                              member.evaluator().known_matrix(point.x, point.lambda, of.piece));
  if (of.kind == CriticalKind::surface) {
    const auto behind = unstable_modes(*member.problem, point, of.behind, nullptr);
    count = count && behind ? std::optional{std::min(*count, *behind)} : std::nullopt;
  }
  if (!count) return;
  const std::vector<QuantityDefinition>& quantities = member.quantities();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const QuantityDefinition::Kind kind = quantities[i].kind;
    const bool same =
        kind == QuantityDefinition::Kind::index_force && member.study.control == ControlMode::load;
    if (kind == QuantityDefinition::Kind::index || same) values[i] = *count;
  }
}

}  // namespace springfold::analysis
