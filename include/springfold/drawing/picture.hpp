// A flat picture as plain data: lines, discs and words in pixels, x to the right, y down.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace springfold::drawing {

struct Place {
  double x = 0, y = 0;
};

struct Ink {
  std::string stroke{};  ///< "#0072b2"; empty: no line
  std::string fill{};    ///< empty: not filled
  double width = 1;
  std::vector<double> dashes{};
};

struct Path {
  std::vector<Place> places{};
  bool is_closed = false;
  Ink ink{};
  std::string title{};      ///< shown by a browser when the mouse is over it; any text
  bool is_obstacle = true;  ///< words keep off it
  bool is_avoided = false;  ///< words keep off it where there is room beside it
};

struct Disc {
  Place centre{};
  double radius = 0;
  Ink ink{};
  std::string title{};
};

enum class Anchor { start, middle, end };

struct Words {
  Place at{};  ///< left, middle or right end of the base line
  std::string text{};
  Anchor anchor = Anchor::start;
  double size = 12;
  std::string colour = "#222222";
  bool is_bold = false;
};

using Mark = std::variant<Path, Disc, Words>;

/// Later marks cover earlier ones.
struct Picture {
  double width = 0, height = 0;
  std::string title{};
  std::vector<Mark> marks{};
};

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// Room that words take, rather too much than too little: fonts differ.
Box box_of(const Words& words);

bool overlap(const Box& a, const Box& b);

/// Does the straight line between the places meet the box?
bool crosses(const Place& from, const Place& to, const Box& box);

/// What is wrong with the words of a picture: those that overlap others or lie on a line, one sentence
/// each; empty if all can be read.
std::vector<std::string> unreadable_words(const Picture& picture);

/// The picture as an SVG file. Texts are escaped; characters that XML has not become U+FFFD. The same
/// picture gives the same bytes.
std::string svg_text(const Picture& picture);

}  // namespace springfold::drawing
