// A point of a load path of the planar Orthoglide and what it takes to walk on from there.
#pragma once

#include <cmath>

#include "continuation/points/step.hpp"
#include "load_path.hpp"
#include "orthoglide.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::bench {

/// The force lambda along the diagonal, at lambda = 0.05.
struct Walk {
  LoadPath path{orthoglide(), Vector::Constant(2, std::sqrt(0.5))};
  continuation::Walker walker{path, path.metric(), {}};
  continuation::CurvePoint from{};

  Walk() {
    const auto start = statics::first_equilibrium(
        path.system, {.z = statics::guess(path.system), .inputs = path.inputs(0.05)});
    from.x = start.z;
    from.lambda = 0.05;
    const auto rays = continuation::rays_from(path, from.x, from.lambda, {}, {});
    from.tangent = rays.rays.front().tangent;
  }
  Walk(const Walk&) = delete;  // the walker looks at this object's path
  Walk& operator=(const Walk&) = delete;
};

}  // namespace springfold::bench
