#include "draw.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::known_answers {
namespace {

/// Does the curve itself, or another branch, pass nearby if two of these are close?
bool brings_neighbours(AnswerKind kind) {
  return kind != AnswerKind::touch && kind != AnswerKind::kink;
}

}  // namespace

void complete(Draw& draw) {
  std::erase_if(draw.answers, [&](const Answer& a) {
    return std::any_of(draw.limits.begin(), draw.limits.end(),
                       [&](const Limit& limit) { return !(limit.inside(a.z, a.lambda) > 0); });
  });
  for (Answer& a : draw.answers)
    for (const Answer& b : draw.answers) {
      if (&a == &b) continue;
      const double distance = std::hypot((a.z - b.z).norm(), a.lambda - b.lambda) / draw.size;
      a.separation = std::min(a.separation, distance);
      if (brings_neighbours(a.kind) && brings_neighbours(b.kind))
        draw.gap = std::min(draw.gap, distance);
    }
}

void limit_lambda(Draw& draw, double low, double high) {
  draw.limits.push_back({"low", [=](const Vector&, double lambda) { return lambda - low; }});
  draw.limits.push_back({"high", [=](const Vector&, double lambda) { return high - lambda; }});
}

void limit_unknown(Draw& draw, Index i, double low, double high) {
  draw.limits.push_back({"left", [=](const Vector& z, double) { return z[i] - low; }});
  draw.limits.push_back({"right", [=](const Vector& z, double) { return high - z[i]; }});
}

double smallest_separation(const Draw& draw) {
  double smallest = 1;
  for (const Answer& a : draw.answers) smallest = std::min(smallest, a.separation);
  return smallest;
}

}  // namespace springfold::known_answers
