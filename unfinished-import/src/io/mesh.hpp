// Meshes of other programs, and the cases that they become. Private to io.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problems.hpp"
#include "springfold/core/types.hpp"

namespace springfold::io {

struct MeshEdge {
  std::size_t a = 0, b = 0;  ///< points
  bool can_fold = true;      ///< false: a boundary or a cut
  bool is_flat = false;      ///< within a facet: bends like one
};

/// Points are numbered as in the file, from `first_number`.
struct Mesh {
  std::string title{};
  std::size_t first_number = 0;
  std::vector<Eigen::Vector3d> points{};
  std::vector<MeshEdge> edges{};                   ///< each once
  std::vector<std::vector<std::size_t>> faces{};   ///< counter-clockwise from above
  std::vector<std::string> left_out{};             ///< sentences: what the file has beside that
};

/// Mistakes are added to `problems`; the mesh is not usable then.
Mesh read_fold(const std::string& bytes, const std::string& shown_name, Problems& problems);
Mesh read_obj(const std::string& bytes, const std::string& shown_name, Problems& problems);

/// Adds edges of faces that the file does not list.
void add_edges_of_faces(Mesh& mesh);

/// An edge with the corners of its two triangles that are not its own.
struct Fold {
  std::size_t before = 0, a = 0, b = 0, behind = 0;  ///< as `of` of a fold wants them
  bool is_crease = false;  ///< an edge of the file that may fold, otherwise a facet bends here
};

/// Cuts faces into triangles, the diagonals becoming edges that are flat: quadrilaterals along the shorter one,
/// others from their first corner. @returns all folds, creases first
std::vector<Fold> triangulate(Mesh& mesh);

/// The case: @pre the mesh has no problems and is triangulated
std::string case_text(const Mesh& mesh, const std::vector<Fold>& folds, const std::string& from);

}  // namespace springfold::io
