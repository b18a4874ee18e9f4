// Stability of states at which springs rest: all pieces together decide it.
#include <algorithm>

#include "quantities.hpp"
#include "resting.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

std::vector<Index> coordinates_of(const PathProblem& problem, double lambda,
                                  const std::vector<std::size_t>& resting) {
  std::vector<Index> list;
  for (const std::size_t j : resting) list.push_back(problem.system(lambda).switches[j].coordinate);
  return list;
}

}  // namespace

std::optional<RestingIndex> Evaluator::resting_index_of(
    Kind kind, const continuation::CurvePoint& point) const {
  if (stages_ || !problem_.symmetric()) return std::nullopt;
  const std::vector<std::size_t> resting = resting_switches(problem_, point);
  if (resting.empty()) return std::nullopt;
  const std::vector<Index> coordinates = coordinates_of(problem_, point.lambda, resting);
  if (std::find(coordinates.begin(), coordinates.end(), -1) != coordinates.end())
    return std::nullopt;  // of a shape: the pieces do not differ by one entry of the diagonal
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
  return resting_index(kind == Kind::index ? MatrixOfPiece(own) : MatrixOfPiece(whole), point.piece,
                       resting, coordinates, problem_.closures());
}

void Evaluator::decide_indices(const std::vector<QuantityDefinition>& quantities,
                               const continuation::CurvePoint& point,
                               std::vector<double>& values) const {
  const std::vector<std::size_t> resting = resting_switches(problem_, point);
  if (resting.empty()) return;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Kind kind = quantities[i].kind;
    if (kind != Kind::index && kind != Kind::index_pose && kind != Kind::index_force) continue;
    if (const auto decided = resting_index_of(kind, point))
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
