// Case files from meshes: edges become bars, inner edges folds.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace springfold::io {

struct ImportedCase {
  std::string text{};                 ///< a case file (TOML) that load_case accepts
  std::vector<std::string> report{};  ///< what was made, what was left out, as sentences
};

/// Reads a mesh, Wavefront OBJ (.obj) or FOLD (.fold, the JSON format of origami), and writes it as a case: a node for
/// every vertex with an edge, a bar for every edge, a spring of the angle (a fold) over every edge between two faces.
/// Convex faces of four corners are cut along their shorter diagonal, those of more from their first corner, all others
/// so that the cuts lie inside; a cut is a bar with a fold, too. Bars and folds have no force as drawn. Six motions of
/// the whole (three in the plane) are held. Source of the formats: OBJ, appendix B1 of Wavefront's Advanced Visualizer
/// manual; FOLD 1.1, github.com/edemaine/fold.
/// @throws CaseError with file, line and column where the file is not what it should be
/// @throws continuation::Interrupted if `stop_requested` says so while the file is read
ImportedCase import_mesh(const std::filesystem::path& file,
                         const std::function<bool()>& stop_requested = {});

/// Writes the text to a file that is not there yet.
/// @throws std::runtime_error "cannot write <file>: <reason>"
void write_new_case(const std::filesystem::path& file, const std::string& text);

}  // namespace springfold::io
