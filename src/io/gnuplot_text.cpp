#include "gnuplot_text.hpp"

#include <algorithm>

#include "springfold/io/shown_text.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

/// Is this the beginning of "{/font ..."? @returns where the name of the font begins, npos if it is not
std::size_t font_at(std::string_view text, std::size_t brace) {
  const std::size_t slash = text.find_first_not_of(' ', brace + 1);
  if (slash == std::string_view::npos || text[slash] != '/') return std::string_view::npos;
  return std::min(text.find_first_not_of(' ', slash + 1), text.size());
}

std::size_t end_of_font(std::string_view text, std::size_t begin) {
  return std::min(text.find_first_of(" }", begin), text.size());
}

}  // namespace

std::string gnuplot_string(std::string_view text) {
  // A doubled quote stands for one only behind another character (gnuplot 5.4): a quote is a string of its own, by its
  // code.
  std::string result = "'";
  for (const char c : shown_in_line(text)) {
    if (c == '\'')
      result += "'.\"\\047\".'";
    else
      result += c;
  }
  return result + "'";
}

std::string gnuplot_mode(const FigureText& text) {
  return text.is_markup ? "enhanced" : "noenhanced";
}

std::string gnuplot_assignment(const std::string& name, const FigureText& text) {
  return name + " = " + gnuplot_string(text.text) + "\n" + name + "_mode = '" + gnuplot_mode(text) +
         "'\n";
}

std::string without_markup(std::string_view text) {
  std::string seen;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) {
      seen += text[++i];
    } else if (text[i] == '{') {
      const std::size_t font = font_at(text, i);
      if (font != std::string_view::npos) i = end_of_font(text, font) - 1;
    } else if (std::string_view{"}_^@"}.find(text[i]) == std::string_view::npos) {
      seen += text[i];
    }
  }
  return seen;
}

std::string tex_text(std::string_view text) {
  std::string escaped;
  for (const char c : shown_in_line(text)) {
    if (std::string_view{"{}$&#%_"}.find(c) != std::string_view::npos)
      escaped += std::string{'\\', c};
    else if (c == '\\')
      escaped += "\\textbackslash{}";
    else if (c == '^')
      escaped += "\\textasciicircum{}";
    else if (c == '~')
      escaped += "\\textasciitilde{}";
    else
      escaped += c;
  }
  return escaped;
}

FigureText text_for(const FigureText& text, bool is_tex) {
  if (!is_tex) return text;
  return {tex_text(text.is_markup ? without_markup(text.text) : text.text)};
}

std::string sheet_assignments(const SheetLook& look, const std::string& format) {
  return "\nfigure_format = " + gnuplot_string(format) +
         "\nfigure_font = " + gnuplot_string(look.font) +
         "\nfigure_font_size = " + shortest(look.font_size) +
         "\nfigure_width = " + shortest(look.width) + "\nfigure_height = " + shortest(look.height) +
         "\n";
}

std::string markup_problem(std::string_view text) {
  for (std::size_t i = text.find('{'); i != std::string_view::npos; i = text.find('{', i + 1)) {
    const std::size_t begin = font_at(text, i);
    if (begin == std::string_view::npos) continue;
    const std::string_view font = text.substr(begin, end_of_font(text, begin) - begin);
    if (font.find_first_of("\"'<>&\\") != std::string_view::npos)
      return "the name of a font, \"" + shown(font) + "\", has a quote, '<', '>', '&' or '\\'";
  }
  return {};
}

}  // namespace springfold::io
