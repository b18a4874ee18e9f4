// Faces of more than three corners, cut into triangles. Private to io.
#pragma once

#include <array>
#include <vector>

#include "mesh.hpp"

namespace springfold::io {

using MeshTriangle = std::array<std::size_t, 3>;

/// Triangles of a face, in its sense: convex ones of four corners along the shorter diagonal, of more from the first
/// corner; those with a corner that points inwards so that all cuts lie inside, corner by corner. Empty where there is
/// no such way: a face that crosses itself.
std::vector<MeshTriangle> triangles_of(const Mesh& mesh, const MeshFace& face);

}  // namespace springfold::io
