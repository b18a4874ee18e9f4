#include "zero_lengths.hpp"

#include <algorithm>
#include <string>
#include <vector>

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

/// Each spring that has force at the length 0, as the vectors between its points.
struct SpringVectors {
  std::vector<Vec3> vectors{};
  std::vector<std::string> names{};
};

SpringVectors vectors_at(const PathProblem& problem, const CurvePoint& point) {
  const statics::System& system = problem.system(point.lambda);
  Vector z;
  statics::Inputs inputs;
  problem.put_expanded(point.x, point.lambda, nullptr, z);
  problem.put_inputs(point.lambda, inputs);
  SpringVectors found;
  const auto add = [&](std::size_t from, std::size_t to, const std::string& name) {
    found.vectors.push_back(position_of(system, to, z, inputs.rho) -
                            position_of(system, from, z, inputs.rho));
    found.names.push_back(name);
  };
  for (std::size_t i = 0; i < system.line_springs.size(); ++i) {
    const statics::PointSpring& spring = system.line_springs[i];
    if (spring.free != 0) add(spring.from, spring.to, system.mechanism.line_springs[i].name);
  }
  for (std::size_t i = 0; i < system.shapes.size(); ++i) {
    const statics::PointShape& shape = system.shapes[i];
    if (shape.shape.kind != model::ShapeKind::path) continue;
    // A slack cable pulls nowhere: its vector is left out, and compared with none.
    const bool pulls = statics::shape_state(system, i, z, inputs).slope != 0;
    for (std::size_t k = 0; k + 1 < shape.points.size(); ++k) {
      add(shape.points[k], shape.points[k + 1], shape.name);
      if (!pulls) found.vectors.back().setZero();
    }
  }
  return found;
}

/// The first spring that is turned round between two points without being turned aside.
std::optional<std::string> reversed(const SpringVectors& before, const SpringVectors& after) {
  for (std::size_t i = 0; i < before.vectors.size(); ++i) {
    const Vec3 &a = before.vectors[i], &b = after.vectors[i];
    const double sizes = a.norm() * b.norm();
    if (sizes > 0 && a.dot(b) < 0 && model::cross<double>(a, b).norm() <= on_one_line * sizes)
      return before.names[i];
  }
  return std::nullopt;
}

void cut(Curve& curve, std::size_t points) {
  curve.points.resize(points);
  const double end = curve.points.back().s;
  std::erase_if(curve.hits, [end](const auto& hit) { return hit.point.s > end; });
  std::erase_if(curve.arcs, [end](const auto& arc) { return arc.s_end > end; });
}

void end_at_zero_length(const PathProblem& problem, Curve& curve, Stop& stop) {
  if (curve.points.empty()) return;
  SpringVectors before = vectors_at(problem, curve.points.front());
  for (std::size_t i = 1; i < curve.points.size() && !before.vectors.empty(); ++i) {
    SpringVectors after = vectors_at(problem, curve.points[i]);
    if (const auto name = reversed(before, after)) {
      cut(curve, i);
      stop = {*name + " would be led through the length 0, where its force has no direction",
              false};
      return;
    }
    before = std::move(after);
  }
}

}  // namespace

void end_at_zero_lengths(const Tracing& tracing, BranchSource& source) {
  end_at_zero_length(tracing.problem, source.forward, source.forward_stop);
  end_at_zero_length(tracing.problem, source.backward, source.backward_stop);
}

}  // namespace springfold::analysis
