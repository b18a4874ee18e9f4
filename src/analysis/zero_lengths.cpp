#include "zero_lengths.hpp"

#include <algorithm>

#include "springfold/statics/shapes.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using Vec3 = model::Vec3<double>;

/// Sine of the angle below which two vectors lie on one line: far above the rounding of positions, far below the turn of a
/// spring that a step leads past its other end.
constexpr double on_one_line = 1e-9;

using statics::PointShape;

/// Of a shape: how many vectors turn round where its force does.
std::size_t ways_of(const PointShape& shape) {
  switch (shape.shape.kind) {
    case model::ShapeKind::path:
      return shape.shape.closed ? shape.points.size() : shape.points.size() - 1;
    case model::ShapeKind::line:
    case model::ShapeKind::angle:
      return shape.shape.in_plane ? 0 : 1;
    default:
      return 0;
  }
}

/// From point to point of a path; in space across a line to the point, and across both sides of an angle.
Vec3 vector_of(const PointShape& shape, const std::vector<Vec3>& p, std::size_t way) {
  switch (shape.shape.kind) {
    case model::ShapeKind::line: {
      const Vec3 line = (p[2] - p[1]).normalized(), d = p[0] - p[1];
      return d - d.dot(line) * line;
    }
    case model::ShapeKind::angle:
      return model::cross<double>(p[0] - p[1], p[2] - p[1]);
    default:
      return p[(way + 1) % p.size()] - p[way];
  }
}

/// What comes to nothing there.
std::string edge_words(const PointShape& shape) {
  switch (shape.shape.kind) {
    case model::ShapeKind::line:
      return "the distance 0";
    case model::ShapeKind::angle:
      return "the angle 0 or pi";
    default:
      return "the length 0";
  }
}

/// The spring that vector `i` belongs to, in the order of spring_vectors(), and what comes to nothing.
std::string words_of_vector(const statics::System& system, std::size_t i) {
  const std::string led = " would be led through ", where = ", where its force has no direction";
  for (std::size_t k = 0; k < system.line_springs.size(); ++k)
    if (system.line_springs[k].free != 0 && i-- == 0)
      return system.mechanism.line_springs[k].name + led + "the length 0" + where;
  std::size_t shape = 0;
  for (; i >= ways_of(system.shapes[shape]); ++shape) i -= ways_of(system.shapes[shape]);
  return system.shapes[shape].name + led + edge_words(system.shapes[shape]) + where;
}

std::vector<Vec3> vectors_at(const PathProblem& problem, const CurvePoint& point) {
  Vector z;
  statics::Inputs inputs;
  problem.put_expanded(point.x, point.lambda, nullptr, z);
  problem.put_inputs(point.lambda, inputs);
  return spring_vectors(problem.system(point.lambda), z, inputs);
}

void cut(Curve& curve, std::size_t points) {
  curve.points.resize(points);
  const double end = curve.points.back().s;
  std::erase_if(curve.hits, [end](const auto& hit) { return hit.point.s > end; });
  std::erase_if(curve.arcs, [end](const auto& arc) { return arc.s_end > end; });
}

}  // namespace

std::vector<Vec3> spring_vectors(const statics::System& system, const Vector& z,
                                 const statics::Inputs& inputs) {
  std::vector<Vec3> vectors;
  const auto add = [&](std::size_t from, std::size_t to) {
    vectors.push_back(position_of(system, to, z, inputs.rho) -
                      position_of(system, from, z, inputs.rho));
  };
  for (const statics::PointSpring& spring : system.line_springs)
    if (spring.free != 0) add(spring.from, spring.to);
  for (std::size_t i = 0; i < system.shapes.size(); ++i) {
    const PointShape& shape = system.shapes[i];
    const std::size_t ways = ways_of(shape);
    if (ways == 0) continue;
    // A slack cable pulls nowhere, and what has no force there passes smoothly: their vectors are compared with none.
    const statics::ShapeState state = statics::shape_state(system, i, z, inputs);
    const bool counts = state.slope != 0 && !is_smooth_at_edge(shape, state.value);
    std::vector<Vec3> p;
    for (const std::size_t point : shape.points)
      p.push_back(position_of(system, point, z, inputs.rho));
    for (std::size_t k = 0; k < ways; ++k)
      vectors.push_back(counts ? vector_of(shape, p, k) : Vec3(Vec3::Zero()));
  }
  return vectors;
}

std::optional<std::string> led_through_zero(const statics::System& system,
                                            const std::vector<Vec3>& before,
                                            const std::vector<Vec3>& after) {
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
    const Vec3 &a = before[i], &b = after[i];
    const double sizes = a.norm() * b.norm();
    if (sizes > 0 && a.dot(b) < 0 && model::cross<double>(a, b).norm() <= on_one_line * sizes)
      return words_of_vector(system, i);
  }
  return std::nullopt;
}

std::optional<Stop> end_at_zero_length(const PathProblem& problem, Curve& curve) {
  if (curve.points.empty()) return std::nullopt;
  std::vector<Vec3> before = vectors_at(problem, curve.points.front());
  for (std::size_t i = 1; i < curve.points.size() && !before.empty(); ++i) {
    std::vector<Vec3> after = vectors_at(problem, curve.points[i]);
    if (auto reason = led_through_zero(problem.system(curve.points[i].lambda), before, after)) {
      cut(curve, i);
      return Stop{std::move(*reason), false};
    }
    before = std::move(after);
  }
  return std::nullopt;
}

void end_at_zero_lengths(const Tracing& tracing, BranchSource& source) {
  if (auto end = end_at_zero_length(tracing.problem, source.forward)) source.forward_stop = *end;
  if (auto end = end_at_zero_length(tracing.problem, source.backward)) source.backward_stop = *end;
}

}  // namespace springfold::analysis
