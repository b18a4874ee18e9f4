#include "springfold/core/arnoldi.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/extended_matrix.hpp"
#include "springfold/core/rounding.hpp"

namespace springfold {
namespace {

/// An image leaves the basis by no more than this, of the map's size: the basis holds it.
constexpr double rounding_left = 1e-12;

}  // namespace

void Arnoldi::begin(Index n) {
  if (start_.size() != n) start_ = irregular_columns(n, 1);
  steps_ = std::min(most_steps, n);
  basis_.resize(n, steps_ + 1);
  basis_.col(0) = start_;
  H_.setZero(steps_ + 1, steps_);
  size_ = 0;
}

bool Arnoldi::add() {
  const auto basis = basis_.leftCols(size_ + 1);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_steps + 1, 1> in_basis;
  for (int pass = 0; pass < 2; ++pass) {
    in_basis.noalias() = basis.transpose() * image_;
    H_.col(size_).head(size_ + 1) += in_basis;
    image_.noalias() -= basis * in_basis;
  }
  const double left = image_.norm();
  ++size_;
  H_(size_, size_ - 1) = left;
  if (!(left > rounding_left * H_.norm())) return false;
  basis_.col(size_) = image_ / left;
  return size_ < steps_;
}

double Arnoldi::largest() const {
  const SmallMatrix M = H_.topLeftCorner(size_, size_);
  if (!M.allFinite()) return infinity;
  return spectral_radius(M);
}

}  // namespace springfold
