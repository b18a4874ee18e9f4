// What happens where a curve meets a switching surface. Private to the engine.
#pragma once

#include <string>
#include <vector>

#include "springfold/continuation/kink.hpp"

namespace springfold::continuation {

/// The tracer's whole memory between two steps.
struct Progress {
  CurvePoint here{};
  std::vector<Index> left{};  ///< switches that are zero at `here` and being left
  double ds = 0;
};

enum class Outcome { go_on, shorten, stop };

/// Names of switches for messages, with commas between them.
std::string names_of(ProblemView problem, const std::vector<Index>& switches);

/// The point `at` as the begin of a ray: its tangent, piece and number of negative eigenvalues.
CurvePoint point_on_ray(const Walker& walker, const CurvePoint& at, const Ray& ray);

/// At a switching surface: finds the ways out, records the kink, and goes on if there is one way.
Outcome pass_kink(const Walker& walker, const KinkSearch& kink, Progress& progress, Curve& curve);

}  // namespace springfold::continuation
