// Spring laws whose numbers are still formulas.
#pragma once

#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "numbers.hpp"
#include "springfold/model/spring_law.hpp"

namespace springfold::io {

/// from_start: coordinates are counted from that of the start pose.
struct LinearDraft {
  NumberId stiffness = 0, free = 0;
  bool from_start = false, falling = false;
};
struct OneSidedDraft {
  NumberId stiffness = 0, from = 0;
  model::OneSidedSpring::Side side = model::OneSidedSpring::Side::above;
  bool from_start = false;
};
struct PiecewiseLinearDraft {
  std::vector<NumberId> breakpoints{}, stiffnesses{};
  NumberId free = 0, preload = 0;
  bool from_start = false, falling = false;
};
/// Free play between low and high, a linear spring outside.
struct GapDraft {
  NumberId stiffness = 0, low = 0, high = 0;
  bool from_start = false;
};
/// A linear spring everywhere, a second one added below low and above high.
struct StopsDraft {
  NumberId stiffness = 0, free = 0, stop_stiffness = 0, low = 0, high = 0;
  bool from_start = false;
};
/// Points, joined by cubics or by straight lines.
struct TableDraft {
  std::vector<NumberId> deformations{}, torques{};
  NumberId free = 0;
  bool from_start = false, falling = false, straight = false;
};
struct PolynomialDraft {
  std::vector<NumberId> coefficients{};
  NumberId free = 0, low = 0, high = 0;
  bool from_start = false, falling = false;
};
struct FormulaDraft {
  model::Formula formula{};
  std::vector<std::pair<std::size_t, NumberId>> numbers{};  ///< of steps of the formula
  NumberId free = 0, low = 0, high = 0;
  bool from_start = false, falling = false;
};
/// Without a length: that of the bar whose law it is.
struct LogarithmicDraft {
  NumberId stiffness = 0;
  std::optional<NumberId> length{};
  NumberId free = 0;
  bool from_start = false;
};
struct PowerDraft {
  NumberId force = 0, depth = 0, exponent = 0, from = 0;
  bool from_start = false, below = false;
};
using SpringDraft =
    std::variant<LinearDraft, OneSidedDraft, PiecewiseLinearDraft, GapDraft, StopsDraft, TableDraft,
                 PolynomialDraft, FormulaDraft, LogarithmicDraft, PowerDraft>;

/// @param numbers  values of the table that the draft's ids belong to
/// @param length   of a bar: that of a logarithmic law which has none of its own
model::SpringLaw law_of(const SpringDraft& spring, const std::vector<double>& numbers,
                        double length = 1);

}  // namespace springfold::io
