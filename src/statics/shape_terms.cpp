#include "shape_terms.hpp"

#include <cassert>

#include "point_terms.hpp"

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

/// The angle nearest to `near`, which moves with the frames of the two rays.
double counted(const PointShape& shape, double angle, double turned) {
  return model::detail::nearest_angle<double>(angle, shape.shape.near + turned - shape.turned);
}

/// Motions of the points, alpha, and its derivatives by their variables.
void evaluate(const System& system, const PointShape& shape, const Vector& z, const Vector& rho,
              Workspace& work) {
  work.points.resize(system.points.size());
  Workspace::Shape& out = work.shape;
  out.positions.resize(3 * std::ssize(shape.points));
  Index count = 0;
  for (std::size_t a = 0; a < shape.points.size(); ++a) {
    Workspace::Point& point = work.points[shape.points[a]];
    evaluate_point(system, shape.points[a], z, rho, point);
    out.positions.segment<3>(3 * static_cast<Index>(a)) = point.at.pose.p;
    count += point.at.dp.cols();
  }
  model::evaluate_shape<double>(shape.shape, out.positions, out.at);
  if (counts_turns(shape))
    out.at.value =
        counted(shape, out.at.value,
                turn_of(work.points[shape.points[2]]) - turn_of(work.points[shape.points[0]]));
  out.slopes.resize(count);
  Index first = 0;
  for (std::size_t a = 0; a < shape.points.size(); ++a) {
    const auto& dp = work.points[shape.points[a]].at.dp;
    const Vec3<double> g = out.at.gradient.segment<3>(3 * static_cast<Index>(a));
    for (Index j = 0; j < dp.cols(); ++j) out.slopes[first + j] = g.dot(dp.col(j));
    first += dp.cols();
  }
}

double factor_of(const PointShape& shape, const Vector& factors) {
  return factors.size() == 0 ? 1 : factors[shape.load];
}

/// Derivatives by alpha. The energy itself is left out: that of a formula is a quadrature.
struct AlphaSlopes {
  double slope = 0, curvature = 0;
};

AlphaSlopes slopes_in(const PointShape& shape, std::size_t segment, double alpha,
                      const Vector& factors) {
  if (shape.is_pressure()) return {-factor_of(shape, factors) * shape.pressure, 0};
  if (!shape.gas) return {shape.law.torque(segment, alpha), shape.law.stiffness(segment, alpha)};
  const ShapeEnergy gas = energy_of(*shape.gas, alpha);
  return {gas.slope, gas.curvature};
}

double energy_in(const PointShape& shape, double alpha, const Vector& factors) {
  if (shape.is_pressure()) return -factor_of(shape, factors) * shape.pressure * alpha;
  return shape.gas ? energy_of(*shape.gas, alpha).energy
                   : shape.law.energy(shape.law.segment_at(alpha), alpha);
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
    if (A == nullptr) return;
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

double value_of(const System& system, const PointShape& shape, const Vector& z, const Vector& rho) {
  Vector positions(3 * std::ssize(shape.points));
  for (std::size_t a = 0; a < shape.points.size(); ++a)
    positions.segment<3>(3 * static_cast<Index>(a)) = position_of(system, shape.points[a], z, rho);
  model::ShapeValue<double> at;
  model::evaluate_shape<double>(shape.shape, positions, at);
  return counts_turns(shape) ? counted(shape, at.value, turn_between(system, shape, z, rho))
                             : at.value;
}

}  // namespace

void count_turns_from(const Vector& z, System& system) {
  for (PointShape& shape : system.shapes)
    if (counts_turns(shape)) shape.turned = turn_between(system, shape, z, system.commands);
}

void add_shape_terms(const System& system, const Piece& piece, const Vector& z,
                     const Inputs& inputs, Workspace& work, Vector& residual, Matrix* A,
                     Matrix* dR_drho) {
  for (const PointShape& shape : system.shapes) {
    evaluate(system, shape, z, inputs.rho, work);
    const AlphaSlopes slopes =
        slopes_in(shape, segment_of(shape, piece), work.shape.at.value, inputs.loads);
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

ShapeState shape_state(const System& system, std::size_t shape, const Vector& z,
                       const Inputs& inputs) {
  const PointShape& s = system.shapes[shape];
  const double alpha = value_of(system, s, z, inputs.rho);
  return {alpha, slopes_in(s, s.law.segment_at(alpha), alpha, inputs.loads).slope};
}

double shape_energy(const System& system, const Vector& z, const Vector& rho) {
  double energy = 0;
  for (const PointShape& shape : system.shapes) {
    if (shape.is_pressure()) continue;
    energy += energy_in(shape, value_of(system, shape, z, rho), {});
  }
  return energy;
}

double pressure_potential(const System& system, const Vector& z, const Inputs& inputs) {
  double potential = 0;
  for (const PointShape& shape : system.shapes)
    if (shape.is_pressure())
      potential += energy_in(shape, value_of(system, shape, z, inputs.rho), inputs.loads);
  return potential;
}

double switch_value(const System& system, std::size_t number, const Vector& z, const Vector& rho) {
  const Switch& s = system.switches[number];
  if (!s.of_shape()) return z[s.coordinate] - s.breakpoint;
  return value_of(system, system.shapes[s.spring], z, rho) - s.breakpoint;
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
  Index i = 0;
  for (const std::size_t point : shape.points) {
    const PointSlice& slice = system.points[point];
    for (std::size_t k = 0; k < slice.z.size(); ++k, ++i) {
      const double slope = out.work.shape.slopes[i];
      if (slice.z[k] >= 0) out.z[slice.z[k]] += slope;
      if (slice.rho[k] >= 0) out.rho[slice.rho[k]] += slope;
    }
  }
  return out.z.allFinite() && out.rho.allFinite();
}

}  // namespace springfold::statics
