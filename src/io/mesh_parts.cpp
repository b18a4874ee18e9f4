#include "mesh_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "face_triangles.hpp"
#include "springfold/model/shape.hpp"

namespace springfold::io {
namespace {

using MeshPoint = model::Vec3<double>;
using VertexPair = std::array<std::size_t, 2>;

/// Twice a triangle's area over the square of its longest side: below it is a line to rounding.
constexpr double flattest_triangle = 1e-10;
/// Angle of two faces that lie on each other to rounding [rad].
constexpr double closed_angle = 1e-9;

VertexPair edge_between(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

double edge_length(const Mesh& mesh, const VertexPair& pair) {
  return (mesh.vertices[pair[1]] - mesh.vertices[pair[0]]).norm();
}

bool is_a_line(const Mesh& mesh, const MeshTriangle& t) {
  const MeshPoint a = mesh.vertices[t[1]] - mesh.vertices[t[0]];
  const MeshPoint b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
  const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
  return !(a.cross(b).norm() > flattest_triangle * longest * longest);
}

/// A triangle beside an edge: its third corner, and whether its corners run along the pair.
struct Neighbour {
  std::size_t tip = 0;
  bool runs_along = false;
};

class PartsMaker {
 public:
  PartsMaker(const Mesh& mesh, Problems& problems) : mesh_{mesh}, problems_{problems} {
    parts_.is_used.assign(mesh.vertices.size(), false);
  }

  MeshParts make() {
    for (const MeshEdge& edge : mesh_.edges) add_bar(edge.ends, edge.crease);
    for (const MeshFace& face : mesh_.faces) add_sides(face);
    const std::size_t edges = parts_.bars.size();
    for (const MeshFace& face : mesh_.faces) add_triangles(face);
    parts_.cuts = parts_.bars.size() - edges;
    for (std::size_t i = 0; i < parts_.bars.size(); ++i) add_fold(parts_.bars[i], i >= edges);
    tell();
    if (problems_.empty()) add_supports();
    return std::move(parts_);
  }

 private:
  void add_bar(const VertexPair& ends, Crease crease) {
    const VertexPair pair = edge_between(ends[0], ends[1]);
    if (!creases_.emplace(pair, crease).second) return;
    parts_.bars.push_back(pair);
    for (const std::size_t end : pair) parts_.is_used[end] = true;
  }

  void add_sides(const MeshFace& face) {
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      const VertexPair side =
          edge_between(face.corners[i], face.corners[(i + 1) % face.corners.size()]);
      if (mesh_.names_edges && !creases_.contains(side))
        problems_.add(face.place, face.key,
                      "its side from " + vertex_name(mesh_, side[0]) + " to " +
                          vertex_name(mesh_, side[1]) + " is no edge of edges_vertices, need one");
      add_bar(side, Crease::fold);
    }
  }

  void add_triangles(const MeshFace& face) {
    const std::vector<MeshTriangle> triangles = triangles_of(mesh_, face);
    if (triangles.empty() && face.corners.size() > 2)
      problems_.add(face.place, face.key, "its sides cross each other, need a face that does not");
    for (const MeshTriangle& t : triangles) {
      if (is_a_line(mesh_, t)) {
        problems_.add(face.place, face.key,
                      "the corners " + vertex_name(mesh_, t[0]) + ", " + vertex_name(mesh_, t[1]) +
                          ", " + vertex_name(mesh_, t[2]) +
                          " lie on one line, need triangles with an area");
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = t[i], b = t[(i + 1) % 3];
        add_bar({a, b}, Crease::flat);
        neighbours_[edge_between(a, b)].push_back({t[(i + 2) % 3], a < b});
      }
    }
  }

  void add_fold(const VertexPair& edge, bool is_cut) {
    const Crease crease = creases_.at(edge);
    const auto found = neighbours_.find(edge);
    if (found == neighbours_.end() || found->second.size() < 2) return;
    std::vector<Neighbour> sides = found->second;
    if (sides.size() > 2) {
      crowded_.push_back(edge);
      return;
    }
    if (sides[0].tip == sides[1].tip) {
      closed_.push_back(edge);
      return;
    }
    if (crease == Crease::cut || crease == Crease::border) {
      ++loose_;
      return;
    }
    if (!sides[0].runs_along && sides[1].runs_along) std::swap(sides[0], sides[1]);
    MeshFold fold{.points = {sides[0].tip, edge[0], edge[1], sides[1].tip},
                  .is_cut = is_cut || crease == Crease::flat,
                  .length = edge_length(mesh_, edge)};
    fold.angle = angle_of(fold);
    if (fold.angle < closed_angle || fold.angle > 2 * std::numbers::pi - closed_angle)
      closed_.push_back(edge);
    else
      parts_.folds.push_back(fold);
  }

  double angle_of(const MeshFold& fold) const {
    Vector positions(12);
    for (std::size_t i = 0; i < 4; ++i)
      positions.segment<3>(3 * static_cast<Index>(i)) = mesh_.vertices[fold.points[i]];
    model::ShapeValue<double> at;
    model::evaluate_shape<double>({.kind = model::ShapeKind::dihedral, .near = std::numbers::pi},
                                  positions, at);
    return at.value;
  }

  void say_of(const std::vector<VertexPair>& edges, const std::string& why) {
    if (edges.empty()) return;
    parts_.report.push_back(
        "left out: the fold over the edge from " + vertex_name(mesh_, edges.front()[0]) + " to " +
        vertex_name(mesh_, edges.front()[1]) +
        (edges.size() > 1 ? " and " + std::to_string(edges.size() - 1) + " more" : std::string{}) +
        ", " + why);
  }

  void tell() {
    say_of(crowded_, "which more than two faces share");
    say_of(closed_, "whose faces lie on each other");
    if (loose_ == 1)
      parts_.report.emplace_back("1 edge between two faces is a cut or border and has no fold");
    if (loose_ > 1)
      parts_.report.push_back(std::to_string(loose_) +
                              " edges between two faces are cuts or borders and have no fold");
    say_twins();
    say_pieces();
    const auto unused = std::count(parts_.is_used.begin(), parts_.is_used.end(), false);
    if (unused > 0)
      parts_.report.push_back("left out: " + std::to_string(unused) +
                              (unused == 1 ? " vertex" : " vertices") + " without an edge");
  }

  /// Vertices at one place are no joint: what hangs on one of them does not hang on the other.
  void say_twins() {
    std::map<std::array<double, 3>, std::size_t> places;
    std::size_t count = 0, first = 0, second = 0;
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
      const MeshPoint& p = mesh_.vertices[i];
      const auto [known, is_new] = places.emplace(std::array{p[0], p[1], p[2]}, i);
      if (is_new || !parts_.is_used[i]) continue;
      if (count++ == 0) first = known->second, second = i;
    }
    if (count == 0) return;
    parts_.report.push_back(
        "not joined: " + vertex_name(mesh_, first) + " and " + vertex_name(mesh_, second) +
        " are at one place" +
        (count > 1 ? ", and so are " + std::to_string(count - 1) + " more" : ""));
  }

