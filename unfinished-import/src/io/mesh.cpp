#include "mesh.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace springfold::io {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;

Pair sorted(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

std::set<Pair> pairs_of(const Mesh& mesh) {
  std::set<Pair> pairs;
  for (const MeshEdge& edge : mesh.edges) pairs.insert(sorted(edge.a, edge.b));
  return pairs;
}

/// Corners of a face as triangles; new diagonals are added.
void cut(const std::vector<std::size_t>& face, Mesh& mesh, std::set<Pair>& known,
         std::vector<std::array<std::size_t, 3>>& triangles) {
  const auto distance = [&mesh](std::size_t a, std::size_t b) {
    return (mesh.points[a] - mesh.points[b]).norm();
  };
  const bool turn = face.size() == 4 && distance(face[1], face[3]) < distance(face[0], face[2]);
  std::vector<std::size_t> corners = face;
  if (turn) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    triangles.push_back({corners[0], corners[k], corners[k + 1]});
    if (k + 2 < corners.size() && known.insert(sorted(corners[0], corners[k + 1])).second)
      mesh.edges.push_back({corners[0], corners[k + 1], true, true});
  }
}

}  // namespace

void add_edges_of_faces(Mesh& mesh) {
  std::set<Pair> known = pairs_of(mesh);
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::size_t a = face[k], b = face[(k + 1) % face.size()];
      if (known.insert(sorted(a, b)).second) mesh.edges.push_back({a, b});
    }
}

std::vector<Fold> triangulate(Mesh& mesh) {
  std::vector<std::array<std::size_t, 3>> triangles;
  std::set<Pair> known = pairs_of(mesh);
  for (const auto& face : mesh.faces) cut(face, mesh, known, triangles);
  std::map<Pair, std::size_t> corner;  // opposite to a directed side, on its left
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) corner[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  std::vector<Fold> creases, bends;
  for (const MeshEdge& edge : mesh.edges) {
    const auto left = corner.find({edge.a, edge.b}), right = corner.find({edge.b, edge.a});
    if (left == corner.end() || right == corner.end() || !edge.can_fold) continue;
    (edge.is_flat ? bends : creases)
        .push_back({right->second, edge.a, edge.b, left->second, !edge.is_flat});
  }
  creases.insert(creases.end(), bends.begin(), bends.end());
  return creases;
}

}  // namespace springfold::io
