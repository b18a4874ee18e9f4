// Stability of states at which springs rest: all pieces together decide it.
#include <algorithm>
#include <cmath>

#include "quantities.hpp"
#include "resting.hpp"
#include "springfold/statics/shapes.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

/// Gradients of the switches by the unknowns of the path's own equations, as columns.
std::optional<Matrix> own_directions(const PathProblem& problem, const continuation::CurvePoint& at,
                                     const Switches& resting) {
  Matrix dg;
  Vector dg_dlambda;
  if (!problem.switch_gradients(at.x, at.lambda, dg, dg_dlambda)) return std::nullopt;
  return Matrix(dg(resting, Eigen::all).transpose());
}

/// The same by all unknowns of the statics, in the frames of Evaluator::assemble.
std::optional<Matrix> whole_directions(const PathProblem& problem,
                                       const continuation::CurvePoint& at,
                                       const Switches& resting) {
  Vector z;
  const statics::System& system = problem.turned_to_pose(at.x, at.lambda, z);
  const statics::Inputs inputs = problem.inputs(at.lambda);
  Matrix E(system.size, static_cast<Index>(resting.size()));
  statics::SwitchGradient gradient;
  for (std::size_t k = 0; k < resting.size(); ++k) {
    if (!switch_gradient(system, resting[k], z, inputs.rho, gradient)) return std::nullopt;
    E.col(static_cast<Index>(k)) = gradient.z;
  }
  return E;
}

}  // namespace

Switches Evaluator::resting_at(const continuation::CurvePoint& point,
                               const KnownSwitches& known) const {
  if (problem_.switch_count() == 0) return {};
  if (!rest_ || !is_same(rest_->point, point))
    rest_ = KnownRest{point, resting_switches(problem_, point)};
  Switches resting = rest_->list;
  std::erase_if(resting, [&](std::size_t j) {
    return std::ranges::find(known.leaving, j) != known.leaving.end();
  });
  Switches all;
  std::ranges::set_union(resting, known.staying, std::back_inserter(all));
  return all;
}

std::optional<RestingIndex> Evaluator::resting_index_of(Kind kind,
                                                        const continuation::CurvePoint& point,
                                                        const KnownSwitches& known) const {
  // Under dead load both are one count: what rounding makes of two matrices is not to part them.
  if (kind == Kind::index && control_ == ControlMode::load) kind = Kind::index_force;
  if (stages_ || !problem_.symmetric()) return std::nullopt;
  const Switches resting = resting_at(point, known);
  if (resting.empty()) return std::nullopt;
  const auto directions = kind == Kind::index ? own_directions(problem_, point, resting)
                                              : whole_directions(problem_, point, resting);
  if (!directions) return std::nullopt;
  const auto own = [&](const Piece& piece) -> std::optional<Matrix> {
    Matrix J;
    Vector dF_dlambda;
    if (!problem_.derivatives(point.x, point.lambda, piece, J, dF_dlambda)) return std::nullopt;
    return J;
  };
  const auto whole = [&](const Piece& piece) -> std::optional<Matrix> {
    continuation::CurvePoint beside = point;
    beside.piece = piece;
    const Assembled* at = assemble_densely(beside);
    if (!at) return std::nullopt;
    if (kind == Kind::index_force) return at->A;
    return Matrix(statics::without_gauge(at->A, at->work).topLeftCorner(first_pose_, first_pose_));
  };
  const MatrixOfPiece matrix = kind == Kind::index ? MatrixOfPiece(own) : MatrixOfPiece(whole);
  const Matrix E = directions->topRows(kind == Kind::index_pose ? first_pose_ : directions->rows());
  // With all bodies held a spring between them stays as it is.
  std::vector<Index> moving;
  Switches switching;
  for (std::size_t k = 0; k < resting.size(); ++k) {
    const auto column = static_cast<Index>(k);
    if (E.col(column).isZero(0)) continue;
    moving.push_back(column);
    switching.push_back(resting[k]);
  }
  return resting_index(matrix, point.piece, switching, E(Eigen::all, moving), problem_.closures());
}

std::optional<Index> Evaluator::unstable_modes(const QuantityDefinition& index,
                                               const continuation::CurvePoint& point) const {
  const double value = values({index}, point).front();
  if (std::isnan(value)) return std::nullopt;
  return static_cast<Index>(value);
}

void Evaluator::decide_indices(const std::vector<QuantityDefinition>& quantities,
                               const continuation::CurvePoint& point, const KnownSwitches& known,
                               std::vector<double>& values) const {
  const Switches resting = resting_at(point, known);
  if (resting.empty()) return;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Kind kind = quantities[i].kind;
    if (kind != Kind::index && kind != Kind::index_pose && kind != Kind::index_force) continue;
    if (const auto decided = resting_index_of(kind, point, known))
      values[i] = decided->index();
    else
      values[i] = largest_index(quantities[i], point, resting, values[i]);
  }
}

double Evaluator::largest_index(const QuantityDefinition& quantity,
                                const continuation::CurvePoint& point,
                                const std::vector<std::size_t>& resting, double own) const {
  for (Piece& piece : pieces_around(point.piece, resting)) {
    if (piece == point.piece) continue;
    continuation::CurvePoint beside = point;
    beside.piece = std::move(piece);
    beside.negative.reset();
    count_negative(problem_, beside);
    if (const Assembled* at = assemble(beside))
      own = std::max(own, from_matrix(quantity, beside, *at, {}));
  }
  return own;
}

}  // namespace springfold::analysis
