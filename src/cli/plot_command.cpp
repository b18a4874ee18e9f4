#include "plot_command.hpp"

#include <optional>
#include <stdexcept>

#include "exit_code.hpp"
#include "messages.hpp"
#include "springfold/io/plots.hpp"
#include "springfold/io/result_folder.hpp"

namespace springfold::cli {

int plot_command(const Arguments& arguments, const Session& session) {
  const std::filesystem::path& folder = arguments.results;
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    say(session.err, "no folder " + folder.string() + ": need the folder of the results of a run");
    return input_output;
  }
  std::optional<io::FolderLock> lock;
  try {
    lock.emplace(folder);
  } catch (const std::runtime_error& failure) {
    say(session.err, failure.what());
    return input_output;
  }
  const io::PlotOptions options{.stop_requested = stop_request_of(session)};
  const auto outcome = io::redraw_plots(folder, arguments.draws_changed, options);
  for (const auto& warning : outcome.warnings) say(session.err, "warning: " + warning);
  say(session.err,
      std::to_string(outcome.files.size()) + " pictures in " + (folder / "plots").string());
  if (const int signal = session.signal ? session.signal() : 0; signal != 0)
    return interrupted_by(signal);
  return outcome.warnings.empty() ? all_done : input_output;
}

}  // namespace springfold::cli
