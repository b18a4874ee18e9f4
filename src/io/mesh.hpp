// Meshes of other programs: vertices, edges and faces with their places in the file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "problems.hpp"
#include "springfold/core/types.hpp"
#include "springfold/model/rotation_vector.hpp"

namespace springfold::io {

/// What an edge is where two faces meet.
enum class Crease { fold, flat, border, cut };

struct MeshEdge {
  std::array<std::size_t, 2> ends{};  ///< vertices, counted from 0
  Crease crease = Crease::fold;
  Place place{};
  std::string key{};
};

struct MeshFace {
  std::vector<std::size_t> corners{};
  Place place{};
  std::string key{};
};

struct Mesh {
  std::size_t first_number = 0;  ///< that of the first vertex in the file
  bool is_planar = false;        ///< two coordinates for every vertex
  std::vector<model::Vec3<double>> vertices{};
  std::vector<MeshEdge> edges{};
  std::vector<MeshFace> faces{};
  bool names_edges = false;             ///< do `edges` hold the sides of all faces?
  std::string length_unit{};            ///< as the file has it; empty: none
  std::vector<std::string> left_out{};  ///< what the file has besides: its own words
};

/// Of a triangle mesh with more of them bars and folds want more than the 2 GB that a case may need.
inline constexpr std::size_t most_vertices = 1'800;

/// Larger coordinates are no numbers of a case file.
inline constexpr double largest_coordinate = 1e100;
inline constexpr const char* coordinate_need = "a finite number, at most 1e100 in size";

/// Each reports everything that is wrong, with its place. The result is of use only without problems.
Mesh read_obj(std::string_view bytes, const std::string& file, Problems& problems);
Mesh read_fold(std::string_view bytes, const std::string& file, Problems& problems);

/// Corners and ends that are there twice, edges without a length, and the like. @pre the numbers of
/// vertices are those of vertices
void check_mesh(const Mesh& mesh, Problems& problems);

/// "v3": the vertex as the file numbers it.
std::string vertex_name(const Mesh& mesh, std::size_t vertex);

}  // namespace springfold::io
