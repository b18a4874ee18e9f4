// Which numbers of a mechanism a parameter moves, where it moves few.
#pragma once

#include <cstddef>
#include <vector>

namespace springfold::model {

/// Parts of a mechanism that get other numbers, while they stay where and what they are.
struct MovedParts {
  struct OfChain {
    std::size_t chain = 0, part = 0;
  };
  std::vector<OfChain> laws{};       ///< spring laws of joints: numbers among Chain::elements
  std::vector<OfChain> commands{};   ///< of joints, likewise
  std::vector<OfChain> coupled{};    ///< stiffness and free values, among Chain::coupled_springs
  std::vector<std::size_t> lines{};  ///< stiffness and free length, among Mechanism::line_springs
  std::vector<std::size_t> shape_laws{};  ///< laws, among Mechanism::shape_springs
  std::vector<std::size_t> loads{};       ///< vectors, among Mechanism::loads
};

}  // namespace springfold::model
