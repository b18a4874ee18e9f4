// Formulas over named parameters. Keeps muParser out of everything else.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace springfold::io {

using FormulaId = std::size_t;

/// Letters, digits and '_', not beginning with a digit.
bool is_identifier(std::string_view name);

/// Names that formulas keep for themselves: pi, deg and the functions.
bool is_formula_word(std::string_view name);

/// What is said where a formula has **, or calls pow.
inline constexpr const char* power_is_written = "a power is written ^, as in u^3";

/// All formulas of a case, compiled once, over one list of variables.
/// Numbers are written with '.', whatever the locale.
class FormulaBook {
 public:
  explicit FormulaBook(std::vector<std::string> variables);
  FormulaBook(FormulaBook&&) noexcept;
  FormulaBook& operator=(FormulaBook&&) noexcept;
  ~FormulaBook();

  const std::vector<std::string>& variables() const;

  struct Added {
    std::optional<FormulaId> id{};
    std::string problem{};  ///< why it cannot be used, if there is no id
  };
  /// The same text is compiled once only.
  Added add(const std::string& text);

  /// Numbers of the variables that the formula names, increasing.
  const std::vector<std::size_t>& variables_of(FormulaId id) const;

  /// Value with the given variables; infinite or NaN where arithmetic has no result (1/0).
  /// May be called from several threads.
  double value(FormulaId id, const std::vector<double>& variables) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace springfold::io
