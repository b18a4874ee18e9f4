// Text in gnuplot scripts: the only way in which text of a case gets there.
#pragma once

#include <string>
#include <string_view>

#include "figure.hpp"
#include "springfold/io/plot_look.hpp"

namespace springfold::io {

/// An expression of gnuplot whose value is the text: strings between single quotes, within which nothing but the quote
/// is special, neither `command`, $(command), @macro nor \; quotes are joined to them by their code. Ends of lines
/// become blanks, and what else is not visible is written out (see shown()), so that every string ends where it should.
std::string gnuplot_string(std::string_view text);

/// 'enhanced' or 'noenhanced': how gnuplot is told whether a text has markup.
std::string gnuplot_mode(const FigureText& text);

/// The lines that set a text and the way it is drawn: "x_title = '...'" and "x_title_mode = '...'".
std::string gnuplot_assignment(const std::string& name, const FigureText& text);

/// What is seen of a text in gnuplot's markup, about: enough to know how much room it needs.
std::string without_markup(std::string_view text);

/// The text for LaTeX, all of whose signs with a meaning there are escaped; what is not visible is
/// written out.
std::string tex_text(std::string_view text);

/// The text as a figure for LaTeX has it (format "tikz"): without gnuplot's markup, its own signs escaped.
FigureText text_for(const FigureText& text, bool is_tex);

/// The lines that set format, font and size of a map or a figure of bars.
std::string sheet_assignments(const SheetLook& look, const std::string& format);

/// What is wrong with a text in gnuplot's markup; empty if nothing is. Names of fonts, "{/Symbol q}", stand
/// unquoted in SVG files: what could end them there is refused.
std::string markup_problem(std::string_view text);

}  // namespace springfold::io
