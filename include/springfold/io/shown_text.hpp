// Text of a case, a file name or another program, as it may stand on a terminal or in a figure.
#pragma once

#include <string>
#include <string_view>

namespace springfold::io {

/// The text on one line, with everything in it that is not a visible character written out: "\\n", "\\t", "\\x1b",
/// "\\u{202e}" (with one backslash). That concerns control characters (C0, DEL, C1), line and paragraph separators,
/// marks that change the direction of writing, and characters that XML does not have; bytes that are no UTF-8 become
/// "\\xff". Visible characters stay, a backslash too; shown(shown(t)) = shown(t).
std::string shown(std::string_view text);

/// The same where a line is drawn: ends of lines become blanks.
std::string shown_in_line(std::string_view text);

}  // namespace springfold::io
