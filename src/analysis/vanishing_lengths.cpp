#include "vanishing_lengths.hpp"

#include <algorithm>
#include <vector>

#include "springfold/core/number_text.hpp"
#include "springfold/statics/shapes.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;
using model::ShapeKind;
using statics::PointShape;
using EndPoint = model::Vec3<double>;

/// Lengths without which a spring's force has no direction, dimensionless, in the same order at every point.
class CriticalLengths {
 public:
  CriticalLengths(const PathProblem& problem, const CurvePoint& point)
      : system_{problem.system(point.lambda)} {
    problem.put_expanded(point.x, point.lambda, nullptr, z_);
    problem.put_inputs(point.lambda, inputs_);
    for (std::size_t i = 0; i < system_.line_springs.size(); ++i) {
      const statics::PointSpring& spring = system_.line_springs[i];
      if (spring.free != 0)  // otherwise its energy is smooth there
        lengths.push_back((at(spring.to) - at(spring.from)).norm());
    }
    for (std::size_t i = 0; i < system_.shapes.size(); ++i) {
      // A slack cable pulls nowhere, and what has no force at the length 0 passes it.
      const statics::ShapeState state = statics::shape_state(system_, i, z_, inputs_);
      // The coordinates of springs in series turn back there, whatever their forces are.
      const PointShape& shape = system_.shapes[i];
      const bool is_kink = shape.shape.kind != ShapeKind::path || shape.inner_count > 0 ||
                           !is_smooth_at_edge(shape, state.value);
      const bool pulls = state.slope != 0 && is_kink;
      const std::size_t first = lengths.size();
      add(shape);
      if (!pulls) std::fill(lengths.begin() + static_cast<std::ptrdiff_t>(first), lengths.end(), 1);
    }
  }

  std::vector<double> lengths{};

 private:
  EndPoint at(std::size_t point) const { return position_of(system_, point, z_, inputs_.rho); }

  void add(const PointShape& shape) {
    const std::vector<std::size_t>& p = shape.points;
    const auto way = [&](std::size_t from, std::size_t to) {
      lengths.push_back((at(p[to]) - at(p[from])).norm());
    };
    switch (shape.shape.kind) {
      case ShapeKind::path:
        for (std::size_t k = 0; k + 1 < p.size(); ++k) way(k, k + 1);
        if (shape.shape.closed) way(p.size() - 1, 0);
        return;
      case ShapeKind::angle:
        way(1, 0);
        way(1, 2);
        return;
      case ShapeKind::line:
        way(1, 2);
        return;
      case ShapeKind::dihedral: {
        const EndPoint begin = at(p[1]), edge = at(p[2]) - begin;
        for (const std::size_t k : {std::size_t{0}, std::size_t{3}})
          lengths.push_back(model::cross<double>(edge, at(p[k]) - begin).norm() / edge.norm());
        return;
      }
      case ShapeKind::area:
      case ShapeKind::volume:
      case ShapeKind::plane:
        return;
    }
  }

  const statics::System& system_;
  Vector z_{};
  statics::Inputs inputs_{};
};

/// Dimensionless: far above the rounding of positions, far below what a step moves.
constexpr double no_length = 1e-9;

/// What each of those lengths is, in words before its value and behind it.
struct LengthWords {
  std::string what{}, reason{};
};

std::vector<LengthWords> words_of(const statics::System& system) {
  std::vector<LengthWords> words;
  const auto add = [&words](const std::string& what, const std::string& reason) {
    words.push_back({what, reason});
  };
  const std::string no_direction = "at the length 0 its force has no direction";
  for (std::size_t i = 0; i < system.line_springs.size(); ++i)
    if (system.line_springs[i].free != 0)
      add("the length of " + system.mechanism.line_springs[i].name, no_direction);
  for (const PointShape& shape : system.shapes) {
    const std::size_t n = shape.points.size();
    const auto between = [&](std::size_t from, std::size_t to, const std::string& reason) {
      add("the distance of points " + std::to_string(from + 1) + " and " + std::to_string(to + 1) +
              " of " + shape.name,
          reason);
    };
    const std::string no_angle = "where it is 0 the angle is not defined";
    switch (shape.shape.kind) {
      case ShapeKind::path:
        if (n == 2)
          add("the length of " + shape.name, shape.inner_count > 0
                                                 ? "at the length 0 its springs in series turn back"
                                                 : no_direction);
        for (std::size_t k = 0; n > 2 && k + 1 < n; ++k)
          between(k, k + 1, "where it is 0 its force has no direction");
        if (shape.shape.closed) between(n - 1, 0, "where it is 0 its force has no direction");
        break;
      case ShapeKind::angle:
        between(1, 0, no_angle);
        between(1, 2, no_angle);
        break;
      case ShapeKind::line:
        between(1, 2, "where it is 0 the line is not defined");
        break;
      case ShapeKind::dihedral:
        for (const char* point : {"1", "4"})
          add(std::string{"the distance of point "} + point + " of " + shape.name +
                  " from its edge",
              no_angle);
        break;
      case ShapeKind::area:
      case ShapeKind::volume:
      case ShapeKind::plane:
        break;
    }
  }
  return words;
}

}  // namespace

std::optional<std::string> vanishing_length(const PathProblem& problem,
                                            const continuation::Curve& curve,
                                            const CurvePoint& end) {
  constexpr double share = 1e-2;  // as for closures and legs that are about to lose rank
  const std::vector<double> here = CriticalLengths(problem, end).lengths;
  if (here.empty() || curve.points.empty()) return std::nullopt;
  std::vector<double> largest = here, before = here;
  for (const CurvePoint& point : curve.points) {
    const std::vector<double> there = CriticalLengths(problem, point).lengths;
    if (there.size() != here.size()) return std::nullopt;
    for (std::size_t i = 0; i < there.size(); ++i) {
      largest[i] = std::max(largest[i], there[i]);
      if (there[i] != here[i]) before[i] = there[i];  // the last other one
    }
  }
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < here.size(); ++i)
    if (here[i] <= share * largest[i] && here[i] < before[i] &&
        (!nearest || here[i] * largest[*nearest] < here[*nearest] * largest[i]))
      nearest = i;
  if (!nearest && curve.points.size() == 1) {  // the start itself, which the curve does not leave
    const auto gone =
        std::find_if(here.begin(), here.end(), [](double l) { return l <= no_length; });
    if (gone != here.end()) nearest = static_cast<std::size_t>(gone - here.begin());
  }
  if (!nearest) return std::nullopt;
  const LengthWords words = words_of(problem.system(end.lambda))[*nearest];
  return words.what + " has come down to " + rounded(problem.rule().length * here[*nearest]) +
         ": " + words.reason;
}

}  // namespace springfold::analysis
