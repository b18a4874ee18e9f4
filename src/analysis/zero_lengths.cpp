#include "zero_lengths.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "springfold/core/number_text.hpp"
#include "springfold/statics/shapes.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using Vec3 = model::Vec3<double>;

/// Sine of the angle below which two vectors lie on one line: far above the rounding of positions, far below the turn
/// of a spring that a step leads past its other end.
constexpr double on_one_line = 1e-9;

/// Lengths and forces, of mechanisms without dimensions, that rounding makes of none.
constexpr double rounded_length = 1e-9;

using statics::PointShape;

/// A vector that turns round where a shape is led over an edge, and the words for that place.
struct Way {
  Vec3 vector = Vec3::Zero();
  const char* place = "the length 0, where its force has no direction";
};

/// From point to point of a path; in space across a line to the point; the sides of an angle and in space across both;
/// of a fold from the edge to both points. As many at every state.
std::vector<Way> ways_of(const PointShape& shape, const std::vector<Vec3>& p) {
  constexpr const char* vertex = "its vertex, where the angle is not defined";
  constexpr const char* edge = "its edge, where the angle is not defined";
  constexpr const char* stretched = "the angle 0 or pi, where its force has no direction";
  const auto across = [&](const Vec3& d) {
    const Vec3 line = (p[2] - p[1]).normalized();
    return Vec3(d - d.dot(line) * line);
  };
  switch (shape.shape.kind) {
    case model::ShapeKind::path: {
      std::vector<Way> ways;
      for (std::size_t i = 0; i + 1 < p.size(); ++i) ways.push_back({p[i + 1] - p[i]});
      if (shape.shape.closed) ways.push_back({p.front() - p.back()});
      return ways;
    }
    case model::ShapeKind::line:
      if (shape.shape.in_plane) return {};
      return {{across(p[0] - p[1]), "the distance 0, where its force has no direction"}};
    case model::ShapeKind::angle: {
      const Vec3 first = p[0] - p[1], last = p[2] - p[1];
      std::vector<Way> ways{{first, vertex}, {last, vertex}};
      if (!shape.shape.in_plane) ways.push_back({model::cross<double>(first, last), stretched});
      return ways;
    }
    case model::ShapeKind::dihedral:
      return {{across(p[0] - p[1]), edge}, {across(p[3] - p[1]), edge}};
    default:
      return {};
  }
}

/// The spring that vector `i` belongs to, in the order of spring_edges(), and what comes to nothing.
std::string words_of_vector(const statics::System& system, std::size_t i) {
  const std::string led = " would be led through ";
  for (std::size_t k = 0; k < system.line_springs.size(); ++k)
    if (system.line_springs[k].free != 0 && i-- == 0)
      return system.mechanism.line_springs[k].name + led + Way{}.place;
  for (const PointShape& shape : system.shapes) {
    const std::vector<Way> ways = ways_of(shape, std::vector<Vec3>(shape.points.size()));
    if (i < ways.size()) return shape.name + led + ways[i].place;
    i -= ways.size();
  }
  return {};
}

/// Does the force turn round at an edge? A slack cable pulls nowhere, and what has no force there passes smoothly.
/// @param least  forces up to this one are none
bool turns_at_edge(const PointShape& shape, const statics::ShapeState& state, double least) {
  return std::abs(state.slope) > least && !is_smooth_at_edge(shape, state.value);
}

/// What to do about an angle that is half a turn from `near`.
std::string half_turn_words(const PointShape& shape) {
  const std::string text = "half a turn from near = " + rounded(shape.shape.near);
  return shape.shape.kind == model::ShapeKind::angle
             ? text + "; give another `near`, or for nodes `turns = true`"
             : text + "; give another `near`";
}

SpringEdges edges_at(const PathProblem& problem, const CurvePoint& point) {
  Vector z;
  statics::Inputs inputs;
  problem.put_expanded(point.x, point.lambda, nullptr, z);
  problem.put_inputs(point.lambda, inputs);
  return spring_edges(problem.system(point.lambda), z, inputs);
}

/// The curve ends at a station of it, a point or a special point, and not at what it was to end at.
void end_at(const CurvePoint& station, Curve& curve) {
  const CurvePoint last = station;
  const double end = last.s;
  std::erase_if(curve.points, [end](const CurvePoint& point) { return point.s > end; });
  std::erase_if(curve.hits, [end](const auto& hit) { return hit.point.s > end; });
  std::erase_if(curve.arcs, [end](const auto& arc) { return arc.s_end > end; });
  if (curve.points.empty() || curve.points.back().s < end) curve.points.push_back(last);
  curve.stop = continuation::StopReason::observer;
  curve.stop_detail.clear();
}

}  // namespace

