#include "springfold/io/import_mesh.hpp"

#include <algorithm>
#include <stdexcept>

#include "atomic_file.hpp"
#include "mesh_parts.hpp"
#include "source_files.hpp"
#include "springfold/io/case_file.hpp"
#include "text.hpp"
#include "toml_text.hpp"

namespace springfold::io {
namespace {

/// A case, table by table.
class CaseText {
 public:
  CaseText(const Mesh& mesh, const MeshParts& parts, const std::string& name)
      : mesh_{mesh},
        parts_{parts},
        dimension_{mesh.is_planar && parts.folds.empty() ? std::size_t{2} : std::size_t{3}} {
    text_ =
        "# Made by `springfold import`: bars along the edges of a mesh, folds between its faces.\n";
    text_ += "title = " + toml_text(name) + "\n\n";
    if (!mesh.length_unit.empty())
      text_ += "[units]\nlength = " + toml_text(mesh.length_unit) + "\n\n";
  }

  std::string write() {
    write_parameters();
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i)
      if (parts_.is_used[i]) write_node(i);
    for (const auto& bar : parts_.bars)
      text_ += "[[bar]]\nfrom = \"" + name(bar[0]) + "\"\nto = \"" + name(bar[1]) +
               "\"\nEA = \"EA\"\n\n";
    for (const MeshFold& fold : parts_.folds) write_fold(fold);
    text_ += "[[study]]\nname = \"rest\"\nkind = \"equilibrium\"\nbody = \"" + moving() + "\"\n";
    return std::move(text_);
  }

 private:
  std::string name(std::size_t vertex) const { return vertex_name(mesh_, vertex); }

  void write_parameters() {
    const auto has = [this](bool cut) {
      return std::any_of(parts_.folds.begin(), parts_.folds.end(),
                         [cut](const MeshFold& fold) { return fold.is_cut == cut; });
    };
    text_ +=
        "[parameters]\nEA = { value = 1000, unit = \"N\", description = \"axial stiffness of "
        "the bars\" }\n";
    if (has(false))
      text_ +=
          "k_fold = { value = 1, unit = \"N/rad\", description = \"stiffness of the folds per "
          "length\" }\n";
    if (has(true))
      text_ +=
          "k_face = { value = 10, unit = \"N/rad\", description = \"bending stiffness of the "
          "faces per length\" }\n";
    text_ += "\n";
  }

  void write_node(std::size_t i) {
    text_ += "[[node]]\nname = \"" + name(i) + "\"\nat = [";
    for (std::size_t k = 0; k < dimension_; ++k)
      text_ += (k > 0 ? ", " : "") + shortest(mesh_.vertices[i][static_cast<Index>(k)]);
    text_ += "]\n";
    for (const MeshSupport& support : parts_.supports)
      if (support.vertex == i) text_ += "fixed = [" + axes_of(support) + "]\n";
    text_ += "\n";
  }

  std::string axes_of(const MeshSupport& support) const {
    std::string axes;
    for (std::size_t k = 0; k < dimension_; ++k)
      if (support.held[k]) axes += std::string{axes.empty() ? "" : ", "} + "\"" + "xyz"[k] + "\"";
    return axes;
  }

  void write_fold(const MeshFold& fold) {
    text_ += "[[spring]]\nname = \"fold-" + name(fold.points[1]) + "-" + name(fold.points[2]) +
             "\"\nshape = \"fold\"\nof = [";
    for (std::size_t k = 0; k < 4; ++k)
      text_ += (k > 0 ? ", \"" : "\"") + name(fold.points[k]) + "\"";
    text_ += std::string{"]\nstiffness = \""} + (fold.is_cut ? "k_face" : "k_fold") + "*" +
             shortest(fold.length) + "\"\nfree = " + shortest(fold.angle) + "\n\n";
  }

  /// The first node that is not held at all, or the last one that is not held wholly.
  std::string moving() const {
    const auto is_held = [this](std::size_t i) {
      return std::any_of(parts_.supports.begin(), parts_.supports.end(),
                         [i](const MeshSupport& support) { return support.vertex == i; });
    };
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i)
      if (parts_.is_used[i] && !is_held(i)) return name(i);
    return name(parts_.supports.back().vertex);
  }

  const Mesh& mesh_;
  const MeshParts& parts_;
  std::size_t dimension_;
  std::string text_{};
};

std::string lowered_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

std::vector<std::string> import_report(const Mesh& mesh, const MeshParts& parts) {
  const auto counted = [](std::size_t count, const std::string& one, const std::string& more) {
    return std::to_string(count) + " " + (count == 1 ? one : more);
  };
  const auto nodes =
      static_cast<std::size_t>(std::count(parts.is_used.begin(), parts.is_used.end(), true));
  std::vector<std::string> report{counted(mesh.vertices.size(), "vertex", "vertices") + ", " +
                                  counted(parts.bars.size() - parts.cuts, "edge", "edges") + ", " +
                                  counted(mesh.faces.size(), "face", "faces") + ": " +
                                  counted(nodes, "node", "nodes") + ", " +
                                  counted(parts.bars.size(), "bar", "bars") + ", " +
                                  counted(parts.folds.size(), "fold", "folds")};
  if (parts.cuts > 0)
    report.push_back(counted(parts.cuts, "bar is a cut", "bars are cuts") +
                     " of faces of more than three corners");
  std::string held;
  for (const MeshSupport& support : parts.supports)
    held += (held.empty() ? "" : ", ") + vertex_name(mesh, support.vertex);
  report.push_back("held so that the whole cannot move, each motion once: " + held +
                   "; put supports where they belong");
  report.push_back("stiffnesses are placeholders: put in your own, and loads");
  report.insert(report.end(), parts.report.begin(), parts.report.end());
  std::string others;
  for (const std::string& word : mesh.left_out)
    if (word == "edges_foldAngle")
      report.emplace_back(
          "left out: the angles of edges_foldAngle; folds rest as drawn, put other angles into "
          "`free`");
    else
      others += (others.empty() ? "" : ", ") + word;
  if (!others.empty()) report.push_back("left out, having no meaning here: " + others);
  return report;
}

}  // namespace

ImportedCase import_mesh(const std::filesystem::path& file,
                         const std::function<bool()>& stop_requested) {
  Problems problems;
  const std::string extension = lowered_extension(file);
  const bool is_fold = extension == ".fold";
  if (!is_fold && extension != ".obj")
    problems.add(
        {file.string(), 0, 0}, "",
        "got a file that ends in \"" + extension + "\", need \".obj\", \".fold\" or \".urdf\"");
  const auto throw_problems = [&problems] {
    if (!problems.empty()) throw CaseError(problems.messages());
  };
  throw_problems();
  const auto bytes = SourceReader{problems, stop_requested}.read_text(file, {}, "");
  throw_problems();
  const Mesh mesh = is_fold ? read_fold(*bytes, file.string(), problems)
                            : read_obj(*bytes, file.string(), problems);
  throw_problems();
  if (mesh.edges.empty() && mesh.faces.empty())
    problems.add({file.string(), 0, 0}, "", "there are no edges and no faces, need some");
  check_mesh(mesh, problems);
  throw_problems();
  const MeshParts parts = parts_of(mesh, problems);
  throw_problems();
  return {CaseText{mesh, parts, file.stem().string()}.write(), import_report(mesh, parts)};
}

void write_new_case(const std::filesystem::path& file, const std::string& text) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
    throw std::runtime_error("cannot write " + file.string() + ": it is there already");
  write_file(file, text);
}

}  // namespace springfold::io
