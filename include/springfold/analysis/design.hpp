// Designs that meet requirements: what a study of kind `design` is asked, and what it answers. Units of the case.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "springfold/analysis/critical.hpp"
#include "springfold/core/types.hpp"

namespace springfold::analysis {

/// A parameter of the case that the search may change.
struct DesignParameter {
  std::string name{};
  double low = 0, high = 0;  ///< bounds, both finite
  double unit =
      0;  ///< changes are counted in it; 0: the size of the value in the case, or high - low if that is 0
};

/// On the path from the start no unwanted point comes before `quantity` reaches `at_least`.
struct CriticalRequirement {
  std::string name{};  ///< "critical_load", "no_limit_point"
  std::string quantity = "lambda";
  double at_least =
      std::numeric_limits<double>::infinity();  ///< infinite: there is none on the whole path
  Unwanted unwanted = Unwanted::limit_point;
  StabilityOf stability = StabilityOf::control;
};

/// The curve passes within `tolerance` of given points (x, y) of two columns, first passage.
struct CurveRequirement {
  std::string x = "deflection", y = "force";
  std::vector<std::pair<double, double>> points{};
  double tolerance = 0;  ///< of y, absolute, > 0
};

/// A column stays within a part of its mean while another one goes from `from` to `to`.
struct ConstantRequirement {
  std::string quantity = "force", along = "deflection";
  double from = 0, to = 0;  ///< from < to
  double within = 0;        ///< largest distance from the mean, as a part of it, > 0
  double mean_at_least = -std::numeric_limits<double>::infinity();
};

/// A column is at least so large at the start, where another column has a value, or at the start from another pose.
struct StiffnessRequirement {
  std::string quantity = "stiffness";
  std::optional<std::pair<std::string, double>> at{};  ///< column and value, first passage
  Vector pose{};  ///< of the study's body, in place of start.pose; empty: the study's own start
  double at_least = 0;
};

/// What is small: the root of the sum of the squares of the relative changes, or the sum of their sizes.
enum class ChangeNorm { norm, sum };

struct DesignSettings {
  std::vector<DesignParameter> parameters{};
  std::vector<CriticalRequirement> critical{};
  std::optional<CurveRequirement> curve{};
  std::optional<ConstantRequirement> constant{};
  std::vector<StiffnessRequirement> stiffness{};
  ChangeNorm changes = ChangeNorm::norm;
  int starts = 8;  ///< of the search: the case itself first, then points of a Halton sequence
};

enum class DesignStatus {
  met_at_start,   ///< the case meets all requirements as it is
  met,            ///< a design was found that meets them
  cannot_be_met,  ///< no start of the search led to one; the nearest miss is the answer
  unresolved,     ///< paths could not be followed, or the search was interrupted
};

/// "met at the start", "met", "cannot be met", "unresolved".
std::string_view to_string(DesignStatus status);

enum class BoundState { free, at_low, at_high };

struct FoundParameter {
  std::string name{};
  double before = 0, after = 0, low = 0, high = 0;
  double change = 0;  ///< in units of DesignParameter::unit
  BoundState bound = BoundState::free;
};

struct FoundRequirement {
  std::string
      name{};  ///< "critical_load", "curve.2", "constant.mean", "constant.deviation", "stiffness.1", ...
  double wanted = 0;
  double before = 0, after = 0;  ///< infinite: there is no such point on the path; NaN: not known
  bool is_upper = false;         ///< at most `wanted`; otherwise at least
  double tolerance = 0;          ///< of a point of a curve: reached within it
  bool holds = false;            ///< after
  bool limits = false;           ///< it decides the answer
  double multiplier = 0;  ///< d(objective) by its scaled requirement; 0 where it does not limit
};

/// The answer of a study of kind `design`.
struct DesignReport {
  DesignStatus status = DesignStatus::unresolved;
  std::vector<FoundParameter> parameters{};
  std::vector<FoundRequirement> requirements{};
  double change = 0;      ///< size of all changes in the norm of the settings
  bool verified = false;  ///< traced again at the answer, and all requirements hold there
  double optimality =
      0;  ///< residual of the conditions of Karush, Kuhn and Tucker, relative; NaN: not known
  int designs = 0;        ///< designs whose paths were traced
  std::string message{};  ///< the answer as a sentence
  std::vector<std::string>
      limits{};  ///< what decides: requirements, and bounds "Kv at its upper bound"
};

/// Names of the answer's numbers for expected values: "design.Kv", "design.critical_load", "design.change",
/// "design.met", "design.verified", "design.limits.Kv", ...
std::vector<std::string> design_quantities(const DesignSettings& settings);

/// One of them; nothing if there is none of this name. `met` and `verified` are 1 or 0; `limits` is 1 where a
/// requirement or an upper bound decides, -1 for a lower bound, 0 where neither does.
std::optional<double> design_value(const DesignReport& report, std::string_view name);

}  // namespace springfold::analysis
