#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "continuation/locating/reduced_equation.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

constexpr double pi = std::numbers::pi;

/// Zeros of a function on the full circle; nan where it is not defined.
struct CircleZeros {
  std::vector<double> angles{};
  int undefined = 0;     ///< samples
  double size = 0;       ///< largest value
  bool touches = false;  ///< a zero that cannot be told from a double one
};

class CircleScan {
 public:
  CircleScan(std::function<double(double)> f, int samples) : f_{std::move(f)} {
    // Off the places where symmetric problems have their zeros.
    for (int i = 0; i < samples; ++i) at_.push_back(2 * pi * (i + uneven_share(1)) / samples);
    for (const double a : at_) values_.push_back(f_(a));
    step_ = 2 * pi / samples;
    for (const double v : values_)
      result_.size = std::max(result_.size, std::isnan(v) ? 0 : std::abs(v));
  }

  CircleZeros zeros() {
    const std::size_t m = at_.size();
    for (std::size_t i = 0; i < m; ++i) {
      const double v = values_[i], next = values_[(i + 1) % m], last = values_[(i + m - 1) % m];
      if (std::isnan(v)) ++result_.undefined;
      if (std::isnan(v) || std::isnan(next)) continue;
      if ((v < 0) != (next < 0)) {
        subdivide(at_[i], v, next);
      } else if (!std::isnan(last) && (last < 0) == (v < 0) && std::abs(v) <= std::abs(last) &&
                 std::abs(v) <= std::abs(next) &&
                 std::abs(v) < near_share * std::max(std::abs(last), std::abs(next))) {
        dip(at_[i], v);
      }
    }
    return result_;
  }

 private:
  void bracket(double a, double b, double fa, double fb) {
    std::uintmax_t most = 60;
    if (!(a < b) || std::isnan(fa) || std::isnan(fb) || (fa < 0) == (fb < 0)) {
      ++result_.undefined;
      return;
    }
    if (fa == 0 || fb == 0) return result_.angles.push_back(fa == 0 ? a : b);
    const auto close = [](double l, double r) { return std::abs(r - l) < promised_place; };
    const auto [low, high] = boost::math::tools::toms748_solve(f_, a, b, fa, fb, close, most);
    result_.angles.push_back(0.5 * (low + high));
  }

  /// Three zeros may hide in one interval.
  void subdivide(double a, double fa, double fb) {
    constexpr int parts = 6;
    for (int j = 1; j <= parts; ++j) {
      const double b = a + step_ / parts, value = j == parts ? fb : f_(b);
      if (std::isnan(value)) {
        ++result_.undefined;
        return;
      }
      if ((fa < 0) != (value < 0)) bracket(a, b, fa, value);
      a = b, fa = value;
    }
  }

  /// A minimum of |f| near zero: two zeros, none, or too close to call.
  void dip(double at, double value) {
    const double sign = value < 0 ? -1 : 1;
    std::uintmax_t most = 60;
    const auto [a, low] = boost::math::tools::brent_find_minima(
        [&](double t) { return sign * f_(t); }, at - step_, at + step_, 26, most);
    if (low < -one_place * result_.size) {
      bracket(at - step_, a, f_(at - step_), sign * low);
      bracket(a, at + step_, sign * low, f_(at + step_));
    } else if (!(low > one_place * result_.size)) {
      result_.touches = true;
    }
  }

  std::function<double(double)> f_;
  std::vector<double> at_{}, values_{};
  double step_ = 0;
  CircleZeros result_{};
};

void search_circle(const ReducedEquation& e, int samples, RaySet& set) {
  const auto on_circle = [&](double a) {
    return Vector{{set.rho * std::cos(a), set.rho * std::sin(a)}};
  };
  const auto g = [&](double a) {
    const auto value = reduced_value(e, on_circle(a));
    return value ? value->g[0] : not_a_number;
  };
  const CircleZeros zeros = CircleScan(g, samples).zeros();
  for (const double a : zeros.angles)
    if (const auto value = reduced_value(e, on_circle(a))) add_ray(e, value->U, set);
  if (zeros.undefined > 0) set.doubt = "the equations cannot be reduced all around the point";
  if (zeros.touches) set.doubt = "branches touch that cannot be told from one double branch";
  if (set.rays.size() != zeros.angles.size()) set.doubt = "zeros of the reduced equation are lost";
}

