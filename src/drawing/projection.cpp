#include "projection.hpp"

#include <algorithm>

namespace springfold::drawing {
namespace {

using Vec = model::Vec3<double>;

Vec out_of(const View& view) { return model::cross<double>(view.right, view.up); }

/// How much larger a point looks than the middle. What is nearly as near as the eye is shown as a little farther.
double nearness(const Sheet& sheet, const Vec& from_middle) {
  if (!(sheet.eye > 0)) return 1;
  constexpr double nearest = 0.1;  // of the distance of the eye
  return sheet.eye / std::max(nearest * sheet.eye, sheet.eye - out_of(sheet.view).dot(from_middle));
}

}  // namespace

Place seen_at(const Sheet& sheet, const Vec& p) {
  const Vec from_middle = p - sheet.middle;
  const double near = nearness(sheet, from_middle);
  return {near * sheet.view.right.dot(from_middle) - sheet.shift.x,
          near * sheet.view.up.dot(from_middle) - sheet.shift.y};
}

Place seen_step(const Sheet& sheet, const Vec& p, const Vec& way) {
  const Vec from_middle = p - sheet.middle;
  const double near = nearness(sheet, from_middle);
  // d(near) = near^2 / eye * (how far it comes nearer)
  const double grows = sheet.eye > 0 ? near * near / sheet.eye * out_of(sheet.view).dot(way) : 0;
  return {near * sheet.view.right.dot(way) + grows * sheet.view.right.dot(from_middle),
          near * sheet.view.up.dot(way) + grows * sheet.view.up.dot(from_middle)};
}

Vec towards_eye(const Sheet& sheet, const Vec& p) {
  const Vec out = out_of(sheet.view);
  return sheet.eye > 0 ? Vec(sheet.eye * out - (p - sheet.middle)) : out;
}

}  // namespace springfold::drawing
