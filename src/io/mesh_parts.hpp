// What a mesh becomes: bars, folds, supports.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh.hpp"

namespace springfold::io {

/// The angle about an edge between two triangles, as the shape "fold" counts it.
struct MeshFold {
  std::array<std::size_t, 4> points{};  ///< tip, ends of the edge, tip
  bool is_cut = false;  ///< not an edge but a cut within a face, or flat by assignment
  double length = 0;    ///< of the edge
  double angle = 0;     ///< as drawn [rad], pi: flat
};

/// A vertex and the axes along which it is held.
struct MeshSupport {
  std::size_t vertex = 0;
  std::array<bool, 3> held{};
};

struct MeshParts {
  std::vector<bool> is_used{};  ///< per vertex: has it an edge?
  std::vector<std::array<std::size_t, 2>> bars{};
  std::size_t cuts = 0;  ///< the last bars: within faces
  std::vector<MeshFold> folds{};
  std::vector<MeshSupport> supports{};  ///< take all motions of the whole, each once
  std::vector<std::string> report{};    ///< what was left out
};

/// Reports faces that are no faces. @pre check_mesh reports nothing
MeshParts parts_of(const Mesh& mesh, Problems& problems);

}  // namespace springfold::io
