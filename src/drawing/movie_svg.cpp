#include <charconv>
#include <string>

#include "springfold/drawing/movie.hpp"
#include "svg.hpp"

namespace springfold::drawing {
namespace {

std::string fixed(double value, int decimals) {
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals).ptr;
  return {buffer, end};
}

/// When the frame is seen: a key at each slot at which that changes.
std::string keys_of(std::size_t frame, const std::vector<std::size_t>& order) {
  std::string keys;
  bool was_seen = false;
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    const bool is_seen = order[slot] == frame;
    if (slot > 0 && is_seen == was_seen) continue;
    was_seen = is_seen;
    const double part = static_cast<double>(slot) / static_cast<double>(order.size());
    keys += fixed(100 * part, 3) + "%{visibility:" + (is_seen ? "visible}" : "hidden}");
  }
  return keys;
}

}  // namespace

std::string svg_text(const Movie& movie) {
  std::string text = svg_head(movie.still);
  const double seconds = movie.slot * static_cast<double>(movie.order.size());
  text += "<style>\n.frame{animation-duration:" + fixed(seconds, 2) +
          "s;animation-timing-function:step-end;animation-iteration-count:infinite}\n"
          "@media (prefers-reduced-motion:reduce){.frame{animation:none!important}}\n";
  for (std::size_t i = 0; i < movie.frames.size(); ++i)
    text += "@keyframes f" + std::to_string(i) + "{" + keys_of(i, movie.order) + "}\n";
  text += "</style>\n";
  for (std::size_t i = 0; i < movie.frames.size(); ++i) {
    text += "<g class=\"frame\" style=\"animation-name:f" + std::to_string(i) + "\"";
    text += i == 0 ? ">\n" : " visibility=\"hidden\">\n";
    for (const Mark& mark : movie.frames[i]) text += svg_mark(mark);
    text += "</g>\n";
  }
  return text + "</svg>\n";
}

}  // namespace springfold::drawing
