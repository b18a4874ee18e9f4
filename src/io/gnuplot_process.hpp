// Running gnuplot so that nothing that it does can hurt us.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace springfold::io {

struct GnuplotCall {
  std::filesystem::path executable{};  ///< with folder: see find_executable
  std::filesystem::path folder{};      ///< working folder: what the script writes lands here
  std::string script{};                ///< file name in that folder
  double timeout_seconds = 60;
  std::function<bool()> stop_requested{};  ///< asked a few times a second; may be empty
  /// Another program that draws: its command line, its name first, in place of gnuplot's with the script.
  std::vector<std::string> words{};
};

/// Full path of a program, looked up in PATH unless the name has a slash; nothing if there is no
/// such executable file.
std::optional<std::filesystem::path> find_executable(const std::string& name);

/// Runs gnuplot on the script in a process group of its own, its standard output thrown away, and
/// waits. Returns nothing on success, otherwise the reason in words: could not be started, ended
/// with an error (and the last lines that it wrote), ran out of time or was asked to stop (then it
/// and its children are killed).
std::optional<std::string> run_gnuplot(const GnuplotCall& call);

}  // namespace springfold::io