/// Icosahedron with its faces divided three times into four, turned out of all planes of symmetry.
struct Icosphere {
  std::vector<Eigen::Vector3d> vertices{};
  std::vector<std::array<std::size_t, 3>> faces{};
};

void divide(Icosphere& sphere) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
  const auto middle = [&](std::size_t a, std::size_t b) {
    const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), sphere.vertices.size());
    if (fresh) sphere.vertices.push_back((sphere.vertices[a] + sphere.vertices[b]).normalized());
    return place->second;
  };
  std::vector<std::array<std::size_t, 3>> finer;
  for (const auto& [a, b, c] : sphere.faces) {
    const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& face : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      finer.push_back(face);
  }
  sphere.faces = std::move(finer);
}

Icosphere icosphere() {
  Icosphere sphere{.faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                             {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                             {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                             {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  for (int axis = 0; axis < 3; ++axis)
    for (const double t : {std::numbers::phi, -std::numbers::phi})
      for (const double one : {-1.0, 1.0}) {
        Eigen::Vector3d& v = sphere.vertices.emplace_back(Eigen::Vector3d::Zero());
        v[axis] = one;
        v[(axis + 1) % 3] = t;
      }
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(3, 5, 8).normalized()).matrix();
  for (auto& v : sphere.vertices) v = turn * v.normalized();
  for (int i = 0; i < 3; ++i) divide(sphere);
  return sphere;
}

/// Could g, linear on a triangle, vanish on it or close to it? Then where, in the triangle.
std::optional<Eigen::Vector3d> linear_zero(const Eigen::Matrix<double, 2, 3>& g) {
  Eigen::Matrix3d A;
  A << g / g.cwiseAbs().maxCoeff(), 1, 1, 1;
  const FullPivotLu lu(A);
  if (!lu.is_invertible()) return Eigen::Vector3d::Constant(1.0 / 3);
  Eigen::Vector3d weights = lu.solve(Eigen::Vector3d::UnitZ());
  if (!(weights.minCoeff() > -0.75)) return std::nullopt;
  weights = weights.cwiseMax(0);
  return weights / weights.sum();
}

void search_sphere(const ReducedEquation& e, RaySet& set) {
  const Icosphere sphere = icosphere();
  std::vector<std::optional<ReducedValue>> values;
  for (const auto& v : sphere.vertices) values.push_back(reduced_value(e, set.rho * v));
  for (const auto& face : sphere.faces) {
    Eigen::Matrix<double, 2, 3> g;
    Matrix U(e.U0.size(), 3);
    bool defined = true;
    for (std::size_t j = 0; j < 3 && defined; ++j) {
      const auto& value = values[face[j]];
      if ((defined = value.has_value())) {
        g.col(static_cast<Index>(j)) = value->g;
        U.col(static_cast<Index>(j)) = value->U;
      }
    }
    if (!defined) {
      set.doubt = "the equations cannot be reduced all around the point";
      continue;
    }
    if (const auto weights = linear_zero(g)) add_ray(e, U * *weights, set);
  }
}

/// dg/dmu at c from the quadratic terms, mu = the last entry of c.
Eigen::Vector2d slope_in_mu(const ReducedEquation& e, const Vector& c) {
  return {e.quadratic[0].row(2).dot(c), e.quadratic[1].row(2).dot(c)};
}

/// For |y| = rho at the azimuth phi: mu such that p . g(y, mu) = 0, with p along dg/dmu.
/// `mu` starts the iteration and returns the solution.
/// @returns the other component of g, zero on branches; nan where mu is not found
double across(const ReducedEquation& e, double rho, double phi, double& mu, Vector& U) {
  Vector c{{rho * std::cos(phi), rho * std::sin(phi), 0.0}};
  double other = not_a_number;
  const bool found = settles(15, [&](double) -> std::optional<IterationStep> {
    c[2] = mu;
    const Eigen::Vector2d slope = slope_in_mu(e, c), p = slope.normalized();
    const auto value = reduced_value(e, c);
    if (!value || !(slope.norm() > 0)) return std::nullopt;
    const double change = -p.dot(value->g) / slope.norm();
    const IterationStep step{std::abs(change),
                             one_place * rho * rho + 2 * few_roundings * e.scale / slope.norm()};
    U = value->U;
    other = p[0] * value->g[1] - p[1] * value->g[0];
    if (step.moved <= step.fine) return step;  // the value is for this mu
    mu += std::clamp(change, -near_share * rho, near_share * rho);
    if (!(std::abs(mu) < 3 * rho)) return std::nullopt;
    return step;
  });
  return found ? other : not_a_number;
}

/// Have the quadratic terms in y so little to say that search_sphere cannot see all branches?
bool nearly_flat(const ReducedEquation& e) {
  const auto norms = [&](Index size) {
    return std::hypot(e.quadratic[0].topLeftCorner(size, size).norm(),
                      e.quadratic[1].topLeftCorner(size, size).norm());
  };
  return norms(2) < negligible_share * norms(3);
}

/// Branches that are determined by mu beside the azimuth: pitchforks and everything that is tangent
/// to the plane mu = 0, where g on the sphere is too small for search_sphere.
void search_azimuth(const ReducedEquation& e, RaySet& set) {
  double mu = 0;
  Vector U;
  const auto h = [&](double phi) {
    const double value = across(e, set.rho, phi, mu, U);
    if (std::isnan(value)) mu = 0;
    return value;
  };
  const CircleZeros zeros = CircleScan(h, 240).zeros();
  for (const double phi : zeros.angles) {
    const double value = h(phi);
    const bool jumps = std::abs(value) > told_apart * zeros.size;  // of mu, or rounding
    if (jumps && !nearly_flat(e)) continue;
    if (jumps || std::isnan(value) || !add_ray(e, U, set))
      set.doubt = "zeros of the reduced equation are lost";
  }
  if (nearly_flat(e) && zeros.size < refined_step * e.scale)
    set.doubt = "branches cannot be told apart within rounding";
  if (zeros.undefined > 0 && nearly_flat(e))
    set.doubt = "the equations cannot be reduced all around the point";
  if (zeros.touches) set.doubt = "branches touch that cannot be told from one double branch";
}

}  // namespace

std::vector<Vector> quadratic_rays(const ReducedEquation& e) {
  std::vector<Vector> found;
  const auto add = [&](const Vector& start) {
    const auto c = quadratic_direction(e, start, near_share);
    if (!c) return;
    for (const Vector& known : found)
      if ((known - *c).norm() < one_direction) return;
    found.push_back(*c);
  };
  for (int i = 0; e.k == 1 && i < 64; ++i)
    add(Vector{{std::cos(2 * pi * i / 64), std::sin(2 * pi * i / 64)}});
  if (e.k != 2) return found;
  const Icosphere sphere = icosphere();
  for (const auto& face : sphere.faces) {
    Eigen::Matrix<double, 2, 3> g;
    Eigen::Matrix3d corners;
    for (Index j = 0; j < 3; ++j) {
      const Eigen::Vector3d v = sphere.vertices[face[static_cast<std::size_t>(j)]];
      corners.col(j) = v;
      for (Index q = 0; q < 2; ++q) g(q, j) = v.dot(e.quadratic[static_cast<std::size_t>(q)] * v);
    }
    if (!(g.cwiseAbs().maxCoeff() > 0)) continue;
    if (const auto weights = linear_zero(g)) add(corners * *weights);
  }
  return found;
}

bool add_ray(const ReducedEquation& e, const Vector& U, RaySet& set) {
  auto ray = ray_point(e, U, set.rho);
  if (!ray) return false;
  for (const RayPoint& known : set.rays)
    if ((known.c - ray->c).norm() < blurred * set.rho) return true;
  set.rays.push_back(std::move(*ray));
  return true;
}

RaySet rays_on_sphere(const ReducedEquation& e, double rho, int samples) {
  RaySet set{.rho = rho};
  if (e.k == 0)
    for (const double c : {rho, -rho}) add_ray(e, e.U0 + c * e.N.col(0), set);
  if (e.k == 1) search_circle(e, samples, set);
  if (e.k == 2) search_sphere(e, set);
  if (e.k == 2 && e.follows) search_azimuth(e, set);
  return set;
}

}  // namespace springfold::continuation
