#include "springfold/io/import.hpp"

#include <algorithm>

#include "atomic_file.hpp"
#include "mesh.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {
namespace {

/// As many tables of one name a case may have.
constexpr std::size_t most_parts = 10'000;

}  // namespace

std::string imported_case(const std::string& bytes, const std::filesystem::path& file_name) {
  const std::string shown = file_name.string(), ending = file_name.extension().string();
  Problems problems;
  Mesh mesh;
  if (ending == ".fold")
    mesh = read_fold(bytes, shown, problems);
  else if (ending == ".obj")
    mesh = read_obj(bytes, shown, problems);
  else
    problems.add({shown, 0, 0}, "", "need a file that ends in .fold or .obj");
  std::vector<Fold> folds;
  if (problems.empty()) {
    add_edges_of_faces(mesh);
    folds = triangulate(mesh);
    if (mesh.edges.empty())
      problems.add({shown, 0, 0}, "", "has neither edges nor faces, need what holds its points together");
    if (std::max({mesh.points.size(), mesh.edges.size(), folds.size()}) > most_parts)
      problems.add({shown, 0, 0}, "",
                   "has " + std::to_string(mesh.points.size()) + " points, " +
                       std::to_string(mesh.edges.size()) + " edges and " +
                       std::to_string(folds.size()) + " folds, a case has at most " +
                       std::to_string(most_parts) + " of each");
  }
  if (!problems.empty()) throw CaseError{problems.messages()};
  return case_text(mesh, folds, file_name.filename().string());
}

std::string import_file(const std::filesystem::path& file) {
  return imported_case(read_file(file), file);
}

}  // namespace springfold::io
