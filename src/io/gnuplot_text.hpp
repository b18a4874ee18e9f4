// Text in gnuplot scripts: the only way in which text of a case gets there.
#pragma once

#include <string>
#include <string_view>

namespace springfold::io {

/// A gnuplot string between single quotes, within which nothing but the quote is special: neither
/// `command`, $(command), @macro nor \ are taken apart there. Ends of lines become blanks, and what
/// else is not visible is written out (see shown()), so that the string ends where it should.
std::string gnuplot_string(std::string_view text);

}  // namespace springfold::io
