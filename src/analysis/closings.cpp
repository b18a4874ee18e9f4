#include "closings.hpp"

#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {

void Closings::compute(Matrix J, Index redundant) {
  J_ = std::move(J);
  rows_.compute(J_, redundant);
}

Matrix Closings::motions() const { return independent() ? rows_.kernel() : kernel_of(J_); }

Vector Closings::least_norm(const Vector& rates) const {
  return independent() ? rows_.least_norm(rates) : least_squares(J_, rates);
}

Vector Closings::multipliers(const Vector& force) const {
  return independent() ? rows_.multipliers(force) : least_squares(J_.transpose(), force);
}

}  // namespace springfold::analysis
