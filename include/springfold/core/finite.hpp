// Are all numbers finite? Without branches, so that processors check several at once.
#pragma once

#include "springfold/core/types.hpp"

namespace springfold {

/// 0 times a number is 0 if it is finite, otherwise NaN.
template <class Numbers>
bool all_finite(const Eigen::DenseBase<Numbers>& numbers) {
  return (0 * numbers.derived().array()).sum() == 0;
}

}  // namespace springfold
