// All runs of a case, one study after the other, those of one study on all cores.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

struct Results {
  std::vector<analysis::StudyResult> list{};  ///< in the order of the case
  std::vector<bool> interrupted{};            ///< of the list: a signal ended it
  const io::PlannedRun* failed = nullptr;     ///< there was not enough memory for it, and the end
  /// They did not end in time after a signal: threads are still at work on them, and they are not in the list.
  std::vector<const io::PlannedRun*> given_up{};
  std::optional<std::chrono::steady_clock::time_point> signal_since{};  ///< seen while they ran

  /// Every run is there and none was ended by a signal.
  bool all_done(const io::Case& the_case) const;
};

/// Runs until all is done or a signal comes. A run that the signal stops is kept as well, unless only its
/// row of a table would be; one for which there is not enough memory is not. Rows are kept in `folder`
/// while their study runs, and found there again with --resume.
Results run_all(const Arguments& arguments, const std::filesystem::path& folder,
                std::shared_ptr<const io::Case> the_case, const Session& session);

}  // namespace springfold::cli
