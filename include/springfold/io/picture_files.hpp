// Pictures on disk.
#pragma once

#include <filesystem>
#include <string>

#include "springfold/drawing/movie.hpp"
#include "springfold/drawing/picture.hpp"

namespace springfold::io {

/// Writes the picture as `file`, whose name ends in .svg, .png or .pdf; folders are made. PNG and PDF files are made
/// by the program rsvg-convert (Debian: librsvg2-bin) from an SVG file of the same name beside it.
/// @returns what is missing, in words; empty when the file is there
/// @throws std::runtime_error "cannot write <path>: <reason>"
std::string write_picture(const drawing::Picture& picture, const std::filesystem::path& file);

/// Writes the movie as an SVG file; folders are made.
/// @throws std::runtime_error "cannot write <path>: <reason>"
void write_movie(const drawing::Movie& movie, const std::filesystem::path& file);

}  // namespace springfold::io
