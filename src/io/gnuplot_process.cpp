#include "gnuplot_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "text.hpp"

namespace springfold::io {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto nap = std::chrono::milliseconds{5};
constexpr int longest_wait_ms = 100;  // between two looks at the clock and at stop_requested
constexpr std::size_t kept_bytes = 4096;

/// Both ends of a pipe, closed at the end of the scope.
struct Pipe {
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) ends = {-1, -1};
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  void close_write_end() {
    ::close(ends[1]);
    ends[1] = -1;
  }
  std::array<int, 2> ends{};
};

/// Our environment with a fixed locale, so that the same script gives the same picture.
std::vector<std::string> environment() {
  std::vector<std::string> entries;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text{*entry};
    const bool is_replaced = text.starts_with("LC_") || text.starts_with("LANG=") ||
                             text.starts_with("LANGUAGE=") || text.starts_with("GNUTERM=");
    if (!is_replaced) entries.emplace_back(text);
  }
  entries.emplace_back("LC_ALL=C.UTF-8");
  return entries;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (auto& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Starts the process; 0 or the error.
int spawn(const GnuplotCall& call, int error_pipe, pid_t& process) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  // After a failed `set output` gnuplot writes the picture to its standard output.
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, error_pipe, STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&files, call.folder.c_str());

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  sigset_t none, defaults;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  sigemptyset(&defaults);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) sigaddset(&defaults, signal);
  posix_spawnattr_setsigdefault(&attributes, &defaults);

  std::vector<std::string> words = call.words;
  if (words.empty()) words = {"gnuplot", "--default-settings", call.script};
  std::vector<std::string> variables = environment();
  const int error = ::posix_spawn(&process, call.executable.c_str(), &files, &attributes,
                                  pointers_to(words).data(), pointers_to(variables).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

enum class PipeState { got_some, nothing_yet, ended };

/// Appends what can be read within `wait_ms`.
PipeState read_some(int file, int wait_ms, std::string& text) {
  pollfd wanted{.fd = file, .events = POLLIN, .revents = 0};
  if (::poll(&wanted, 1, wait_ms) <= 0) return PipeState::nothing_yet;  // or a signal came
  std::array<char, 4096> part{};
  const ssize_t count = ::read(file, part.data(), part.size());
  if (count < 0) return errno == EINTR ? PipeState::nothing_yet : PipeState::ended;
  text.append(part.data(), static_cast<std::size_t>(count));
  if (text.size() > 2 * kept_bytes) text.erase(0, text.size() - kept_bytes);
  return count > 0 ? PipeState::got_some : PipeState::ended;
}

std::string last_lines(const std::string& text) {
  std::istringstream lines{text};
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find_first_not_of(" \t^");
    if (first != std::string::npos) all += (all.empty() ? "" : "; ") + line.substr(first);
  }
  constexpr std::size_t longest = 400;
  return all.size() <= longest ? all : "..." + all.substr(all.size() - longest);
}

std::string program_of(const GnuplotCall& call) {
  return call.words.empty() ? "gnuplot" : call.words.front();
}

std::optional<std::string> reason_of(int status, const std::string& messages,
                                     const std::string& program) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  std::string reason = WIFSIGNALED(status)
                           ? program + " was ended by signal " + std::to_string(WTERMSIG(status))
                           : program + " ended with code " + std::to_string(WEXITSTATUS(status));
  const std::string said = last_lines(messages);
  return said.empty() ? reason : reason + ": " + said;
}

/// Has the process ended? It stays a zombie, so that its number and group are not given away.
bool has_ended(pid_t process) {
  siginfo_t info{};
  const int error = ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT);
  return error != 0 ? errno != EINTR : info.si_pid == process;
}

/// Kills what is left of the process group and takes the exit status of its leader.
std::optional<int> finish(pid_t process) {
  ::kill(-process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return std::nullopt;
  return status;
}

std::string timeout_text(const GnuplotCall& call) {
  return program_of(call) + " did not finish within " + rounded(call.timeout_seconds, 3) +
         " s and was stopped";
}

}  // namespace

std::optional<fs::path> find_executable(const std::string& name) {
  const auto is_executable = [](const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos) {
    if (!is_executable(name)) return std::nullopt;
    return fs::absolute(name);  // the process starts in another folder
  }
  const char* path = std::getenv("PATH");
  std::istringstream folders{path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path};
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path candidate = fs::path{folder.empty() ? "." : folder} / name;
    if (is_executable(candidate)) return fs::absolute(candidate);
  }
  return std::nullopt;
}

std::optional<std::string> run_gnuplot(const GnuplotCall& call) {
  Pipe errors;
  if (errors.ends[0] < 0)
    return "no pipe to " + program_of(call) + ": " + std::generic_category().message(errno);
  pid_t process = 0;
  if (const int error = spawn(call, errors.ends[1], process))
    return program_of(call) + " cannot be started: " + std::generic_category().message(error);
  errors.close_write_end();

  const auto deadline = Clock::now() + std::chrono::duration<double>{call.timeout_seconds};
  std::string messages;
  bool is_open = true;
  while (!has_ended(process)) {
    const bool is_stopped = call.stop_requested && call.stop_requested();
    if (is_stopped || Clock::now() >= deadline) {
      finish(process);
      return is_stopped ? "stopped on request" : timeout_text(call);
    }
    if (is_open)
      is_open = read_some(errors.ends[0], longest_wait_ms, messages) != PipeState::ended;
    else
      std::this_thread::sleep_for(nap);
  }
  while (is_open && read_some(errors.ends[0], 0, messages) == PipeState::got_some) {
  }
  const auto status = finish(process);
  return status ? reason_of(*status, messages, program_of(call))
                : program_of(call) + "'s exit code was lost";
}

}  // namespace springfold::io
