// What a shape is measured in. Private to analysis.
#pragma once

#include <cmath>
#include <string>

#include "scales.hpp"
#include "springfold/analysis/result.hpp"

namespace springfold::analysis {

/// alpha is a length to this power.
constexpr int length_power(model::ShapeKind kind) {
  switch (kind) {
    case model::ShapeKind::angle:
    case model::ShapeKind::dihedral:
      return 0;
    case model::ShapeKind::path:
    case model::ShapeKind::line:
    case model::ShapeKind::plane:
      return 1;
    case model::ShapeKind::area:
      return 2;
    case model::ShapeKind::volume:
      return 3;
  }
  return 0;
}

/// Unit of alpha, and of an energy per alpha: powers of two as the scales are.
inline double unit_of_value(model::ShapeKind kind, const Scales& scales) {
  return std::pow(scales.length, length_power(kind));
}
inline double unit_of_force(model::ShapeKind kind, const Scales& scales) {
  return scales.moment() / unit_of_value(kind, scales);
}

/// The two columns of a spring of a shape: ".length" and ".force" of a path.
struct ShapeColumn {
  std::string name{};
  Unit unit = Unit::none;
  double sign = 1;  ///< of dU/dalpha
};
inline ShapeColumn value_column(model::ShapeKind kind) {
  switch (kind) {
    case model::ShapeKind::path:
      return {"length", Unit::length};
    case model::ShapeKind::line:
    case model::ShapeKind::plane:
      return {"distance", Unit::length};
    case model::ShapeKind::angle:
    case model::ShapeKind::dihedral:
      return {"angle", Unit::angle};
    case model::ShapeKind::area:
      return {"area", Unit::area};
    case model::ShapeKind::volume:
      return {"volume", Unit::volume};
  }
  return {};
}
/// Unit of an unknown of the equilibrium.
inline Unit unit_of_unknown(const statics::System& system, Index i) {
  const auto k = static_cast<std::size_t>(i);
  if (system.is_wrench[k]) return system.is_length[k] ? Unit::force : Unit::moment;
  for (const statics::PointShape& shape : system.shapes)
    if (i >= shape.inner && i < shape.inner + shape.inner_count)
      return value_column(shape.shape.kind).unit;
  return system.is_length[k] ? Unit::length : Unit::angle;
}
inline ShapeColumn force_column(model::ShapeKind kind) {
  switch (kind) {
    case model::ShapeKind::path:
    case model::ShapeKind::line:
    case model::ShapeKind::plane:
      return {"force", Unit::force};
    case model::ShapeKind::angle:
    case model::ShapeKind::dihedral:
      return {"moment", Unit::moment};
    case model::ShapeKind::area:
      return {"pressure", Unit::stiffness, -1};  // force per length
    case model::ShapeKind::volume:
      return {"pressure", Unit::pressure, -1};
  }
  return {};
}

}  // namespace springfold::analysis
