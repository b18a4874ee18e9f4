#include "map_runs.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "messages.hpp"
#include "springfold/io/checkpoint.hpp"

namespace springfold::cli {

analysis::StudyResult run_map(const Arguments& arguments, const std::filesystem::path& folder,
                              const io::Case& the_case, const io::PlannedRun& planned,
                              const Session& session, Progress& progress) {
  analysis::RunOptions options{.threads = arguments.threads};
  const auto known =
      arguments.resumes ? io::read_checkpoint(folder, the_case, planned) : std::nullopt;
  if (known) {
    options.known = &*known;
    progress.clear();
    say(session.err, planned.study + ", run " + std::to_string(planned.run) + ": " +
                         std::to_string(std::count(known->done.begin(), known->done.end(), true)) +
                         " of " + std::to_string(known->done.size()) + " nodes are known already");
  }
  bool can_write = true;
  options.checkpoint = [&](const analysis::PartialRows& rows) {
    if (!can_write) return;
    try {
      io::write_checkpoint(folder, the_case, planned, rows);
    } catch (const std::runtime_error& error) {  // the results are what counts
      can_write = false;
      say(session.err, std::string{"warning: no checkpoint: "} + error.what());
    }
  };
  return session.run_map(
      planned,
      [&](int, double done) {
        if (session.signal() != 0) return false;
        progress.part(done);
        return true;
      },
      options);
}

}  // namespace springfold::cli
