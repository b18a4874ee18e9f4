// Names that stand for something within a part of a case: indices of repetitions, parameters of
// templates.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toml_reader.hpp"

namespace springfold::io {

/// A formula of the file that others are made of: a mistake in it is one at its place.
struct WrittenPart {
  std::string formula{};  ///< over the parameters alone
  std::string shown{};    ///< as written
  Place place{};
  std::string key{};   ///< empty: that of the number that is made of it
  std::string need{};  ///< what it must be; empty: as the number
  bool is_angle = false;
};

struct Binding {
  std::string name{};
  std::string text{};                ///< a number, a formula or a word
  std::optional<long> whole{};       ///< its value, if it is a whole number
  std::vector<WrittenPart> parts{};  ///< of its text, where it was written as one
};

/// Inner ones behind outer ones; of two with one name the last counts.
struct Bindings {
  std::vector<Binding> list{};

  const Binding* find(std::string_view name) const;
};

/// The formula with every bound name replaced by "(text)". Numbers ("2e3") and functions stay.
std::string with_bindings(const std::string& formula, const Bindings& bindings);

/// What formulas of the file the number or formula of a node is made of; those first that others are made of.
std::vector<WrittenPart> written_parts(const Node& node);

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