  /// What no edge joins moves apart.
  void say_pieces() {
    std::vector<std::size_t> next(mesh_.vertices.size());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = i;
    const auto root = [&next](std::size_t i) {
      while (next[i] != i) i = next[i] = next[next[i]];
      return i;
    };
    for (const VertexPair& bar : parts_.bars) next[root(bar[0])] = root(bar[1]);
    std::set<std::size_t> roots;
    for (std::size_t i = 0; i < next.size(); ++i)
      if (parts_.is_used[i]) roots.insert(root(i));
    if (roots.size() > 1)
      parts_.report.push_back(
          "the mesh has " + std::to_string(roots.size()) +
          " separate parts: the supports hold one of them, need more for the others");
  }

  /// The used vertex for which `size` is largest; the first of equal ones.
  template <class Size>
  std::size_t farthest(const Size& size) const {
    std::size_t best = 0;
    double largest = -1;
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
      if (!parts_.is_used[i]) continue;
      const double value = size(mesh_.vertices[i]);
      if (value > largest) {
        largest = value;
        best = i;
      }
    }
    return best;
  }

  /// Three, two and one directions at three vertices, in the plane two and one at two.
  void add_supports() {
    const std::size_t a = farthest([](const MeshPoint&) { return 0.0; });
    const MeshPoint origin = mesh_.vertices[a];
    parts_.supports.push_back({a, {true, true, true}});
    const std::size_t b = farthest([&](const MeshPoint& p) { return (p - origin).norm(); });
    const MeshPoint along = mesh_.vertices[b] - origin;
    Index axis = 0;
    along.cwiseAbs().maxCoeff(&axis);
    MeshSupport second{b, {true, true, true}};
    second.held[static_cast<std::size_t>(axis)] = false;
    parts_.supports.push_back(second);
    if (is_planar()) return;
    const auto lever = [&](const MeshPoint& p) { return MeshPoint(along.cross(p - origin)); };
    const std::size_t c = farthest([&](const MeshPoint& p) { return lever(p).norm(); });
    if (!(lever(mesh_.vertices[c]).norm() > flattest_triangle * along.squaredNorm())) return;
    MeshSupport third{c, {}};
    lever(mesh_.vertices[c]).cwiseAbs().maxCoeff(&axis);
    third.held[static_cast<std::size_t>(axis)] = true;
    parts_.supports.push_back(third);
  }

  bool is_planar() const { return mesh_.is_planar && parts_.folds.empty(); }

  const Mesh& mesh_;
  Problems& problems_;
  MeshParts parts_{};
  std::map<VertexPair, Crease> creases_{};
  std::map<VertexPair, std::vector<Neighbour>> neighbours_{};
  std::vector<VertexPair> crowded_{}, closed_{};
  std::size_t loose_ = 0;
};

}  // namespace

std::string vertex_name(const Mesh& mesh, std::size_t vertex) {
  return "v" + std::to_string(vertex + mesh.first_number);
}

void check_mesh(const Mesh& mesh, Problems& problems) {
  std::set<VertexPair> seen;
  for (const MeshEdge& edge : mesh.edges) {
    const std::string ends =
        vertex_name(mesh, edge.ends[0]) + " to " + vertex_name(mesh, edge.ends[1]);
    if (edge_length(mesh, edge.ends) == 0)
      problems.add(edge.place, edge.key, "the edge from " + ends + " has no length, need one");
    else if (!seen.insert(edge_between(edge.ends[0], edge.ends[1])).second && mesh.names_edges)
      problems.add(edge.place, edge.key, "the edge from " + ends + " stands twice, need it once");
  }
  for (const MeshFace& face : mesh.faces) {
    const std::set<std::size_t> different(face.corners.begin(), face.corners.end());
    if (different.size() != face.corners.size())
      problems.add(face.place, face.key, "a corner stands twice, need different ones");
  }
}

MeshParts parts_of(const Mesh& mesh, Problems& problems) {
  return PartsMaker{mesh, problems}.make();
}

}  // namespace springfold::io
