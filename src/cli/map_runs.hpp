// Running maps: threads, checkpoints and going on after an interruption.
#pragma once

#include <filesystem>

#include "arguments.hpp"
#include "progress.hpp"
#include "session.hpp"

namespace springfold::cli {

/// One map; its rows are kept in `folder` while it runs, and found there again with --resume.
analysis::StudyResult run_map(const Arguments& arguments, const std::filesystem::path& folder,
                              const io::Case& the_case, const io::PlannedRun& planned,
                              const Session& session, Progress& progress);

}  // namespace springfold::cli
