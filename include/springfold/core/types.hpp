// Names for the numbers that every layer uses. Symbols and frames: core/notation.hpp.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace springfold {

using Index = Eigen::Index;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Which smooth piece of a piecewise-smooth problem is meant: one sign per switch,
/// +1 where the switching function is positive, -1 where it is negative. Empty for smooth problems.
using Piece = std::vector<std::int8_t>;

}  // namespace springfold
