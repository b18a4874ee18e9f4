// Numbers and text for files and tables: independent of locale, same bytes every time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace springfold::io {

/// Shortest decimal form that reads back to the same double; "nan", "inf", "-inf".
std::string shortest(double value);

/// The shortest form without an exponent, of finite values: gnuplot takes no exponents in texts,
/// and whole numbers only as far as they fit into 64 bits: larger ones end with ".0".
std::string decimal(double value);

/// At most `digits` significant digits, trailing zeros left out, no "-0"; "nan", "inf",
/// "-inf".
std::string rounded(double value, int digits);

/// A field of a CSV table: shortest form, nothing for NaN.
std::string csv_number(double value);

/// The same at the end of a text; needs no memory of its own.
void append_csv_number(std::string& text, double value);

/// A field of a CSV table, quoted where RFC 4180 asks for it.
std::string csv_text(std::string_view text);
void append_csv_text(std::string& line, std::string_view text);

/// A file name made from any name: letters, digits, '.', '-' and '_' stay, everything else becomes
/// one '_'; never empty, never hidden, at most 80 bytes.
std::string safe_file_name(std::string_view name);

/// Hands out names that differ even where upper and lower case do not count: "a", "a_2", "a_3".
class UniqueNames {
 public:
  std::string make(std::string_view wanted);

 private:
  std::vector<std::string> taken_{};  // in lower case
};

/// Characters (not bytes) of UTF-8 text.
std::size_t width_of(std::string_view text);

/// Words of `text` in lines of at most `width` characters; a longer word has its own line.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

enum class Align { left, right };

/// Rows of cells as aligned lines, each one `indent` spaces from the left; no blanks at line ends.
/// Rows may be of different length; columns without an entry in `align` are left-aligned.
std::string aligned(const std::vector<std::vector<std::string>>& rows,
                    const std::vector<Align>& align, std::size_t indent);

}  // namespace springfold::io
