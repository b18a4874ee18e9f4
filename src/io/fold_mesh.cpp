// FOLD, the JSON format of origami.
#include <algorithm>
#include <cmath>

#include "json_reader.hpp"
#include "mesh.hpp"

namespace springfold::io {
namespace {

struct Assignment {
  const char* text;
  Crease crease;
};
constexpr Assignment assignments[]{{"M", Crease::fold}, {"V", Crease::fold}, {"U", Crease::fold},
                                   {"F", Crease::flat}, {"J", Crease::flat}, {"B", Crease::border},
                                   {"C", Crease::cut}};

/// Units of length that the format has; "unit" is none.
const std::vector<std::string> fold_units{"in", "pt", "m", "cm", "mm", "um", "nm"};

class FoldReader {
 public:
  FoldReader(const Node& root, Problems& problems) : root_{root}, problems_{problems} {}

  Mesh read() {
    read_vertices();
    if (is_full_) return std::move(mesh_);
    read_edges();
    read_assignments();
    for (const Node* face : list("faces_vertices", false))
      mesh_.faces.push_back({numbers(*face, "faces_vertices", 3, 0), face->place, key_});
    const bool knows_unit = read_unit();
    for (const NodeEntry& entry : root_.entries) {
      static const std::vector<std::string> known{"file_spec", "vertices_coords", "edges_vertices",
                                                  "edges_assignment", "faces_vertices"};
      const bool is_read = entry.key == "frame_unit"
                               ? knows_unit
                               : std::find(known.begin(), known.end(), entry.key) != known.end();
      if (!is_read) mesh_.left_out.push_back(entry.key);
    }
    return std::move(mesh_);
  }

 private:
  void refuse(const Node& node, const std::string& key, const std::string& need) {
    problems_.add(node.place, key, "got " + described(node) + ", need " + need);
  }

  /// Entries of a list; sets key_ for each as it is taken from the result with numbers().
  std::vector<const Node*> list(const std::string& name, bool needed) {
    at_ = 0;
    const Node* node = root_.find(name);
    std::vector<const Node*> items;
    if (node == nullptr && needed)
      problems_.add(root_.place, name, "missing, need a list");
    else if (node != nullptr && node->kind != Node::Kind::array)
      refuse(*node, name, "a list");
    else if (node != nullptr)
      for (const Node& item : node->items) items.push_back(&item);
    return items;
  }

  /// A list of numbers of vertices. @param most  0: any number
  std::vector<std::size_t> numbers(const Node& node, const std::string& name, std::size_t fewest,
                                   std::size_t most) {
    key_ = name + "[" + std::to_string(++at_) + "]";
    std::vector<std::size_t> found;
    const std::size_t size = node.items.size();
    if (node.kind != Node::Kind::array || size < fewest || (most > 0 && size > most)) {
      refuse(node, key_,
             "a list of " + std::string{most > 0 ? "" : "at least "} + std::to_string(fewest) +
                 " numbers of vertices");
      return {};
    }
    const std::size_t count = mesh_.vertices.size();
    for (const Node& item : node.items)
      if (item.kind == Node::Kind::number && item.number >= 0 &&
          item.number < static_cast<double>(count) && item.number == std::floor(item.number))
        found.push_back(static_cast<std::size_t>(item.number));
      else
        refuse(item, key_,
               count == 0 ? "vertices in vertices_coords"
                          : "the number of a vertex, 0 to " + std::to_string(count - 1));
    return found.size() == size ? found : std::vector<std::size_t>{};
  }

  void read_vertices() {
    mesh_.is_planar = true;
    for (const Node* node : list("vertices_coords", true)) {
      const std::string key = "vertices_coords[" + std::to_string(++at_) + "]";
      is_full_ = at_ > most_vertices;
      if (is_full_)
        return refuse(*node, key, "at most " + std::to_string(most_vertices) + " vertices");
      const std::size_t size = node->items.size();
      if (node->kind != Node::Kind::array || (size != 2 && size != 3))
        refuse(*node, key, "[x, y] or [x, y, z]");
      model::Vec3<double> at = model::Vec3<double>::Zero();
      for (std::size_t i = 0; i < std::min<std::size_t>(size, 3); ++i) {
        const Node& item = node->items[i];
        if (item.kind != Node::Kind::number || !(std::abs(item.number) <= largest_coordinate))
          refuse(item, key, coordinate_need);
        at[static_cast<Index>(i)] = item.number;
      }
      mesh_.is_planar = mesh_.is_planar && size == 2;
      mesh_.vertices.push_back(at);
    }
  }

  /// @returns whether it is one of the format
  bool read_unit() {
    const Node* unit = root_.find("frame_unit");
    if (unit == nullptr || unit->kind != Node::Kind::text) return false;
    if (std::find(fold_units.begin(), fold_units.end(), unit->text) == fold_units.end())
      return unit->text == "unit";
    mesh_.length_unit = unit->text;
    return true;
  }

  void read_edges() {
    mesh_.names_edges = root_.find("edges_vertices") != nullptr;
    for (const Node* edge : list("edges_vertices", false)) {
      const std::vector<std::size_t> ends = numbers(*edge, "edges_vertices", 2, 2);
      mesh_.edges.push_back({{}, Crease::fold, edge->place, key_});
      if (ends.size() == 2) mesh_.edges.back().ends = {ends[0], ends[1]};
    }
  }

  void read_assignments() {
    const Node* all = root_.find("edges_assignment");
    const std::vector<const Node*> words = list("edges_assignment", false);
    if (all != nullptr && words.size() != mesh_.edges.size() && all->kind == Node::Kind::array)
      return refuse(
          *all, "edges_assignment",
          "one for each of the " + std::to_string(mesh_.edges.size()) + " edges of edges_vertices");
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto known = std::find_if(
          std::begin(assignments), std::end(assignments), [&](const Assignment& assignment) {
            return words[i]->kind == Node::Kind::text && words[i]->text == assignment.text;
          });
      if (known == std::end(assignments))
        refuse(*words[i], "edges_assignment[" + std::to_string(i + 1) + "]",
               choices({"M", "V", "F", "U", "B", "C", "J"}));
      else
        mesh_.edges[i].crease = known->crease;
    }
  }

  const Node& root_;
  Problems& problems_;
  Mesh mesh_{};
  bool is_full_ = false;  ///< there are too many vertices: nothing more is read
  std::size_t at_ = 0;    ///< in the list that is read
  std::string key_{};     ///< of its last entry
};

}  // namespace

Mesh read_fold(std::string_view bytes, const std::string& file, Problems& problems) {
  const auto root = read_json(bytes, file, problems);
  if (!root) return {};
  if (root->kind != Node::Kind::table) {
    problems.add(root->place, "",
                 "got " + described(*root) + ", need an object with vertices_coords");
    return {};
  }
  return FoldReader{*root, problems}.read();
}

}  // namespace springfold::io
