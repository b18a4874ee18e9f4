#include "springfold/model/shape.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace springfold::model {
namespace {

/// How many points a shape needs: at least, at most (0: any number).
struct Count {
  std::size_t least = 0, most = 0;
};

Count points_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::path:
      return {2, 0};
    case ShapeKind::area:
      return {3, 0};
    case ShapeKind::volume:
      return {4, 0};
    case ShapeKind::angle:
    case ShapeKind::line:
      return {3, 3};
    case ShapeKind::dihedral:
    case ShapeKind::plane:
      return {4, 4};
  }
  return {};
}

/// Every side of every triangle once in each direction: no hole, no triangle turned over.
std::string problem_in_mesh(const Shape& shape) {
  if (shape.triangles.empty()) return "need a list of triangles";
  std::map<std::pair<std::size_t, std::size_t>, int> sides;
  for (const auto& corners : shape.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = corners[k], b = corners[(k + 1) % 3];
      if (a >= shape.points.size()) return "got the number of a point that `of` does not have";
      if (a == b) return "got a triangle with the same corner twice";
      ++sides[{a, b}];
    }
  for (const auto& [side, count] : sides) {
    const auto back = sides.find({side.second, side.first});
    if (count != 1 || back == sides.end())
      return "the side of points " + std::to_string(side.first + 1) + " and " +
             std::to_string(side.second + 1) +
             " belongs to one triangle only or is passed twice in one direction: need a closed "
             "surface whose triangles are all counter-clockwise seen from outside";
  }
  return "";
}

}  // namespace

CompiledShape compile(const Mechanism& mechanism, const Shape& shape) {
  const bool in_plane =
      std::all_of(mechanism.bodies.begin(), mechanism.bodies.end(),
                  [](const Body& body) { return translations(body.task_space) == 2; });
  return {shape.kind, shape.closed, in_plane, shape.near, shape.triangles};
}

ShapeEnergy energy_of(const Gas& gas, double volume) {
  if (gas.nRT == 0) return {};
  const double r = volume / gas.initial, n = gas.exponent;
  if (!(r > 0)) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none};
  }
  const double pressed = n == 1 ? std::log(r) : std::expm1((1 - n) * std::log(r)) / (1 - n);
  return {gas.nRT * (r - 1 - pressed), gas.nRT / gas.initial * -std::expm1(-n * std::log(r)),
          gas.nRT / (gas.initial * gas.initial) * n * std::pow(r, -n - 1)};
}

std::vector<std::string> problems_in(const Shape& shape) {
  std::vector<std::string> problems;
  const auto [least, most] = points_of(shape.kind);
  const std::size_t m = shape.points.size();
  if (m < least || (most > 0 && m > most))
    problems.push_back("of: got " + std::to_string(m) + " points, need " + std::to_string(least) +
                       (most > 0 ? "" : " or more"));
  if (!std::isfinite(shape.near)) problems.push_back("near: need a finite number");
  const bool some_moves = std::any_of(shape.points.begin(), shape.points.end(),
                                      [](const auto& p) { return p.chain >= 0 || p.body != 0; });
  if (!shape.points.empty() && !some_moves)
    problems.push_back("of: one of the points must be able to move");
  if (shape.kind != ShapeKind::volume || !problems.empty()) return problems;
  if (const std::string what = problem_in_mesh(shape); !what.empty())
    problems.push_back("triangles: " + what);
  return problems;
}

}  // namespace springfold::model
