// Models of other programs as case files.
#pragma once

#include <filesystem>
#include <string>

namespace springfold::io {

/// The text of a case file with the nodes, bars and folds of a mesh: FOLD (.fold, origami as JSON) or Wavefront
/// OBJ (.obj). Every edge becomes a bar, every edge between two faces a fold, relaxed as drawn; faces of more
/// than three corners are cut into triangles by bars with folds of their own. Three nodes are supported so that
/// nothing can move as a whole. A comment at the end says what the file has and the case has not.
/// @param file_name  as it is shown in the case and in messages
/// @throws CaseError for mistakes in the file, all at once, each with its place
std::string imported_case(const std::string& bytes, const std::filesystem::path& file_name);

/// The same with the bytes of the file. @throws std::runtime_error "cannot read <path>: <reason>"
std::string import_file(const std::filesystem::path& file);

}  // namespace springfold::io
