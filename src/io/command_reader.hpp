// Keys of studies of the kinds control, map and workspace.
#pragma once

#include <optional>

#include "command_draft.hpp"
#include "mechanism_draft.hpp"
#include "table_reader.hpp"

namespace springfold::io {

/// Keys that a study of this kind may have; empty for other kinds.
std::vector<std::string> command_keys(analysis::StudyKind kind);

/// @param body  whose pose is meant, usable @param numbers  of the study
CommandDraft read_commands(analysis::StudyKind kind, const TableReader& table,
                           const BodyDraft& body, const std::vector<std::string>& actuators,
                           NumberTable& numbers, Reading& reading);

/// Reads `targets` and wrenches from the text of a file of comma-separated values: a header with
/// names of columns, then one line of numbers per target; '#' begins a comment.
void read_target_file(const TargetFile& file, const std::string& shown_name,
                      const std::string& text, CommandDraft& draft, NumberTable& numbers,
                      Problems& problems);

}  // namespace springfold::io
