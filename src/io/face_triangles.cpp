// Faces of more than three corners, cut into triangles.
#include "face_triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace springfold::io {
namespace {

using Corners = std::vector<std::size_t>;
using CornerPoint = model::Vec3<double>;

/// Twice the area as a vector (Newell): also of faces that are not flat.
CornerPoint area_of_face(const Mesh& mesh, const Corners& corners) {
  CornerPoint sum = CornerPoint::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += mesh.vertices[corners[i]].cross(mesh.vertices[corners[(i + 1) % corners.size()]]);
  return sum;
}

/// Seen along the face's normal: > 0 where the way from a over b to c turns left.
double turn_at(const Mesh& mesh, const CornerPoint& normal, std::size_t a, std::size_t b,
               std::size_t c) {
  const CornerPoint to = mesh.vertices[b] - mesh.vertices[a];
  return normal.dot(to.cross(mesh.vertices[c] - mesh.vertices[b]));
}

/// Does the corner point inwards?
bool is_reflex(const Mesh& mesh, const CornerPoint& normal, const Corners& corners, std::size_t i) {
  const std::size_t n = corners.size();
  return turn_at(mesh, normal, corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]) < 0;
}

/// Can the corner be cut off along the line between its neighbours? No other corner may lie within what is cut off.
bool is_ear(const Mesh& mesh, const CornerPoint& normal, const Corners& corners, std::size_t i) {
  const std::size_t n = corners.size();
  const std::size_t a = corners[(i + n - 1) % n], b = corners[i], c = corners[(i + 1) % n];
  if (!(turn_at(mesh, normal, a, b, c) > 0)) return false;
  return std::none_of(corners.begin(), corners.end(), [&](std::size_t p) {
    return p != a && p != b && p != c && turn_at(mesh, normal, a, b, p) >= 0 &&
           turn_at(mesh, normal, b, c, p) >= 0 && turn_at(mesh, normal, c, a, p) >= 0;
  });
}

std::vector<MeshTriangle> fan_of(const Corners& c, std::size_t first) {
  std::vector<MeshTriangle> triangles;
  const std::size_t n = c.size();
  for (std::size_t i = 1; i + 1 < n; ++i)
    triangles.push_back({c[first], c[(first + i) % n], c[(first + i + 1) % n]});
  return triangles;
}

/// One corner after the other is cut off; a face that crosses itself has none left at some time.
std::vector<MeshTriangle> cut_off(const Mesh& mesh, Corners corners, const CornerPoint& normal) {
  std::vector<MeshTriangle> triangles;
  while (corners.size() > 3) {
    const std::size_t n = corners.size();
    std::size_t ear = 0;
    while (ear < n && !is_ear(mesh, normal, corners, ear)) ++ear;
    if (ear == n) return {};
    triangles.push_back({corners[(ear + n - 1) % n], corners[ear], corners[(ear + 1) % n]});
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  if (turn_at(mesh, normal, corners[0], corners[1], corners[2]) < 0) return {};
  triangles.push_back({corners[0], corners[1], corners[2]});
  return triangles;
}

}  // namespace

std::vector<MeshTriangle> triangles_of(const Mesh& mesh, const MeshFace& face) {
  const Corners& c = face.corners;
  const CornerPoint normal = area_of_face(mesh, c);
  std::vector<std::size_t> reflex;
  for (std::size_t i = 0; c.size() > 3 && i < c.size(); ++i)
    if (is_reflex(mesh, normal, c, i)) reflex.push_back(i);
  if (reflex.size() == 1 && c.size() == 4) return fan_of(c, reflex.front());
  if (!reflex.empty()) return cut_off(mesh, c, normal);
  const auto diagonal = [&](std::size_t a, std::size_t b) {
    return (mesh.vertices[c[b]] - mesh.vertices[c[a]]).norm();
  };
  if (c.size() == 4 && diagonal(1, 3) < diagonal(0, 2))
    return {{c[0], c[1], c[3]}, {c[1], c[2], c[3]}};
  return fan_of(c, 0);
}

}  // namespace springfold::io
