// Shapes: numbers that the positions of points give, with exact first and second derivatives. What
// springs between points, springs of angles and folds, pressures and contacts need.
#pragma once

#include <array>
#include <cassert>

#include "springfold/model/compiled_chain.hpp"
#include "springfold/model/shape_forms.hpp"

namespace springfold::model {

/// A shape as evaluations want it; its points are given as positions.
struct CompiledShape {
  ShapeKind kind = ShapeKind::path;
  bool closed = false;
  bool in_plane = false;  ///< all bodies move in the xy plane: angles and sides have a sign
  double near = 0;        ///< angles
  std::vector<std::array<std::size_t, 3>> triangles{};
};

/// @pre problems_in(mechanism).empty()
CompiledShape compile(const Mechanism& mechanism, const Shape& shape);

/// alpha of m points with its derivatives by their positions, three entries per point, world axes.
template <class S>
struct ShapeValue {
  S value{};
  VectorOf<S> gradient{};  ///< 3m
  MatrixOf<S> hessian{};   ///< 3m x 3m
};

/// Energy of a gas and its derivatives by alpha. Not finite where it has no volume.
struct ShapeEnergy {
  double energy = 0, slope = 0, curvature = 0;
};
ShapeEnergy energy_of(const Gas& gas, double volume);

/// What problems_in(mechanism) says of a shape, but for its anchors; each without a place.
std::vector<std::string> problems_in(const Shape& shape);

namespace detail {

template <class S>
Vec3<S> position(const VectorOf<S>& p, std::size_t i) {
  return p.template segment<3>(3 * static_cast<Index>(i));
}

/// A function of differences p[to] - p[from] as one of all points.
template <class S, int D>
void spread(const Form<S, D>& f, const std::array<std::array<Index, 2>, D>& ends,
            ShapeValue<S>& out) {
  out.value = f.value;
  for (Index i = 0; i < D; ++i)
    for (const int a : {0, 1}) {
      const double sign_a = a == 0 ? 1 : -1;
      const Index row = 3 * ends[static_cast<std::size_t>(i)][static_cast<std::size_t>(a)];
      out.gradient.template segment<3>(row) += sign_a * f.g.template segment<3>(3 * i);
      for (Index j = 0; j < D; ++j)
        for (const int b : {0, 1}) {
          const double sign = b == 0 ? sign_a : -sign_a;
          const Index column = 3 * ends[static_cast<std::size_t>(j)][static_cast<std::size_t>(b)];
          out.hessian.template block<3, 3>(row, column) +=
              sign * f.H.template block<3, 3>(3 * i, 3 * j);
        }
    }
}

template <class S, std::size_t D>
std::array<Vec3<S>, D> differences(const VectorOf<S>& p,
                                   const std::array<std::array<Index, 2>, D>& ends) {
  std::array<Vec3<S>, D> d;
  for (std::size_t i = 0; i < D; ++i)
    d[i] = position<S>(p, static_cast<std::size_t>(ends[i][0])) -
           position<S>(p, static_cast<std::size_t>(ends[i][1]));
  return d;
}

/// Of the angles that differ by whole turns the one nearest to `near`.
template <class S>
S nearest_angle(const S& angle, double near) {
  const double turn = 2 * std::numbers::pi;
  return angle + turn * std::round((near - std::real(angle)) / turn);
}

/// Way between neighbours: dl = d/l, d2l = (1 - dd^T/l^2)/l.
template <class S>
void path_length(const CompiledShape& shape, const VectorOf<S>& p, ShapeValue<S>& out) {
  const Index m = p.size() / 3;
  for (Index i = 0; i + 1 < m || (shape.closed && i < m); ++i) {
    const Index a = 3 * i, b = 3 * ((i + 1) % m);
    const Vec3<S> d = p.template segment<3>(b) - p.template segment<3>(a);
    const S l = std::sqrt(dot<S>(d, d));
    const Vec3<S> e = d / l;
    const Mat3<S> H = (Mat3<S>::Identity() - outer<S>(e, e)) / l;
    out.value += l;
    out.gradient.template segment<3>(a) -= e;
    out.gradient.template segment<3>(b) += e;
    out.hessian.template block<3, 3>(a, a) += H;
    out.hessian.template block<3, 3>(b, b) += H;
    out.hessian.template block<3, 3>(a, b) -= H;
    out.hessian.template block<3, 3>(b, a) -= H;
  }
}

/// A = sum of (x_i y_k - x_k y_i)/2 over the sides i, k, from the first point: no large numbers are
/// subtracted where the polygon lies far from the origin.
template <class S>
void polygon_area(const VectorOf<S>& p, ShapeValue<S>& out) {
  const Index m = p.size() / 3;
  for (Index i = 0; i < m; ++i) {
    const Index a = 3 * i, b = 3 * ((i + 1) % m);
    const S half(0.5);
    const S xa = p[a] - p[0], ya = p[a + 1] - p[1], xb = p[b] - p[0], yb = p[b + 1] - p[1];
    out.value += half * (xa * yb - xb * ya);
    out.gradient[a] += half * yb;
    out.gradient[a + 1] -= half * xb;
    out.gradient[b] -= half * ya;
    out.gradient[b + 1] += half * xa;
    out.hessian(a, b + 1) += half;
    out.hessian(b + 1, a) += half;
    out.hessian(a + 1, b) -= half;
    out.hessian(b, a + 1) -= half;
  }
}

/// V = sum of a . (b x c)/6 over the triangles; a closed mesh has the same from every origin.
template <class S>
void mesh_volume(const CompiledShape& shape, const VectorOf<S>& p, ShapeValue<S>& out) {
  const Vec3<S> origin = position<S>(p, 0);
  for (const auto& corners : shape.triangles) {
    Vectors<S, 3> d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = position<S>(p, corners[k]) - origin;
    const Form<S, 3> f = triple<S>(d);
    out.value += f.value / S(6);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = 3 * static_cast<Index>(corners[i]);
      const auto own = 3 * static_cast<Index>(i);
      out.gradient.template segment<3>(row) += f.g.template segment<3>(own) / S(6);
      for (std::size_t j = 0; j < 3; ++j)
        out.hessian.template block<3, 3>(row, 3 * static_cast<Index>(corners[j])) +=
            f.H.template block<3, 3>(own, 3 * static_cast<Index>(j)) / S(6);
    }
  }
}

template <class S>
void three_point_angle(const CompiledShape& shape, const VectorOf<S>& p, ShapeValue<S>& out) {
  constexpr std::array<std::array<Index, 2>, 2> ends{{{0, 1}, {2, 1}}};
  const Vectors<S, 2> d = differences<S>(p, ends);
  const Form<S, 2> y =
      shape.in_plane ? cross_z<S, 2>(d, 0, 1) : power<S, 2>(cross_square<S, 2>(d, 0, 1), 0.5);
  spread<S, 2>(direction<S, 2>(y, inner<S, 2>(d, 0, 1)), ends, out);
  if (shape.in_plane) out.value = nearest_angle<S>(out.value, shape.near);
}

/// tan(alpha) = |d_2| d_1 . (d_2 x d_3) / (d_1 x d_2) . (d_2 x d_3), d_i from point to point.
template <class S>
void dihedral_angle(const CompiledShape& shape, const VectorOf<S>& p, ShapeValue<S>& out) {
  constexpr std::array<std::array<Index, 2>, 3> ends{{{1, 0}, {2, 1}, {3, 2}}};
  const Vectors<S, 3> d = differences<S>(p, ends);
  const Form<S, 3> edge = power<S, 3>(inner<S, 3>(d, 1, 1), 0.5);
  spread<S, 3>(direction<S, 3>(product<S, 3>(edge, triple<S>(d)), cross_inner<S>(d)), ends, out);
  out.value = nearest_angle<S>(out.value, shape.near);
}

template <class S>
void line_distance(const CompiledShape& shape, const VectorOf<S>& p, ShapeValue<S>& out) {
  constexpr std::array<std::array<Index, 2>, 2> ends{{{2, 1}, {0, 1}}};
  const Vectors<S, 2> d = differences<S>(p, ends);
  const Form<S, 2> side =
      shape.in_plane ? cross_z<S, 2>(d, 0, 1) : power<S, 2>(cross_square<S, 2>(d, 0, 1), 0.5);
  spread<S, 2>(product<S, 2>(side, power<S, 2>(inner<S, 2>(d, 0, 0), -0.5)), ends, out);
}

template <class S>
void plane_distance(const VectorOf<S>& p, ShapeValue<S>& out) {
  constexpr std::array<std::array<Index, 2>, 3> ends{{{2, 1}, {3, 1}, {0, 1}}};
  const Vectors<S, 3> d = differences<S>(p, ends);
  const Form<S, 3> area = power<S, 3>(cross_square<S, 3>(d, 0, 1), -0.5);
  spread<S, 3>(product<S, 3>(triple<S>(d), area), ends, out);
}

}  // namespace detail

/// @param p  positions of the points one behind the other, 3m entries, world axes
/// @param out  not finite where alpha is not smooth (points that coincide, angles in space at 0 and pi)
template <class S>
void evaluate_shape(const CompiledShape& shape, const VectorOf<S>& p, ShapeValue<S>& out) {
  assert(p.size() % 3 == 0);
  out.value = S(0);
  out.gradient.setZero(p.size());
  out.hessian.setZero(p.size(), p.size());
  switch (shape.kind) {
    case ShapeKind::path:
      return detail::path_length<S>(shape, p, out);
    case ShapeKind::angle:
      return detail::three_point_angle<S>(shape, p, out);
    case ShapeKind::dihedral:
      return detail::dihedral_angle<S>(shape, p, out);
    case ShapeKind::area:
      return detail::polygon_area<S>(p, out);
    case ShapeKind::volume:
      return detail::mesh_volume<S>(shape, p, out);
    case ShapeKind::line:
      return detail::line_distance<S>(shape, p, out);
    case ShapeKind::plane:
      return detail::plane_distance<S>(p, out);
  }
}

}  // namespace springfold::model
