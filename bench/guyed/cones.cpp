#include "cones.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace springfold::guyed {
namespace {

constexpr double rounding = 1e-9;  // of rates and directions of length one

using Sides = std::vector<int>;  // per resting cable: +1 acts, -1 does not

/// Does a cone { w : side_j rate_j w > 0 } hold anything? Not if a positive combination of some of its rows is zero
/// (Gordan); it is enough to look at the sets of rows with one relation between them.
bool has_room(const Matrix& rates, const Sides& sides) {
  const Index k = rates.rows();
  for (unsigned set = 1; set < (1u << k); ++set) {
    std::vector<Index> members;
    for (Index j = 0; j < k; ++j)
      if (set >> j & 1u) members.push_back(j);
    Matrix rows = rates(members, Eigen::all);
    for (std::size_t i = 0; i < members.size(); ++i)
      rows.row(static_cast<Index>(i)) *=
          sides[static_cast<std::size_t>(members[i])] / rows.row(static_cast<Index>(i)).norm();
    const Eigen::JacobiSVD<Matrix> svd(rows, Eigen::ComputeFullU);
    const Vector& sigma = svd.singularValues();
    const Index rank = (sigma.array() > rounding).count();
    if (rank + 1 != rows.rows()) continue;
    const Vector relation = svd.matrixU().rightCols(1);
    if ((relation.array() > rounding).all() || (relation.array() < -rounding).all()) return false;
  }
  return true;
}

/// On the closed cone; a cable that keeps its length to first order may do either.
bool inside(const Matrix& rates, const Sides& sides, const Vector& w) {
  for (Index j = 0; j < rates.rows(); ++j)
    if (sides[static_cast<std::size_t>(j)] * rates.row(j).dot(w) < -rounding * rates.row(j).norm())
      return false;
  return true;
}

void add(const HalfBranch& found, std::vector<HalfBranch>& list) {
  for (const HalfBranch& known : list)
    if (std::abs(known.load - found.load) <= rounding * std::max(1.0, std::abs(found.load)) &&
        (known.direction - found.direction).norm() <= 1e-6)
      return;
  list.push_back(found);
}

void add_piece(const Matrix& K, const Matrix& rates, const Sides& sides, Truth& truth) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> modes(K, truth.load);
  for (Index i = 0; i < K.rows(); ++i)
    for (const double sense : {1.0, -1.0}) {
      const Vector w = sense * modes.eigenvectors().col(i).normalized();
      if (inside(rates, sides, w)) add({modes.eigenvalues()[i], w}, truth.leaving);
    }
  truth.pieces.push_back(K);
}

}  // namespace

int Truth::index(double P) const {
  if (!leaving.empty() && P < leaving.front().load) return 0;
  Index least = load.rows();
  for (const Matrix& K : pieces) {
    const Eigen::SelfAdjointEigenSolver<Matrix> modes(K - P * load, Eigen::EigenvaluesOnly);
    least = std::min<Index>(least, (modes.eigenvalues().array() < 0).count());
  }
  return static_cast<int>(rests ? std::max<Index>(1, least) : least);
}

Truth truth(const Structure& structure, double at_rest) {
  Truth result{.load = structure.load};
  Matrix K = structure.springs;
  std::vector<const Cable*> resting;
  for (const Cable& cable : structure.cables) {
    if (std::abs(cable.stretch) <= at_rest * cable.length)
      resting.push_back(&cable);
    else if (cable.stretch > 0)
      K += cable.stiffness * (cable.rate * cable.rate.transpose() + cable.stretch * cable.second);
  }
  const auto k = static_cast<Index>(resting.size());
  result.rests = k > 0;
  Matrix rates(k, K.rows());
  for (Index j = 0; j < k; ++j) rates.row(j) = resting[static_cast<std::size_t>(j)]->rate;
  for (unsigned acting = 0; acting < (1u << k); ++acting) {
    Sides sides;
    Matrix piece = K;
    for (Index j = 0; j < k; ++j) {
      sides.push_back(acting >> j & 1u ? 1 : -1);
      if (sides.back() > 0)
        piece += resting[static_cast<std::size_t>(j)]->stiffness *
                 (rates.row(j).transpose() * rates.row(j));
    }
    if (has_room(rates, sides)) add_piece(piece, rates, sides, result);
  }
  std::stable_sort(result.leaving.begin(), result.leaving.end(),
                   [](const HalfBranch& a, const HalfBranch& b) { return a.load < b.load; });
  return result;
}

}  // namespace springfold::guyed
