// The text of a case from a mesh.
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh.hpp"
#include "springfold/io/shown_text.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

/// Directions of a node that a support holds.
using Held = std::array<bool, 3>;

/// A text as TOML wants it.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return result + "\"";
}

/// What may stand in a comment: one line.
std::string in_comment(const std::string& text) {
  std::string result = text;
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return result;
}

Eigen::Index largest_of(const Eigen::Vector3d& v) {
  Eigen::Index at = 0;
  v.cwiseAbs().maxCoeff(&at);
  return at;
}

class Writer {
 public:
  Writer(const Mesh& mesh, const std::vector<Fold>& folds) : mesh_{mesh}, folds_{folds} {
    flat_ = folds.empty() && std::all_of(mesh.points.begin(), mesh.points.end(),
                                         [](const auto& p) { return p.z() == 0; });
    used_.assign(mesh.points.size(), false);
    for (const MeshEdge& edge : mesh.edges) used_[edge.a] = used_[edge.b] = true;
    held_.assign(mesh.points.size(), Held{});
    find_supports();
  }

  std::string text(const std::string& from) {
    out_ = "# Imported from " + in_comment(from) + " by springfold import.\n";
    out_ += "title = " + quoted(mesh_.title.empty() ? from : mesh_.title) + "\n\n[parameters]\n";
    out_ += "EA = 1                      # axial stiffness of all bars [force]\n";
    if (has(true)) out_ += "crease = 0.01               # stiffness of creases, per length of them\n";
    if (has(false)) out_ += "facet = 0.1                 # bending stiffness of facets, per length\n";
    add_nodes();
    add_bars();
    add_folds();
    out_ += "\n[[study]]\nname = \"rest\"\nkind = \"equilibrium\"\nbody = \"" + free_node() + "\"\n";
    add_report();
    return out_;
  }

 private:
  bool has(bool creases) const {
    return std::any_of(folds_.begin(), folds_.end(),
                       [creases](const Fold& f) { return f.is_crease == creases; });
  }

  std::string name(std::size_t point) const {
    return "v" + std::to_string(point + mesh_.first_number);
  }

  bool is_fixed(std::size_t point) const {
    return held_[point][0] && held_[point][1] && (flat_ || held_[point][2]);
  }

  std::string free_node() const {
    for (std::size_t i = mesh_.points.size(); i-- > 0;)
      if (used_[i] && held_[i] == Held{}) return name(i);
    for (std::size_t i = mesh_.points.size(); i-- > 0;)
      if (used_[i] && !is_fixed(i)) return name(i);
    return name(0);
  }

  /// The corners of the first face, or the first points that do not lie on a line.
  std::vector<std::size_t> supports() const {
    std::vector<std::size_t> points;
    if (!mesh_.faces.empty()) points = mesh_.faces.front();
    for (std::size_t i = 0; mesh_.faces.empty() && i < mesh_.points.size(); ++i)
      if (used_[i]) points.push_back(i);
    return points;
  }

  /// The first point wholly, the second across the way from the first, the third across the plane of all three.
  void find_supports() {
    constexpr double straight = 1e-6;
    const std::vector<std::size_t> points = supports();
    if (points.size() < 2) return;
    held_[points[0]] = {true, true, true};
    const Eigen::Vector3d way = mesh_.points[points[1]] - mesh_.points[points[0]];
    Held& second = held_[points[1]];
    second = {true, true, !flat_};
    second[static_cast<std::size_t>(largest_of(way))] = false;
    for (std::size_t k = 2; k < points.size() && !flat_; ++k) {
      const Eigen::Vector3d other = mesh_.points[points[k]] - mesh_.points[points[0]];
      const Eigen::Vector3d normal = way.cross(other);
      if (!(normal.norm() > straight * way.norm() * other.norm())) continue;
      held_[points[k]][static_cast<std::size_t>(largest_of(normal))] = true;
      return;
    }
  }

  void add_nodes() {
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      if (!used_[i]) continue;
      const Eigen::Vector3d& p = mesh_.points[i];
      out_ += "\n[[node]]\nname = \"" + name(i) + "\"\nat = [" + shortest(p.x()) + ", " +
              shortest(p.y()) + (flat_ ? "" : ", " + shortest(p.z())) + "]\n";
      std::string fixed;
      for (std::size_t k = 0; k < 3; ++k)
        if (held_[i][k] && !(flat_ && k == 2))
          fixed += (fixed.empty() ? "\"" : ", \"") + std::string(1, "xyz"[k]) + "\"";
      if (is_fixed(i))
        out_ += "fixed = true\n";
      else if (!fixed.empty())
        out_ += "fixed = [" + fixed + "]\n";
    }
  }

  void add_bars() {
    for (const MeshEdge& edge : mesh_.edges)
      if (!is_fixed(edge.a) || !is_fixed(edge.b))
        out_ += "\n[[bar]]\nfrom = \"" + name(edge.a) + "\"\nto = \"" + name(edge.b) +
                "\"\nEA = \"EA\"\n";
  }

  void add_folds() {
    for (const Fold& fold : folds_) {
      const std::array points{fold.before, fold.a, fold.b, fold.behind};
      if (std::all_of(points.begin(), points.end(), [this](auto p) { return is_fixed(p); })) continue;
      std::string of;
      for (const std::size_t p : points) of += (of.empty() ? "\"" : ", \"") + name(p) + "\"";
      out_ += std::string{"\n[[spring]]\nname = \""} + (fold.is_crease ? "crease" : "facet") + "-" +
              name(fold.a) + "-" + name(fold.b) + "\"\nshape = \"fold\"\nof = [" + of +
              "]\nstiffness = \"" + (fold.is_crease ? "crease" : "facet") + "*" +
              shortest((mesh_.points[fold.b] - mesh_.points[fold.a]).norm()) +
              "\"\norigin = \"drawn\"\n";
    }
  }

  void add_report() {
    std::vector<std::string> remarks = mesh_.left_out;
    const auto unused = std::count(used_.begin(), used_.end(), false);
    if (unused > 0) remarks.push_back(std::to_string(unused) + " points without edges");
    out_ += "\n# The supports are not those of the file, which has none: they hold the whole, and no more.\n";
    out_ += "# All springs are relaxed as drawn; EA" + std::string(has(true) ? ", crease" : "") +
            (has(false) ? ", facet" : "") + " are made up: choose them.\n";
    for (const std::string& remark : remarks) out_ += "# Left out: " + in_comment(remark) + "\n";
  }

  const Mesh& mesh_;
  const std::vector<Fold>& folds_;
  bool flat_ = false;
  std::vector<bool> used_{};
  std::vector<Held> held_{};
  std::string out_{};
};

}  // namespace

std::string case_text(const Mesh& mesh, const std::vector<Fold>& folds, const std::string& from) {
  return Writer{mesh, folds}.text(from);
}

}  // namespace springfold::io
