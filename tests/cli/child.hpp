// The program as a child process that is sent signals.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace springfold::cli {

class Child {
 public:
  /// Runs the program in `folder`; its streams go to the files out.txt and err.txt there.
  Child(const std::filesystem::path& folder, std::vector<std::string> words) {
    words.insert(words.begin(), SPRINGFOLD_PROGRAM);
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
    for (const auto& [stream, name] :
         {std::pair{STDOUT_FILENO, "out.txt"}, {STDERR_FILENO, "err.txt"}})
      posix_spawn_file_actions_addopen(&files, stream, name, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int failure = ::posix_spawn(&process_, argv[0], &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (failure != 0) {
      process_ = -1;
      ADD_FAILURE() << argv[0] << " cannot be started: " << std::strerror(failure);
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

  /// Nothing where it was not started, or has ended: -1 is every process that there is.
  void send(int signal) const {
    if (process_ > 0) ::kill(process_, signal);
  }

  /// Waits; the exit code, 128 + signal, or -1 if it goes on for longer.
  int wait(double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>{seconds};
    int status = 0;
    if (process_ <= 0) return -1;
    while (::waitpid(process_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > end) return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// Processor time that it has used [s].
  double used() const {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(process_, &clock) != 0 || ::clock_gettime(clock, &time) != 0)
      return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  /// Until it is at work: it has used so much processor time, however busy the machine is.
  void wait_until_used(double seconds) const {
    for (int i = 0; i < 6000 && used() < seconds; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }

  /// Until it has a handler for the signal: what comes earlier ends it like any program.
  void wait_until_catching(int signal) const {
    for (int i = 0; i < 6000 && !catches(signal); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }

  pid_t process() const { return process_; }

 private:
  bool catches(int signal) const {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:"))
        return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
    return false;
  }

  pid_t process_ = -1;
};

}  // namespace springfold::cli
