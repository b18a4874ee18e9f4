#include "shape_terms.hpp"

#include <cassert>

#include "point_terms.hpp"
#include "springfold/model/shape_edge.hpp"

namespace springfold::statics {
namespace {

using model::Mat3;
using model::PointMotion;
using model::ShapeEnergy;
using model::Vec3;

/// By how much the points' frames are turned about z, whole turns counted: all their axes are along z.
double turn_of(const Workspace::Point& point) { return point.at.spin.row(2).dot(point.variables); }

bool counts_turns(const PointShape& shape) {
  return shape.shape.kind == model::ShapeKind::angle && shape.shape.in_plane;
}

/// `near`, which moves with the frames of the two rays.
double middle_of(const PointShape& shape, double turned) {
  return shape.shape.near + turned - shape.turned;
}

/// The angle nearest to it.
double counted(const PointShape& shape, double angle, double turned) {
  return model::detail::nearest_angle<double>(angle, middle_of(shape, turned));
}

/// The derivatives of alpha, or of what stands for it, by the variables of the points.
void put_slopes(const PointShape& shape, Workspace& work) {
  Workspace::Shape& out = work.shape;
  Index count = 0, first = 0;
  for (const std::size_t point : shape.points) count += work.points[point].at.dp.cols();
  out.slopes.resize(count);
  for (std::size_t a = 0; a < shape.points.size(); ++a) {
    const auto& dp = work.points[shape.points[a]].at.dp;
    const Vec3<double> g = out.at.gradient.segment<3>(3 * static_cast<Index>(a));
    for (Index j = 0; j < dp.cols(); ++j) out.slopes[first + j] = g.dot(dp.col(j));
    first += dp.cols();
  }
}

/// Motions of the points, alpha, and its derivatives by their variables.
void evaluate(const System& system, const PointShape& shape, const Vector& z, const Vector& rho,
              Workspace& work) {
  work.points.resize(system.points.size());
  Workspace::Shape& out = work.shape;
  out.positions.resize(3 * std::ssize(shape.points));
  for (std::size_t a = 0; a < shape.points.size(); ++a) {
    Workspace::Point& point = work.points[shape.points[a]];
    evaluate_point(system, shape.points[a], z, rho, point);
    out.positions.segment<3>(3 * static_cast<Index>(a)) = point.at.pose.p;
  }
  model::evaluate_shape<double>(shape.shape, out.positions, out.at);
  if (counts_turns(shape))
    out.at.value =
        counted(shape, out.at.value,
                turn_of(work.points[shape.points[2]]) - turn_of(work.points[shape.points[0]]));
  put_slopes(shape, work);
}

/// Coordinate of the law: alpha without what springs in series take of it.
double own_part(const PointShape& shape, double alpha, const Vector& z) {
  if (shape.inner_count == 0) return alpha;
  return alpha - shape.offset - z.segment(shape.inner, shape.inner_count).sum();
}

double factor_of(const PointShape& shape, const Vector& factors) {
  return factors.size() == 0 ? 1 : factors[shape.load];
}

/// Derivatives by alpha. The energy itself is left out: that of a formula is a quadrature.
struct AlphaSlopes {
  double slope = 0, curvature = 0;
};

/// @param own  coordinate of the law
AlphaSlopes slopes_in(const PointShape& shape, std::size_t segment, double own,
                      const Vector& factors) {
  if (shape.is_pressure()) return {-factor_of(shape, factors) * shape.pressure, 0};
  if (!shape.gas) return {shape.law.torque(segment, own), shape.law.stiffness(segment, own)};
  const ShapeEnergy gas = energy_of(*shape.gas, own);
  return {gas.slope, gas.curvature};
}

/// Beside a value at which alpha has an edge and the energy has none: the derivatives by a smooth function of the
/// points, whose own derivatives are put into `work` in place of those of alpha.
std::optional<AlphaSlopes> slopes_at_edge(const PointShape& shape, std::size_t segment,
                                          Workspace& work) {
  constexpr double beside = 1e-2;  // farther away alpha itself loses no digits
  if (shape.gas || shape.is_pressure() || shape.inner_count > 0) return std::nullopt;
  const double alpha = work.shape.at.value;
  const auto edge = model::edge_of(shape.shape, shape.points.size(), alpha);
  if (!edge || !(std::abs(alpha - edge->at) < beside)) return std::nullopt;
  const auto slopes = model::slopes_about_edge(shape.law, segment, *edge, alpha);
  if (!slopes) return std::nullopt;
  model::evaluate_about_edge<double>(shape.shape, *edge, work.shape.positions, work.shape.at);
  put_slopes(shape, work);
  return AlphaSlopes{slopes->slope, slopes->curvature};
}

double energy_in(const PointShape& shape, std::size_t segment, double own, const Vector& factors) {
  if (shape.is_pressure()) return -factor_of(shape, factors) * shape.pressure * own;
  return shape.gas ? energy_of(*shape.gas, own).energy : shape.law.energy(segment, own);
}

/// One shape's part, from what evaluate() has left in `work`.
class Term {
 public:
  Term(const System& system, const PointShape& shape, const Workspace& work, const AlphaSlopes& at)
      : system_{system}, shape_{shape}, work_{work}, at_{at} {}

