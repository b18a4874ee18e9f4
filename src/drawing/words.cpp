#include "words.hpp"

namespace springfold::drawing {
namespace {

/// As many whole characters as fit, with an ellipsis for the rest.
std::string fitting(const std::string& text, double font, double width) {
  const auto fits = [&](const std::string& t) {
    const Box box = box_of({.text = t, .size = font});
    return box.right - box.left <= width;
  };
  if (fits(text)) return text;
  std::string shorter = text;
  while (!shorter.empty() && !fits(shorter + "…")) {
    while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) & 0xC0U) == 0x80)
      shorter.pop_back();
    if (!shorter.empty()) shorter.pop_back();
  }
  return shorter + "…";
}

}  // namespace

void add_line(const std::string& text, double font, bool is_bold, double x, double width, double& y,
              Picture& picture) {
  if (text.empty()) return;
  y += font + 4;
  picture.marks.emplace_back(
      Words{.at = {x, y}, .text = fitting(text, font, width), .size = font, .is_bold = is_bold});
}

}  // namespace springfold::drawing
