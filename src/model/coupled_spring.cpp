#include "springfold/model/coupled_spring.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::model {
namespace {

std::string entry(Index row, Index column, double value) {
  return "entry [" + std::to_string(row + 1) + "][" + std::to_string(column + 1) + "] is " +
         rounded(value, 6);
}

/// Diagonal entries must be able to scale: an empty row is allowed where no eigenvalue need be > 0.
std::string diagonal_problem(const Matrix& m, Definiteness need) {
  for (Index i = 0; i < m.rows(); ++i) {
    if (m(i, i) < 0) return entry(i, i, m(i, i)) + ", need no negative number on the diagonal";
    if (m(i, i) > 0) continue;
    if (need == Definiteness::definite)
      return entry(i, i, 0) +
             ", need a number > 0: a direction that does not give way is rigid, "
             "leave it out";
    for (Index j = 0; j < m.cols(); ++j)
      if (m(i, j) != 0 || m(j, i) != 0)
        return entry(i, i, 0) + " but its row is not zero: the matrix has a negative eigenvalue";
  }
  return {};
}

Vector scaling_of(const Matrix& m) {
  return m.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1.0; });
}

}  // namespace

std::string problem_in(const Matrix& m, Definiteness need) {
  if (m.rows() != m.cols() || m.rows() == 0) return "need a square matrix";
  if (!m.allFinite()) return "need finite numbers";
  if (std::string problem = diagonal_problem(m, need); !problem.empty()) return problem;
  const Vector s = scaling_of(m);
  const Matrix unit = s.asDiagonal() * m * s.asDiagonal();
  for (Index i = 0; i < m.rows(); ++i)
    for (Index j = i + 1; j < m.cols(); ++j)
      if (std::abs(unit(i, j) - unit(j, i)) > 1e-9)
        return entry(i, j, m(i, j)) + " and " + entry(j, i, m(j, i)) + ", need a symmetric matrix";
  const double least = symmetric_eigenvalues(0.5 * (unit + unit.transpose()))[0];
  const std::string what =
      "its smallest eigenvalue is " + rounded(least, 6) + " (with the diagonal scaled to 1)";
  if (need == Definiteness::semidefinite && least < -1e-10)
    return what + ", need no negative eigenvalue";
  if (need == Definiteness::definite && least < 1e-14) return what + ", need a positive one";
  return {};
}

Matrix inverse_of(const Matrix& m) {
  const Vector s = scaling_of(m);
  const Matrix unit = s.asDiagonal() * (0.5 * (m + m.transpose())) * s.asDiagonal();
  const Matrix inverse = solve_definite(unit, Matrix(Matrix::Identity(m.rows(), m.cols())));
  const Matrix result = s.asDiagonal() * inverse * s.asDiagonal();
  return 0.5 * (result + result.transpose());
}

}  // namespace springfold::model
