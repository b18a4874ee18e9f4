// What a long run has computed so far, kept beside its results until all of them are whole.
#pragma once

#include <filesystem>
#include <optional>

#include "springfold/analysis/run.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Writes the rows that are done, in place of an earlier checkpoint of this run, and waits until they
/// are on the disk.
/// @throws std::runtime_error when it cannot be written
void write_checkpoint(const std::filesystem::path& folder, const Case& the_case,
                      const PlannedRun& planned, const analysis::PartialRows& rows);

/// The rows that a checkpoint of the same case (files, values given with --set), study, run and
/// version of the program holds; nothing if there is none or it is damaged.
std::optional<analysis::PartialRows> read_checkpoint(const std::filesystem::path& folder,
                                                     const Case& the_case,
                                                     const PlannedRun& planned);

/// Removes the checkpoints of all runs of the case, once the results in the folder are on the disk.
/// @throws std::runtime_error when they cannot be put there
void remove_checkpoints(const std::filesystem::path& folder, const Case& the_case);

}  // namespace springfold::io