  void add(Vector& residual, Matrix* A, Matrix* dR_drho) const {
    Index row = 0;
    for (std::size_t a = 0; a < shape_.points.size(); ++a) {
      const PointSlice& slice = system_.points[shape_.points[a]];
      for (const Index z : slice.z) {
        if (z >= 0) residual[z] += at_.slope * work_.shape.slopes[row];
        ++row;
      }
    }
    for (Index i = 0; i < shape_.inner_count; ++i) residual[shape_.inner + i] -= at_.slope;
    if (A == nullptr) return;
    if (shape_.inner_count > 0) add_inner(*A, dR_drho);
    Index first = 0;
    for (std::size_t a = 0; a < shape_.points.size(); ++a) {
      Index column = 0;
      for (std::size_t b = 0; b < shape_.points.size(); ++b) {
        add_block(a, first, b, column, *A, dR_drho);
        column += std::ssize(system_.points[shape_.points[b]].z);
      }
      first += std::ssize(system_.points[shape_.points[a]].z);
    }
  }

 private:
  /// The coordinate of the law has the derivative -1 by each inner one.
  void add_inner(Matrix& A, Matrix* dR_drho) const {
    const Index u = shape_.inner, n = shape_.inner_count;
    A.block(u, u, n, n).array() += at_.curvature;
    Index i = 0;
    for (const std::size_t point : shape_.points) {
      const PointSlice& slice = system_.points[point];
      for (std::size_t k = 0; k < slice.z.size(); ++k, ++i) {
        const double value = -at_.curvature * work_.shape.slopes[i];
        if (slice.z[k] >= 0) {
          A.col(slice.z[k]).segment(u, n).array() += value;
          A.row(slice.z[k]).segment(u, n).array() += value;
        }
        if (dR_drho != nullptr && slice.rho[k] >= 0)
          dR_drho->col(slice.rho[k]).segment(u, n).array() += value;
      }
    }
  }

  const PointMotion<double>& motion(std::size_t a) const {
    return work_.points[shape_.points[a]].at;
  }

  /// Rows of point a, columns of point b.
  void add_block(std::size_t a, Index first, std::size_t b, Index column, Matrix& A,
                 Matrix* dR_drho) const {
    const PointSlice& rows = system_.points[shape_.points[a]];
    const PointSlice& columns = system_.points[shape_.points[b]];
    const auto i = 3 * static_cast<Index>(a), j = 3 * static_cast<Index>(b);
    const Mat3<double> H = at_.slope * work_.shape.at.hessian.block<3, 3>(i, j);
    const Vec3<double> g = at_.slope * work_.shape.at.gradient.segment<3>(i);
    const Vector& q = work_.shape.slopes;
    for (Index r = 0; r < std::ssize(rows.z); ++r) {
      if (rows.z[static_cast<std::size_t>(r)] < 0) continue;
      const Vec3<double> across = H.transpose() * motion(a).dp.col(r);
      for (Index c = 0; c < std::ssize(columns.z); ++c) {
        double value =
            at_.curvature * q[first + r] * q[column + c] + across.dot(motion(b).dp.col(c));
        if (a == b) value += g.dot(second_displacement(motion(a), r, c));
        add_derivative(rows, r, columns, c, value, A, dR_drho);
      }
    }
  }

