// What a long run has computed so far, kept beside its results until all of them are whole.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Writes the runs of a study of which only rows are kept, as far as they are done, as write_checkpoint does.
/// @throws std::runtime_error when it cannot be written
void write_row_checkpoint(const std::filesystem::path& folder, const Case& the_case,
                          const std::string& study,
                          const std::vector<const analysis::StudyResult*>& done);

/// The runs that such a checkpoint of the same case and version holds, by number; empty if there is none or
/// it is damaged.
std::map<int, analysis::StudyResult> read_row_checkpoint(const std::filesystem::path& folder,
                                                         const Case& the_case,
                                                         const std::string& study);

/// One run of which only its row is kept as a line of text, the same bytes for the same row, and back.
std::string row_line(const analysis::StudyResult& result);
/// @returns nothing if it is damaged, or of a run that `study` does not have
std::optional<analysis::StudyResult> read_row_line(std::string_view line, const Case& the_case,
                                                   const std::string& study);

/// Removes the checkpoints of all runs of the case, once the results in the folder are on the disk.
/// @throws std::runtime_error when they cannot be put there
void remove_checkpoints(const std::filesystem::path& folder, const Case& the_case);

}  // namespace springfold::io