SpringEdges spring_edges(const statics::System& system, const Vector& z,
                         const statics::Inputs& inputs) {
  SpringEdges edges;
  const auto add = [&](std::size_t from, std::size_t to) {
    edges.vectors.push_back(position_of(system, to, z, inputs.rho) -
                            position_of(system, from, z, inputs.rho));
  };
  for (const statics::PointSpring& spring : system.line_springs)
    if (spring.free != 0) add(spring.from, spring.to);
  for (std::size_t i = 0; i < system.shapes.size(); ++i) {
    const PointShape& shape = system.shapes[i];
    const statics::ShapeState state = statics::shape_state(system, i, z, inputs);
    const bool counts = turns_at_edge(shape, state, 0);
    std::vector<Vec3> p;
    for (const std::size_t point : shape.points)
      p.push_back(position_of(system, point, z, inputs.rho));
    for (const Way& way : ways_of(shape, p))  // compared with none where nothing turns round
      edges.vectors.push_back(counts ? way.vector : Vec3(Vec3::Zero()));
    edges.angles.push_back(state.slope != 0 ? state.off_middle : 0);
  }
  return edges;
}

std::optional<std::string> without_direction(const statics::System& system, const Vector& z,
                                             const statics::Inputs& inputs) {
  const auto is_short = [&](std::size_t from, std::size_t to) {
    return (position_of(system, to, z, inputs.rho) - position_of(system, from, z, inputs.rho))
               .norm() <= rounded_length;
  };
  for (std::size_t k = 0; k < system.line_springs.size(); ++k) {
    const statics::PointSpring& spring = system.line_springs[k];
    if (std::abs(spring.free) > rounded_length && is_short(spring.from, spring.to))
      return system.mechanism.line_springs[k].name;
  }
  for (std::size_t i = 0; i < system.shapes.size(); ++i) {
    const PointShape& shape = system.shapes[i];
    const statics::ShapeState state = statics::shape_state(system, i, z, inputs);
    if (shape.shape.kind != model::ShapeKind::path || !turns_at_edge(shape, state, rounded_length))
      continue;
    for (std::size_t k = 0; k + 1 < shape.points.size(); ++k)
      if (is_short(shape.points[k], shape.points[k + 1])) return shape.name;
  }
  return std::nullopt;
}

bool stands_at_jump(const statics::System& system, const Vector& z, const statics::Inputs& inputs) {
  const std::vector<double> angles = spring_edges(system, z, inputs).angles;
  return std::ranges::any_of(
      angles, [](double angle) { return std::abs(angle) >= std::numbers::pi - rounded_length; });
}

std::optional<std::string> led_over_edge(const statics::System& system, const SpringEdges& before,
                                         const SpringEdges& after) {
  for (std::size_t i = 0; i < std::min(before.vectors.size(), after.vectors.size()); ++i) {
    const Vec3 &a = before.vectors[i], &b = after.vectors[i];
    const double sizes = a.norm() * b.norm();
    if (sizes > 0 && a.dot(b) < 0 && model::cross<double>(a, b).norm() <= on_one_line * sizes)
      return words_of_vector(system, i);
  }
  for (std::size_t i = 0; i < std::min(before.angles.size(), after.angles.size()); ++i)
    if (std::abs(after.angles[i] - before.angles[i]) > std::numbers::pi)
      return "the angle of " + system.shapes[i].name +
             " would jump by a whole turn: " + half_turn_words(system.shapes[i]);
  return std::nullopt;
}

std::optional<Stop> end_at_zero_length(const PathProblem& problem, Curve& curve) {
  if (curve.points.empty()) return std::nullopt;
  std::vector<const CurvePoint*> stations;
  for (const CurvePoint& point : curve.points) stations.push_back(&point);
  // In the last step, which an event cuts, no other points lie.
  for (const continuation::Hit& hit : curve.hits)
    if (hit.point.s > curve.points.back().s) stations.push_back(&hit.point);
  std::ranges::stable_sort(stations, {}, &CurvePoint::s);
  SpringEdges before = edges_at(problem, *stations.front());
  for (std::size_t i = 1; i < stations.size() && !before.is_empty(); ++i) {
    SpringEdges after = edges_at(problem, *stations[i]);
    if (auto reason = led_over_edge(problem.system(stations[i]->lambda), before, after)) {
      end_at(*stations[i - 1], curve);
      return Stop{std::move(*reason), false};
    }
    before = std::move(after);
  }
  return std::nullopt;
}

std::optional<std::string> angle_near_jump(const PathProblem& problem, const CurvePoint& end) {
  constexpr double beside = 1e-3;  // of half a turn
  const std::vector<double> angles = edges_at(problem, end).angles;
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (std::abs(angles[i]) > (1 - beside) * std::numbers::pi) {
      const PointShape& shape = problem.system(end.lambda).shapes[i];
      return "the angle of " + shape.name + " would jump by a whole turn here: it is " +
             half_turn_words(shape);
    }
  return std::nullopt;
}

void end_at_zero_lengths(const Tracing& tracing, BranchSource& source) {
  if (auto end = end_at_zero_length(tracing.problem, source.forward)) source.forward_stop = *end;
  if (auto end = end_at_zero_length(tracing.problem, source.backward)) source.backward_stop = *end;
}

}  // namespace springfold::analysis
