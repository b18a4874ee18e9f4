// Case files from descriptions of robots: links become rigid elements and bodies, joints elastic drives.
#pragma once

#include <filesystem>
#include <functional>

#include "springfold/io/import_mesh.hpp"

namespace springfold::io {

/// Was the library built with urdfdom, so that it can read URDF?
bool reads_urdf();

/// Reads a robot, URDF (.urdf), and writes it as a case: its root link is the base; a link with no joint behind it or
/// with several is a body, and a chain leads to it from the one before. Revolute, continuous and prismatic joints are
/// actuated, with an elastic drive and the command 0; fixed ones and origins are rigid elements. Masses are point
/// masses at the links' centres. What has no counterpart is named in the report. Source of the format:
/// wiki.ros.org/urdf/XML, read by urdfdom.
/// @throws CaseError where the file is no tree of such joints
/// @throws continuation::Interrupted if `stop_requested` says so while the file is read
ImportedCase import_urdf(const std::filesystem::path& file,
                         const std::function<bool()>& stop_requested = {});

}  // namespace springfold::io