  const System& system_;
  const PointShape& shape_;
  const Workspace& work_;
  AlphaSlopes at_;
};

double turn_between(const System& system, const PointShape& shape, const Vector& z,
                    const Vector& rho) {
  Workspace::Point first, last;
  evaluate_point(system, shape.points[0], z, rho, first);
  evaluate_point(system, shape.points[2], z, rho, last);
  return turn_of(last) - turn_of(first);
}

/// How far alpha is from the middle of its range; 0 where it has none.
double off_middle(const System& system, const PointShape& shape, double alpha, const Vector& z,
                  const Vector& rho) {
  if (shape.shape.kind == model::ShapeKind::dihedral) return alpha - shape.shape.near;
  if (!counts_turns(shape)) return 0;
  return alpha - middle_of(shape, turn_between(system, shape, z, rho));
}

double value_of(const System& system, const PointShape& shape, const Vector& z, const Vector& rho) {
  Vector positions(3 * std::ssize(shape.points));
  for (std::size_t a = 0; a < shape.points.size(); ++a)
    positions.segment<3>(3 * static_cast<Index>(a)) = position_of(system, shape.points[a], z, rho);
  model::ShapeValue<double> at;
  model::evaluate_shape<double>(shape.shape, positions, at);
  return counts_turns(shape) ? counted(shape, at.value, turn_between(system, shape, z, rho))
                             : at.value;
}

/// Where the spring of a switch stands: its joint's coordinate, or its own part of alpha.
double place_of(const System& system, const Switch& s, const Vector& z, const Vector& rho) {
  if (!s.of_shape()) return z[s.coordinate];
  const PointShape& shape = system.shapes[s.spring];
  return own_part(shape, value_of(system, shape, z, rho), z);
}

}  // namespace

bool is_smooth_at_edge(const PointShape& shape, double alpha) {
  if (shape.gas || shape.is_pressure() || shape.inner_count > 0) return false;
  const auto edge = model::edge_of(shape.shape, shape.points.size(), alpha);
  return edge && slopes_about_edge(shape.law, shape.law.segment_at(alpha), *edge, edge->at);
}

void count_turns_from(const Vector& z, System& system) {
  for (PointShape& shape : system.shapes)
    if (counts_turns(shape)) shape.turned = turn_between(system, shape, z, system.commands);
}

void add_shape_terms(const System& system, const Piece& piece, const Vector& z,
                     const Inputs& inputs, Workspace& work, Vector& residual, Matrix* A,
                     Matrix* dR_drho) {
  for (const PointShape& shape : system.shapes) {
    evaluate(system, shape, z, inputs.rho, work);
    const double own = own_part(shape, work.shape.at.value, z);
    const std::size_t segment = segment_of(shape, piece);
    const auto at_edge = slopes_at_edge(shape, segment, work);
    const AlphaSlopes slopes = at_edge ? *at_edge : slopes_in(shape, segment, own, inputs.loads);
    Term{system, shape, work, slopes}.add(residual, A, dR_drho);
  }
}

void add_pressure_rate(const System& system, const Vector& z, const Vector& rho,
                       const Vector& rates, Workspace& work, Vector& rate) {
  for (const PointShape& shape : system.shapes) {
    if (!shape.is_pressure() || rates[shape.load] == 0) continue;
    evaluate(system, shape, z, rho, work);
    Term{system, shape, work, {-rates[shape.load] * shape.pressure, 0}}.add(rate, nullptr, nullptr);
  }
}

namespace {

/// @param segment  of a shape, at its own part of alpha
template <class SegmentOf>
double energy_of_shapes(const System& system, const Vector& z, const Vector& rho,
                        const SegmentOf& segment) {
  double energy = 0;
  for (const PointShape& shape : system.shapes) {
    if (shape.is_pressure()) continue;
    const double own = own_part(shape, value_of(system, shape, z, rho), z);
    energy += energy_in(shape, segment(shape, own), own, {});
  }
  return energy;
}

template <class SegmentOf>
ShapeState state_of(const System& system, const PointShape& s, const Vector& z,
                    const Inputs& inputs, const SegmentOf& segment) {
  const double alpha = value_of(system, s, z, inputs.rho), own = own_part(s, alpha, z);
  return {alpha, slopes_in(s, segment(own), own, inputs.loads).slope, own,
          off_middle(system, s, alpha, z, inputs.rho)};
}

}  // namespace

ShapeState shape_state(const System& system, std::size_t shape, const Vector& z,
                       const Inputs& inputs) {
  const PointShape& s = system.shapes[shape];
  return state_of(system, s, z, inputs, [&s](double own) { return s.law.segment_at(own); });
}

ShapeState shape_state(const System& system, const Piece& piece, std::size_t shape, const Vector& z,
                       const Inputs& inputs) {
  const PointShape& s = system.shapes[shape];
  return state_of(system, s, z, inputs, [&](double) { return segment_of(s, piece); });
}

double series_energy(const System& system, std::size_t shape, const Vector& z) {
  const PointShape& s = system.shapes[shape];
  double energy = 0;
  for (const CoordinateSpring& spring : system.springs)
    if (spring.coordinate >= s.inner && spring.coordinate < s.inner + s.inner_count) {
      const double u = z[spring.coordinate];
      energy += spring.law.energy(spring.law.segment_at(u), u);
    }
  return energy;
}

double shape_energy(const System& system, const Vector& z, const Vector& rho) {
  return energy_of_shapes(system, z, rho, [](const PointShape& shape, double own) {
    return shape.law.segment_at(own);
  });
}

double shape_energy(const System& system, const Piece& piece, const Vector& z, const Vector& rho) {
  return energy_of_shapes(system, z, rho, [&piece](const PointShape& shape, double) {
    return segment_of(shape, piece);
  });
}

double pressure_potential(const System& system, const Vector& z, const Inputs& inputs) {
  double potential = 0;
  for (const PointShape& shape : system.shapes)
    if (shape.is_pressure())
      potential += energy_in(shape, 0, value_of(system, shape, z, inputs.rho), inputs.loads);
  return potential;
}

double switch_value(const System& system, std::size_t number, const Vector& z, const Vector& rho) {
  const Switch& s = system.switches[number];
  return place_of(system, s, z, rho) - s.breakpoint;
}

void put_switch_values(const System& system, std::size_t first, const Vector& z, const Vector& rho,
                       Vector& values) {
  double place = 0;
  for (std::size_t j = first; j < system.switches.size(); ++j) {
    const Switch& s = system.switches[j];
    if (j == first || !same_spring(s, system.switches[j - 1])) place = place_of(system, s, z, rho);
    values[static_cast<Index>(j)] = place - s.breakpoint;
  }
}

bool switch_gradient(const System& system, std::size_t number, const Vector& z, const Vector& rho,
                     SwitchGradient& out) {
  const Switch& s = system.switches[number];
  out.z.setZero(system.size);
  out.rho.setZero(rho.size());
  if (!s.of_shape()) {
    out.z[s.coordinate] = 1;
    return true;
  }
  const PointShape& shape = system.shapes[s.spring];
  evaluate(system, shape, z, rho, out.work);
  const double alpha = out.work.shape.at.value;
  const auto edge = model::edge_of(shape.shape, shape.points.size(), alpha);
  if (edge && alpha == edge->at) return shape.inner_count == 0;  // equally steep in all directions
  Index i = 0;
  for (const std::size_t point : shape.points) {
    const PointSlice& slice = system.points[point];
    for (std::size_t k = 0; k < slice.z.size(); ++k, ++i) {
      const double slope = out.work.shape.slopes[i];
      if (slice.z[k] >= 0) out.z[slice.z[k]] += slope;
      if (slice.rho[k] >= 0) out.rho[slice.rho[k]] += slope;
    }
  }
  out.z.segment(shape.inner, shape.inner_count).setConstant(-1);
  return out.z.allFinite() && out.rho.allFinite();
}

}  // namespace springfold::statics
