// Requirements as inequalities g <= 0 with their derivatives. Private to analysis.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "design_modes.hpp"
#include "design_path.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::analysis {

/// How a critical requirement is met: the unwanted point comes late enough, or the path climbs all the way. The union
/// of both is what is asked; each alone is smooth.
enum class Way { late, climbing };

/// What the requirements say of one design.
struct Assessment {
  std::vector<FoundRequirement> requirements{};  ///< reached values in `after`; `holds` is set
  Vector g{};                                    ///< scaled: <= 0 holds
  /// By the parameters [1/unit of the case]. Rows that are not defined, as beside a place where branches of the path
  /// cross, say nothing of g.
  Matrix dg{};
  std::vector<std::size_t> of{};  ///< per inequality: its requirement
};

/// Violations up to this are rounding, in the scale of each requirement.
inline constexpr double design_tolerance = 1e-9;

/// A design whose path is traced: all ways of meeting its requirements are judged by it.
struct TracedDesign {
  Vector values{};
  DesignPath path;
  /// Per critical requirement; nothing: its stability is lost at the start.
  std::vector<std::optional<FirstModes>> modes{};
};

/// The requirements of a study for its designs.
class Requirements {
 public:
  explicit Requirements(const Study& study);

  const DesignCase& designs() const { return case_; }
  /// Traces the path of a design. @returns nothing where it has no start: `why` says it
  std::unique_ptr<TracedDesign> trace(const Vector& values, const Observer& observer,
                                      std::string& why) const;
  /// @param ways  one per critical requirement
  /// @returns nothing where it cannot be judged: `why` says it
  std::optional<Assessment> assess(const TracedDesign& design, const std::vector<Way>& ways,
                                   std::string& why) const;
  /// Is anything asked of the path, and not of starts alone?
  bool needs_path() const { return needs_path_; }
  /// Names and wanted values, nothing reached.
  std::vector<FoundRequirement> unknown() const;

 private:
  struct Sheet;
  bool add_critical(const TracedDesign& design, const std::vector<Way>& ways, Sheet& sheet) const;
  bool add_curve(const DesignPath& path, Sheet& sheet) const;
  bool add_constant(const DesignPath& path, Sheet& sheet) const;
  bool add_stiffness(const DesignPath& path, const Vector& values, Sheet& sheet) const;

  const DesignSettings settings_;
  DesignCase case_{};
  bool needs_path_ = false;
};

}  // namespace springfold::analysis
