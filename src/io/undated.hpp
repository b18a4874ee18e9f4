// Pictures of other programs without the date at which they were made, so that the same case gives the same bytes, and
// valid.
#pragma once

#include <filesystem>
#include <string>

namespace springfold::io {

/// The bytes of a PDF file with blanks instead of the dates of its information dictionary: as long as before, so that
/// all places in the file stay right. Of a PDF file without such dates, and of others, the same bytes.
std::string undated_pdf(std::string bytes);

/// gnuplot's LaTeX file without the line that says when it was made.
std::string undated_tex(std::string text);

/// gnuplot's SVG file with "]]>" in texts as XML wants it; where it closes a CDATA section it stays.
std::string valid_svg(std::string text);

/// Takes the date out of a picture that another program has written, and makes it valid XML, as its ending says; files
/// of other endings stay.
/// @throws std::runtime_error if it cannot be read or written
void finish_picture(const std::filesystem::path& picture);

}  // namespace springfold::io
