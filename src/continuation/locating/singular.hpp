// Limit points, branch points and touches on one step. Private to the engine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "continuation/locating/tested_step.hpp"
#include "continuation/points/arc.hpp"
#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// All smooth special points on a step between two points of one piece, in order.
struct StepEvents {
  std::vector<Hit> hits{};
  std::string doubt{};   ///< set: something happens here that these hits do not explain;
                         ///< a shorter step may separate it
  int unexplained = 0;   ///< with a doubt: how many eigenvalues change sign unexplained
  bool passing = false;  ///< with a doubt: branches pass each other closely; the curve turns aside
  bool flat = false;  ///< with a doubt: lambda stands still to rounding; shorter steps do not help
  bool of_caller = false;  ///< with a doubt: it is about an event of the caller
};

/// May a branch leave along this null vector?
using LeadsOn = std::function<bool(const CurvePoint& at, const Direction& null)>;

/// Finds every zero of the tangent's lambda-component and of the eigenvalues of dF/dx between the
/// samples of one step and puts them together: an eigenvalue and the tangent vanish at a limit
/// point, an eigenvalue alone at a branch point, the tangent with an eigenvalue that does not change
/// sign where the branch itself turns at a branch point; a zero without change of sign is a touch.
/// @param arc      the step
/// @param samples  its ends and points between them, in order; all on one piece
/// @param leads_on  singular points of one mode at which it says no are passed over; empty: all count
StepEvents singular_points(const TestedStep& arc, Samples samples, const LeadsOn& leads_on = {});

/// Rates of lambda this many times their rounding have a sign beyond doubt.
inline constexpr double clear_of_rounding = 100;

/// A regular step of the curve, as long as need be, on which lambda's rate rises clear of its rounding on
/// both sides of a shorter one: it is given by the curve, not by the length of the shorter step.
struct WideStep {
  CurvePoint from{}, to{};
};

/// @param noise  rounding of lambda's rate
/// @returns nothing where lambda stands still for longer than a regular step can be, or the evidence for a step
/// is missing
std::optional<WideStep> widened(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                                double noise);

/// Zeros of lambda's rate on the widened step, those of them that lie between `from` and `high` beyond
/// it; places as distances from `from` along its tangent.
/// @returns nothing where there is no such step or its zeros are too close together
std::optional<std::vector<ZeroOf>> turns_on_widened(const Walker& walker, const CurvePoint& from,
                                                    const CurvePoint& to, double high,
                                                    double noise);

}  // namespace springfold::continuation
