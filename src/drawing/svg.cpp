#include "svg.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace springfold::drawing {
namespace {

/// At most two decimals, no "-0", independent of the locale.
std::string number(double value) {
  const double rounded = std::round(value * 100) / 100 + 0.0;
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, rounded == 0 ? 0.0 : rounded,
                                 std::chars_format::fixed, 2)
                       .ptr;
  std::string text(buffer, end);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Length of the UTF-8 character at `i` that XML may hold; 0: none.
std::size_t character_at(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned lead = byte(i);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || i + length > text.size()) return 0;
  std::uint32_t code = lead & (0xFFU >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xC0U) != 0x80) return 0;
    code = code << 6U | (byte(i + k) & 0x3FU);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool is_none = code > 0x10FFFF || (code & 0xFFFFU) >= 0xFFFE || code < 0xA0;
  return code < least[length] || is_surrogate || is_none ? 0 : length;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_at(text, i);
    if (length == 0) {
      out += "\xEF\xBF\xBD";
      ++i;
      continue;
    }
    switch (text[i]) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += text.substr(i, length);
    }
    i += length;
  }
  return out;
}

std::string attributes(const Ink& ink) {
  std::string text = " fill=\"" + (ink.fill.empty() ? "none" : escaped(ink.fill)) + "\"";
  if (ink.stroke.empty()) return text;
  text += " stroke=\"" + escaped(ink.stroke) + "\" stroke-width=\"" + number(ink.width) + "\"";
  if (ink.dashes.empty()) return text;
  text += " stroke-dasharray=\"";
  for (std::size_t i = 0; i < ink.dashes.size(); ++i)
    text += (i == 0 ? "" : " ") + number(ink.dashes[i]);
  return text + "\"";
}

std::string ended(const std::string& element, const std::string& title) {
  if (title.empty()) return "/>\n";
  return "><title>" + escaped(title) + "</title></" + element + ">\n";
}

std::string svg(const Path& path) {
  std::string text = path.is_closed ? "<polygon points=\"" : "<polyline points=\"";
  for (std::size_t i = 0; i < path.places.size(); ++i)
    text += (i == 0 ? "" : " ") + number(path.places[i].x) + "," + number(path.places[i].y);
  text += "\"" + attributes(path.ink);
  if (!path.ink.stroke.empty()) text += " stroke-linejoin=\"round\" stroke-linecap=\"round\"";
  return text + ended(path.is_closed ? "polygon" : "polyline", path.title);
}

std::string svg(const Disc& disc) {
  return "<circle cx=\"" + number(disc.centre.x) + "\" cy=\"" + number(disc.centre.y) + "\" r=\"" +
         number(disc.radius) + "\"" + attributes(disc.ink) + ended("circle", disc.title);
}

std::string svg(const Words& words) {
  std::string text = "<text x=\"" + number(words.at.x) + "\" y=\"" + number(words.at.y) +
                     "\" font-size=\"" + number(words.size) + "\" fill=\"" + escaped(words.colour) +
                     "\"";
  if (words.anchor != Anchor::start)
    text += words.anchor == Anchor::middle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
  if (words.is_bold) text += " font-weight=\"bold\"";
  return text + ">" + escaped(words.text) + "</text>\n";
}

}  // namespace

std::string svg_mark(const Mark& mark) {
  return std::visit([](const auto& m) { return svg(m); }, mark);
}

std::string svg_head(const Picture& picture) {
  const std::string w = number(picture.width), h = number(picture.height);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
      w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + " " + h +
      "\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n";
  if (!picture.title.empty()) text += "<title>" + escaped(picture.title) + "</title>\n";
  text += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (const Mark& mark : picture.marks) text += svg_mark(mark);
  return text;
}

std::string svg_text(const Picture& picture) { return svg_head(picture) + "</svg>\n"; }

}  // namespace springfold::drawing
