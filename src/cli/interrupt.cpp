#include "interrupt.hpp"

#include <atomic>

namespace springfold::cli {

namespace {

// A signal handler can reach nothing but a global.
std::atomic<int> noted_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "handlers of signals may use nothing else");

extern "C" void note_signal(int signal) { noted_signal = signal; }

void install(int signal, void (*handler)(int), int flags, struct sigaction& old) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, &old);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  noted_signal = 0;
  const int once = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  install(SIGINT, note_signal, once, old_int_);
  install(SIGTERM, note_signal, once, old_term_);
  install(SIGPIPE, SIG_IGN, 0, old_pipe_);
  install(SIGXFSZ, SIG_IGN, 0, old_size_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
  sigaction(SIGPIPE, &old_pipe_, nullptr);
  sigaction(SIGXFSZ, &old_size_, nullptr);
}

int InterruptGuard::signal() { return noted_signal; }

}  // namespace springfold::cli
