// A figure of curves as a script of gnuplot.
#pragma once

#include <filesystem>
#include <string>

#include "figure.hpp"

namespace springfold::io {

/// Writes a script that draws the figure alone, without any other file.
/// @param style, drawing  the templates style.gp and force-deflection.gp
/// @throws std::runtime_error when the file cannot be written
void write_figure_script(const std::filesystem::path& path, const Figure& figure,
                         const std::string& style, const std::string& drawing);

}  // namespace springfold::io
