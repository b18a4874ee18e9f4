#include "continuation/following/many_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "continuation/points/words.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// The reason for which steps were refused most often from a place on, without the numbers in it.
std::string most_frequent_reason(const Curve& curve, double from) {
  std::map<std::string, int> counts;
  std::string most;
  for (const StepNote& note : curve.log) {
    if (note.s < from || note.reason.starts_with("cut: ")) continue;
    const std::string reason = note.reason.substr(0, note.reason.find_first_of("0123456789"));
    if (const int count = ++counts[reason]; most.empty() || count > counts[most]) most = reason;
  }
  while (!most.empty() && most.back() == ' ') most.pop_back();
  return most;
}

}  // namespace

std::string why_so_many(const Walker& walker, const Curve& curve) {
  const std::size_t n = curve.points.size(), first = (n - 1) - (n + 2) / 4;
  const CurvePoint &from = curve.points[first], &to = curve.points.back();
  const double length = to.s - from.s,
               step = length / std::max<double>(1, static_cast<double>(n - 1 - first));
  double by_lambda = 0;
  for (std::size_t i = first; i + 1 < n; ++i)
    by_lambda += std::abs(curve.points[i + 1].lambda - curve.points[i].lambda);
  const std::string far =
      std::to_string(n) + " points over an arc length of " + rounded(to.s) + "; ";
  const std::string more = "maximum_points allows more";
  if (step < walker.options.step.maximum / 3) {
    const std::string reason = most_frequent_reason(curve, from.s);
    return far + "the last steps were " + rounded(step) + " long" +
           (reason.empty() ? "" : ", shortened most often by \"" + reason + "\"") + ": " + more +
           ", a limit of the range ends the curve earlier";
  }
  constexpr double alone = 1 - negligible_share;
  const bool lambda_alone = by_lambda > alone * length;
  return far + "the last steps had full length" +
         (lambda_alone ? ", and hardly anything but lambda changed on them" : "") +
         ", the curve goes on: " + more + ", maximum_step longer steps, a limit of the range" +
         (lambda_alone ? " of lambda" : "") + " ends it";
}

}  // namespace springfold::continuation
