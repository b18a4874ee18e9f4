// FOLD 1.2 (Demaine, Ku, Lang: "A new file standard to represent folded structures", 2016).
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "mesh.hpp"

namespace springfold::io {
namespace {

using Json = nlohmann::json;

/// Keys that are read, or say nothing about the shape.
const std::set<std::string, std::less<>> known_keys{
    "file_spec",       "file_creator",     "file_author",       "file_title",
    "file_description", "file_classes",    "frame_title",       "frame_author",
    "frame_description", "frame_classes",  "frame_attributes",  "frame_unit",
    "vertices_coords", "vertices_vertices", "vertices_edges",   "vertices_faces",
    "edges_vertices",  "edges_faces",      "edges_assignment",  "edges_length",
    "faces_vertices",  "faces_edges",      "faces_faces",
};

class FoldReader {
 public:
  FoldReader(const std::string& shown_name, Problems& problems)
      : file_{shown_name}, problems_{problems} {}

  Mesh read(const std::string& bytes) {
    Json root;
    try {
      root = Json::parse(bytes);
    } catch (const Json::parse_error& error) {
      report_syntax(bytes, error.byte);
      return {};
    }
    if (!root.is_object()) {
      report("", "need a JSON object with vertices_coords, edges_vertices, faces_vertices");
      return {};
    }
    if (const auto title = root.find("file_title"); title != root.end() && title->is_string())
      mesh_.title = title->get<std::string>();
    read_points(root);
    read_edges(root);
    read_faces(root);
    for (const auto& [key, value] : root.items())
      if (!known_keys.contains(key))
        mesh_.left_out.push_back(key == "edges_foldAngle"
                                     ? "edges_foldAngle: creases rest at the angles that are drawn"
                                     : key);
    return std::move(mesh_);
  }

 private:
  void report(const std::string& key, const std::string& what) {
    problems_.add({file_, 0, 0}, key, what);
  }

  void report_syntax(const std::string& bytes, std::size_t byte) {
    const std::size_t at = std::min(byte > 0 ? byte - 1 : 0, bytes.size());
    int line = 1, column = 1;
    for (std::size_t i = 0; i < at; ++i) {
      column = bytes[i] == '\n' ? 1 : column + 1;
      line += bytes[i] == '\n';
    }
    problems_.add({file_, line, column}, "", "this is no JSON from here on");
  }

  /// The list under a key; null if there is none, which is reported where it is needed.
  const Json* list(const Json& root, const std::string& key, bool needed) {
    const auto found = root.find(key);
    if (found == root.end()) {
      if (needed) report(key, "missing, need a list");
      return nullptr;
    }
    if (found->is_array()) return &*found;
    report(key, "need a list");
    return nullptr;
  }

  static std::string entry(const std::string& key, std::size_t i) {
    return key + "[" + std::to_string(i) + "]";
  }

  void read_points(const Json& root) {
    const Json* coords = list(root, "vertices_coords", true);
    for (std::size_t i = 0; coords != nullptr && i < coords->size(); ++i) {
      const Json& at = (*coords)[i];
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      bool good = at.is_array() && (at.size() == 2 || at.size() == 3);
      for (std::size_t k = 0; good && k < at.size(); ++k) {
        good = at[k].is_number();
        if (good) p[static_cast<Index>(k)] = at[k].get<double>();
      }
      if (!good || !p.allFinite()) report(entry("vertices_coords", i), "need [x, y] or [x, y, z]");
      mesh_.points.push_back(p);
    }
  }

  /// Numbers of different points, counted from 0; empty if unusable.
  std::vector<std::size_t> corners(const Json& list, const std::string& key, std::size_t least) {
    std::vector<std::size_t> numbers;
    std::set<std::size_t> different;
    bool good = list.is_array();
    for (std::size_t k = 0; good && k < list.size(); ++k) {
      good = list[k].is_number_unsigned() && list[k].get<std::size_t>() < mesh_.points.size();
      if (!good) break;
      numbers.push_back(list[k].get<std::size_t>());
      different.insert(numbers.back());
    }
    if (good && different.size() == numbers.size() && numbers.size() >= least) return numbers;
    report(key, "need " + std::to_string(least) + (least == 2 ? "" : " or more") +
                    " different numbers of points, from 0 to " +
                    std::to_string(mesh_.points.empty() ? 0 : mesh_.points.size() - 1));
    return {};
  }

  void read_edges(const Json& root) {
    const Json* edges = list(root, "edges_vertices", false);
    const Json* assignments = list(root, "edges_assignment", false);
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (std::size_t i = 0; edges != nullptr && i < edges->size(); ++i) {
      const auto ends = corners((*edges)[i], entry("edges_vertices", i), 2);
      if (ends.size() != 2) continue;
      if (!seen.insert(std::minmax(ends[0], ends[1])).second) {
        report(entry("edges_vertices", i), "this edge is there twice");
        continue;
      }
      MeshEdge edge{ends[0], ends[1]};
      if (assignments != nullptr && i < assignments->size()) {
        const Json& word = (*assignments)[i];
        const std::string text = word.is_string() ? word.get<std::string>() : "";
        if (text.size() != 1 || std::string{"MVFBUCJ"}.find(text) == std::string::npos)
          report(entry("edges_assignment", i), "need \"M\", \"V\", \"F\", \"B\", \"U\", \"C\" or \"J\"");
        edge.can_fold = text != "B" && text != "C";
        edge.is_flat = text == "F" || text == "J";
      }
      mesh_.edges.push_back(edge);
    }
  }

  void read_faces(const Json& root) {
    const Json* faces = list(root, "faces_vertices", false);
    for (std::size_t i = 0; faces != nullptr && i < faces->size(); ++i)
      if (auto face = corners((*faces)[i], entry("faces_vertices", i), 3); !face.empty())
        mesh_.faces.push_back(std::move(face));
  }

  std::string file_;
  Problems& problems_;
  Mesh mesh_{};
};

}  // namespace

Mesh read_fold(const std::string& bytes, const std::string& shown_name, Problems& problems) {
  return FoldReader{shown_name, problems}.read(bytes);
}

}  // namespace springfold::io
