// Lines of the summary for people. Private to io.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "fitted_table.hpp"
#include "springfold/io/shown_text.hpp"
#include "text.hpp"

namespace springfold::io {

inline constexpr int summary_digits = 10;
inline constexpr std::size_t summary_indent = 4;
inline constexpr std::size_t summary_label_width = 14;

/// "    pose          text". What has no room in a line of a terminal goes on below the text.
inline std::string summary_line(std::string_view label, const std::string& text) {
  std::string padded{label};
  padded.resize(std::max(padded.size(), summary_label_width), ' ');
  std::string lead = std::string(summary_indent, ' ') + padded;
  const std::string words = shown(text);
  std::string whole = lead + words;
  whole.erase(whole.find_last_not_of(' ') + 1);
  if (width_of(whole) <= table_width) return whole + "\n";
  std::string lines;
  for (const std::string& line : wrapped(words, table_width - width_of(lead))) {
    lines += lead + line + "\n";
    lead.assign(lead.size(), ' ');
  }
  return lines;
}

/// The words of an unresolved point, so that it is seen: "UNRESOLVED: ...". Details may say it already.
inline std::string unresolved_text(const std::string& detail) {
  constexpr std::string_view said = "unresolved";
  const bool is_said = detail.starts_with(said);
  return "UNRESOLVED" + (is_said ? detail.substr(said.size()) : ": " + detail);
}

/// "1 point", "2 points".
inline std::string counted(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace springfold::io
