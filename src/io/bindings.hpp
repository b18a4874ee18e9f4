// Names that stand for something within a part of a case: indices of repetitions, parameters of
// templates.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace springfold::io {

struct Binding {
  std::string name{};
  std::string text{};           ///< a number, a formula or a word
  std::optional<long> whole{};  ///< its value, if it is a whole number
};

/// Inner ones behind outer ones; of two with one name the last counts.
struct Bindings {
  std::vector<Binding> list{};

  const Binding* find(std::string_view name) const;
};

/// The formula with every bound name replaced by "(text)". Numbers ("2e3") and functions stay.
std::string with_bindings(const std::string& formula, const Bindings& bindings);

/// The name stands in the text as a word of its own, in braces or not.
bool mentions(std::string_view text, std::string_view name);

/// The text with `{name}` replaced by what it stands for and `{i + 1}` by its value: whole numbers,
/// bound names, + - * % and parentheses; a % b lies in 0 .. b - 1. Unbalanced braces, unknown names
/// and other arithmetic are problems.
struct FilledText {
  std::string text{};
  std::string problem{};  ///< what is wrong and needed; empty: nothing
};
FilledText filled(const std::string& text, const Bindings& bindings);

}  // namespace springfold::io
