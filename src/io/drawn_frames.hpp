// Where the frames of bodies stand as a case draws them, as formulas: patterns turn what stands in them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "toml_reader.hpp"

namespace springfold::io {

/// One formula for every direction, "(0)" where there is nothing to reckon.
using Formulas = std::array<std::string, 3>;

inline constexpr const char* zero_formula = "(0)";

/// Three times zero.
Formulas no_shift();
bool is_zero(const Formulas& vector);

/// A number or formula as a formula of parameters alone; empty: it is neither.
std::string formula_of(const Node& node, const Bindings& bindings);

/// An axis of a pattern: a direction of the base through a point.
struct PatternAxis {
  std::size_t letter = 2;  ///< x, y, z
  bool negative = false;
  Formulas centre = no_shift();  ///< along the axis it does not matter
};

/// The vector turned about the axis' direction by an angle.
Formulas turned(const Formulas& vector, const PatternAxis& axis, const std::string& angle);
Formulas difference(const Formulas& a, const Formulas& b);
Formulas sum(const Formulas& a, const Formulas& b);

/// How a copy of a pattern came about. Two things with the same turn go together.
struct CopyTurn {
  std::string angle{};  ///< that of the copy, as a formula
  PatternAxis axis{};
};
bool go_together(const CopyTurn& a, const CopyTurn& b);

/// A frame in the base: its origin, and its angle about an axis.
struct DrawnFrame {
  Formulas at = no_shift();
  std::string angle = zero_formula;
};

/// Bodies, nodes and chains of a case, in which all repetitions are written out, by their names.
class DrawnParts {
 public:
  /// Bodies and nodes of a document. @pre it lives as long
  void add(const Node& root);
  void add_turned(const std::string& name, const CopyTurn& turn) { turned_[name] = turn; }

  enum class Kind { base, point, body, chain, unknown };
  /// A point keeps the directions of the base.
  Kind kind_of(const std::string& name) const;
  /// Was it turned as this copy is? @param name  "leg.knee": the chain
  bool was_turned_so(const std::string& name, const CopyTurn& turn) const;
  bool has_pose(const std::string& name) const;
  /// The only one that moves; empty: there are several.
  std::string only_one() const { return moving_.size() == 1 ? moving_.front() : std::string{}; }
  /// Origin 0 where no pose is given. @returns nothing where it is no list, or turns about another axis
  std::optional<DrawnFrame> frame_of(const std::string& name, const PatternAxis& axis) const;

 private:
  const Node* pose_of(const std::string& name) const;

  std::map<std::string, const Node*> bodies_{}, nodes_{};
  std::map<std::string, CopyTurn> turned_{};
  std::vector<std::string> moving_{};
};

}  // namespace springfold::io
