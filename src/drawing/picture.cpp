#include "springfold/drawing/picture.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::drawing {
namespace {

/// Characters of UTF-8 text.
double length_of(const std::string& text) {
  return static_cast<double>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80;
  }));
}

/// Keeps of [from, to] the part where from + t (to - from) lies between the bounds.
bool clip(double start, double way, double low, double high, double& from, double& to) {
  if (way == 0) return low <= start && start <= high;
  const double a = (low - start) / way, b = (high - start) / way;
  from = std::max(from, std::min(a, b));
  to = std::min(to, std::max(a, b));
  return from <= to;
}

}  // namespace

Box box_of(const Words& words) {
  constexpr double widest = 0.62;  // of the size: mean width of a letter of DejaVu Sans, bold
  constexpr double above = 0.82, below = 0.24;
  const double width = widest * words.size * length_of(words.text);
  const double left = words.at.x - (words.anchor == Anchor::start    ? 0
                                    : words.anchor == Anchor::middle ? width / 2
                                                                     : width);
  return {left, words.at.y - above * words.size, left + width, words.at.y + below * words.size};
}

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

bool crosses(const Place& from, const Place& to, const Box& box) {
  double begin = 0, end = 1;
  return clip(from.x, to.x - from.x, box.left, box.right, begin, end) &&
         clip(from.y, to.y - from.y, box.top, box.bottom, begin, end);
}

std::vector<std::string> unreadable_words(const Picture& picture) {
  std::vector<std::string> problems;
  std::vector<const Words*> before;
  for (const Mark& mark : picture.marks) {
    const auto* words = std::get_if<Words>(&mark);
    if (words == nullptr) continue;
    const Box box = box_of(*words);
    for (const Words* other : before)
      if (overlap(box, box_of(*other)))
        problems.push_back("\"" + words->text + "\" lies on \"" + other->text + "\"");
    before.push_back(words);
    if (box.left < 0 || box.top < 0 || box.right > picture.width || box.bottom > picture.height)
      problems.push_back("\"" + words->text + "\" leaves the picture");
    for (const Mark& line : picture.marks)
      if (const auto* path = std::get_if<Path>(&line); path && path->is_obstacle)
        for (std::size_t i = 0; i + 1 < path->places.size(); ++i)
          if (crosses(path->places[i], path->places[i + 1], box)) {
            problems.push_back("\"" + words->text + "\" lies on a line " + path->title);
            break;
          }
  }
  return problems;
}

}  // namespace springfold::drawing
