// The numbers that the engine judges by, each by name and with its reason.
//
// Lengths are arc lengths, and lengths of unknowns against max(1, their size); matrices are judged against their size.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "springfold/continuation/options.hpp"
#include "springfold/core/rounding.hpp"
#include "springfold/core/types.hpp"

namespace springfold::continuation {

// What does rounding leave?
/// A correction shorter than this would be taken back by the next one; a direction that is shorter has no length.
inline constexpr double refined_step = 50 * rounding_unit;
/// Corrected points have some hundred units of rounding themselves: a model of the curve that is off by no more is
/// exact, and a rate below it has no sign.
inline constexpr double exact_model = 500 * rounding_unit;
/// What the corrector leaves of an equation of size one. Iterations settle to it, values of functions at corrected
/// points are rounding below it.
inline constexpr double residual_level = NewtonOptions{}.residual_tolerance;
/// What is measured at a few places may be this many times larger between them.
inline constexpr double between_samples = 10;
/// What residuals at their tolerance leave of a function along the curve, of its size.
inline constexpr double function_noise = between_samples * residual_level;
/// A double zero lies where its function is rounding over a way of about this length, the square root of the rounding
/// unit.
inline constexpr double root_of_rounding = 1e-8;
/// Is this error one that rounding leaves on a curve of this size?
inline bool is_exact(double error, double size) {
  return error <= exact_model * std::max(1.0, size);
}

// Is it converged?
/// Residuals and steps that are reduced to this share of the ones before are not yet at their least.
inline constexpr double still_falls = 0.1;
/// An iteration has settled when its step is fine, or when steps are small and no longer shrink, which is rounding.
inline bool has_settled(double moved, double before, double fine, double small) {
  constexpr double no_longer =
      0.3;  // above still_falls: the last contraction may have been a poor one
  return moved <= fine || (moved < small && moved > no_longer * before);
}
/// One step of an iteration: how far it went, and what is fine and what is small where it ended.
struct IterationStep {
  double moved = 0, fine = 0, small = 0;
};
/// Newton's method and its kin: steps are taken until they have settled.
/// @param step  takes one, told how far the last one went; returns nothing where the iteration is to be given up
/// @returns false where it is, or has not settled after `most` steps
template <class Step>
bool settles(int most, const Step& step) {
  double before = infinity;
  for (int i = 0; i < most; ++i) {
    const std::optional<IterationStep> taken = step(before);
    if (!taken) return false;
    if (has_settled(taken->moved, before, taken->fine, taken->small)) return true;
    before = taken->moved;
  }
  return false;
}

// Is it the same place?
/// Special points are promised to this.
inline constexpr double promised_place = 1e-10;
/// Along one curve nothing nearer than this is told apart: two places as good as promised, with room.
inline constexpr double one_place = 10 * promised_place;
/// Points that are nearer are one point: corrected on their own, beside singular points, they differ by some roots of
/// rounding.
inline constexpr double same_point = 1e-7;
/// Where rounding places a point worse than this, it is not resolved; and steps are not shortened below it.
inline constexpr double poor = 1e-6;
/// Zeros within this are examined as one point first: ten that rounding places poorly fit in.
inline constexpr double together = 10 * poor;
/// Special points that are nearer to each other than this arc length need not be told apart. A way that begins nearer
/// to its junction leads there as the reduced equation says, which was followed into the point; a trace may be lost in
/// rounding.
inline constexpr double told_apart = 1e-4;
/// Around a branch point corrected points are less exact: to both sides of a stretch that need not be told apart.
inline constexpr double blurred = 2 * told_apart;

// Is it the same direction?
/// Directions with a larger cosine are ways of one curve; the ways out of one point are further apart.
inline constexpr double same_way = 0.98;
/// Unit directions that differ by less are one.
inline constexpr double one_direction = 1e-6;
/// Is this the cosine of two unit directions of one line?
inline bool is_one_line(double cosine) {
  return std::abs(cosine) > 1 - one_direction * one_direction;
}
/// The same of a way and the direction in which a curve arrives at a singular point, where its tangent is known only
/// roughly.
inline constexpr double nearly_same_line = 1e-3;

// Is it level?
/// Rates along a unit tangent below this, of lambda or of a switch, are zero: tangents are as exact as points near
/// double zeros are.
inline constexpr double flat_rate = root_of_rounding;
/// Arc length over which lambda must stand still to be a family beyond a kink: an inflection that is flat to 1e-12 on
/// it would need a third derivative of lambda below 1e-5.
inline constexpr double level_reach = 1e-2;

// Which rank?
/// Singular values below this share vanish at points that are located as promised, with two orders to spare. At points
/// that may be placed poorly the share is `poor`, and a piece whose tangent is wanted to `one_place` is regular from
/// there.
inline constexpr double located_rank = 100 * promised_place;
/// How many singular values of a matrix with entries of size 1 vanish? They are descending; a gap parts them from the
/// others.
inline Index vanishing_values(const Vector& values, double share = poor) {
  constexpr double gap = 30;
  for (Index i = 0; i < values.size(); ++i)
    if (values[i] <= share && values[i] * gap < (i > 0 ? values[i - 1] : 1))
      return values.size() - i;
  return 0;
}

// How far may a model be believed?
/// Shares of a whole: one that does not decide, one that hardly counts, one that does not count even where much is
/// unknown.
inline constexpr double small_share = 0.1, negligible_share = 0.01, tiny_share = 0.001;
/// Shares of a step or of a radius: so far something may be off and still be near; so far away is aside.
inline constexpr double near_share = 0.3, aside_share = 0.2;

/// All of the above by name, for records of what a result was judged by.
struct NamedNumber {
  std::string_view name{};
  double value = 0;
};
inline constexpr NamedNumber numbers_judged_by[] = {
    {"refined_step", refined_step},
    {"exact_model", exact_model},
    {"residual_level", residual_level},
    {"between_samples", between_samples},
    {"function_noise", function_noise},
    {"root_of_rounding", root_of_rounding},
    {"still_falls", still_falls},
    {"promised_place", promised_place},
    {"one_place", one_place},
    {"same_point", same_point},
    {"poor", poor},
    {"together", together},
    {"told_apart", told_apart},
    {"blurred", blurred},
    {"same_way", same_way},
    {"one_direction", one_direction},
    {"nearly_same_line", nearly_same_line},
    {"flat_rate", flat_rate},
    {"level_reach", level_reach},
    {"located_rank", located_rank},
    {"small_share", small_share},
    {"negligible_share", negligible_share},
    {"tiny_share", tiny_share},
    {"near_share", near_share},
    {"aside_share", aside_share},
};

}  // namespace springfold::continuation
