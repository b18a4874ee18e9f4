// The pictures that a case asks for with [[picture]].
#pragma once

#include <filesystem>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/drawing/illustration.hpp"
#include "springfold/io/plots.hpp"

namespace springfold::io {

/// The postures of a picture, one panel each. Runs without a result are left out.
/// @param problems  gets a sentence for every posture that there is not
std::vector<drawing::Panel> panels_of(const PictureSpec& spec, const Case& the_case,
                                      const std::vector<analysis::StudyResult>& results,
                                      std::vector<std::string>& problems);

/// Draws all pictures of the case into plots/ and lists them in the manifest. SVG needs no other program,
/// PNG rsvg-convert; what fails is a warning of the outcome.
/// @throws std::runtime_error when a file cannot be written
void draw_case_pictures(const std::filesystem::path& folder, const Case& the_case,
                        const std::vector<analysis::StudyResult>& results,
                        const PlotOptions& options, PlotOutcome& outcome);

}  // namespace springfold::io
