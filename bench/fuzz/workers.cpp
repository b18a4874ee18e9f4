#include "workers.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace springfold::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Executions of one process; a call that is broken off repeats them.
std::uint64_t batch_of(Mode mode) { return mode == Mode::check ? 100 : mode == Mode::run ? 20 : 4; }

/// CPU seconds after which a mutant has no end. On a machine that is busy with something else they last longer; what
/// waits without working has `patience` times as many seconds.
double limit_of(Mode mode) { return mode == Mode::run ? 60 : 300; }
constexpr double patience = 10;

/// Seconds that executions may go on when the time is over: then they are given up, to be done again next time.
constexpr double grace = 5;

/// CPU seconds that a process has taken; 0 once it is gone.
double cpu_seconds_of(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

const char* name_of(Mode mode) {
  return mode == Mode::check ? "check" : mode == Mode::run ? "run" : "uncapped";
}

Strength strength_of(Mode mode) { return mode == Mode::check ? Strength::wild : Strength::gentle; }

bool draws(const Settings& settings, std::uint64_t number) {
  return settings.mode == Mode::uncapped && number % 16 == 0;
}

/// What is remembered between calls.
struct Record {
  std::uint64_t next = 0, accepted = 0, found = 0;
  std::array<std::uint64_t, 256> codes{};
};

/// What a worker tells its parent; in memory that both share.
struct Board {
  std::uint64_t current = 0,
                done = 0;  ///< number of the mutant; behind the last one that is finished
  std::int64_t began = 0;  ///< of `current`, in the clock's ticks; 0: not yet
  double cpu_before = 0;   ///< seconds that the process had taken by then
  std::uint64_t accepted = 0, found = 0;
  std::array<std::uint64_t, 256> codes{};
};

/// A batch of executions that is over.
struct Finished {
  std::uint64_t first = 0, last = 0;
  Board board{};
};

fs::path record_of(const Settings& s) {
  return s.work / (std::string(name_of(s.mode)) + "-" + std::to_string(s.seed) + ".record");
}

Record read_record(const Settings& settings) {
  Record record;
  std::ifstream file(record_of(settings));
  if (!(file >> record.next >> record.accepted >> record.found)) return {};
  int code = 0;
  for (std::uint64_t count = 0; file >> code >> count;)
    if (code >= 0 && code < 256) record.codes[static_cast<std::size_t>(code)] = count;
  return record;
}

void write_record(const Settings& settings, const Record& record) {
  std::ofstream file(record_of(settings));
  file << record.next << ' ' << record.accepted << ' ' << record.found << '\n';
  for (std::size_t code = 0; code < record.codes.size(); ++code)
    if (record.codes[code] > 0) file << code << ' ' << record.codes[code] << '\n';
  if (!file.flush()) throw std::runtime_error(record_of(settings).string() + ": cannot be written");
}

std::string text_of_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void keep_finding(const Settings& settings, const Mutant& mutant, std::uint64_t number,
                  const std::string& what) {
  const fs::path folder = settings.work / "findings" /
                          (std::string(name_of(settings.mode)) + "-" +
                           std::to_string(settings.seed) + "-" + std::to_string(number));
  fs::create_directories(folder);
  std::ofstream(folder / "fuzz.toml", std::ios::binary) << mutant.text;
  if (mutant.included)
    std::ofstream(folder / "fuzz-include.toml", std::ios::binary) << *mutant.included;
  std::ofstream(folder / "what.txt") << "from " << mutant.of.string() << "\n" << what << "\n";
}

class Worker {
 public:
  Worker(const Settings& settings, const Corpus& corpus, int number)
      : settings_(settings),
        corpus_(corpus),
        folder_(settings.work / (std::string(name_of(settings.mode)) + std::to_string(number))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(settings.corpus, folder_ / "corpus", fs::copy_options::recursive);
    void* memory =
        ::mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
    board_ = new (memory) Board;
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    ::munmap(board_, sizeof(Board));
    fs::remove_all(folder_);
  }

  void begin(std::uint64_t first, std::uint64_t last) {
    *board_ = Board{.done = first};
    first_ = first;
    last_ = last;
    fork_child();
  }

  bool rests() const { return process_ == 0; }

  /// Ends the process in the middle of an execution. @returns what of its batch is finished
  Finished give_up() {
    int status = 0;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return {first_, board_->done, *board_};
  }

  /// Looks after the process. @returns the batch, once, when it is finished
  std::optional<Finished> look() {
    if (process_ == 0) return std::nullopt;
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == 0) {
      if (board_->began == 0 || !has_no_end()) return std::nullopt;
      ::kill(process_, SIGKILL);
      ::waitpid(process_, &status, 0);
      found("no end");
    } else if (WIFEXITED(status) && WEXITSTATUS(status) == ended_by_signal) {
      ++board_->accepted;  // it was at work, in the middle of a long step
      ++board_->codes[ended_by_signal];
      board_->done = board_->current + 1;
    } else if (!(WIFEXITED(status) && WEXITSTATUS(status) == 0)) {
      found("the process ended with status " + std::to_string(status) + "\n" + text_of_file(log()));
    }
    process_ = 0;
    if (board_->done >= last_) return Finished{first_, last_, *board_};
    fork_child();
    return std::nullopt;
  }

 private:
  bool has_no_end() const {
    const double limit = limit_of(settings_.mode);
    const Clock::duration age(Clock::now().time_since_epoch().count() - board_->began);
    return cpu_seconds_of(process_) - board_->cpu_before > limit ||
           age > std::chrono::duration<double>(patience * limit);
  }

  fs::path log() const { return folder_ / "log.txt"; }

  /// The mutant at which the process ended is stepped over.
  void found(const std::string& what) {
    const std::uint64_t number = board_->current;
    keep_finding(settings_, mutant(corpus_, settings_.seed, number, strength_of(settings_.mode)),
                 number, what);
    ++board_->found;
    board_->done = number + 1;
  }

  void fork_child() {
    board_->began = 0;
    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("fork failed");
    if (process_ > 0) return;
    work();
    std::_Exit(0);
  }

  void work() {
    const int file = ::open(log().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0644);
    ::dup2(file, 1);
    ::dup2(file, 2);
    std::signal(SIGINT, SIG_IGN);  // but while the program runs, which listens
    for (std::uint64_t i = board_->done; i < last_; ++i) {
      board_->current = i;
      board_->cpu_before = cpu_seconds_of(::getpid());
      board_->began = Clock::now().time_since_epoch().count();
      if (::ftruncate(file, 0) != 0) std::_Exit(3);
      const Mutant m = mutant(corpus_, settings_.seed, i, strength_of(settings_.mode));
      put(m, folder_ / "corpus");
      const Outcome outcome = execute(settings_.mode, place_of(m, folder_ / "corpus"),
                                      folder_ / "out", draws(settings_, i));
      board_->accepted += outcome.accepted;
      ++board_->codes[static_cast<std::size_t>(outcome.code & 255)];
      if (!outcome.broken.empty()) {
        std::string what = "exit code " + std::to_string(outcome.code);
        for (const std::string& rule : outcome.broken) what += "\n" + rule;
        keep_finding(settings_, m, i, what);
        ++board_->found;
      }
      board_->done = i + 1;
    }
  }

  const Settings& settings_;
  const Corpus& corpus_;
  fs::path folder_;
  Board* board_ = nullptr;
  std::uint64_t first_ = 0, last_ = 0;  ///< of its batch
  pid_t process_ = 0;
};

bool has_found(const std::pair<const std::uint64_t, Finished>& batch) {
  return batch.second.board.found > 0;
}

void add(const Board& board, Record& record) {
  record.accepted += board.accepted;
  record.found += board.found;
  for (std::size_t code = 0; code < record.codes.size(); ++code)
    record.codes[code] += board.codes[code];
}

void print(const Settings& settings, const Record& record, double seconds, std::ostream& out) {
  out << name_of(settings.mode) << ", seed " << settings.seed << ": " << record.next << " of "
      << settings.count << " executions, " << record.accepted << " accepted, " << record.found
      << " found; " << static_cast<long>(seconds) << " s; exit codes";
  for (std::size_t code = 0; code < record.codes.size(); ++code)
    if (record.codes[code] > 0) out << " " << code << ":" << record.codes[code];
  out << std::endl;
}

}  // namespace

int run_all(const Settings& settings, std::ostream& out) {
  fs::create_directories(settings.work);
  const Corpus corpus = read_corpus(settings.corpus);
  if (corpus.files.empty())
    throw std::runtime_error("no case files in " + settings.corpus.string());
  Record record = read_record(settings);
  std::vector<std::unique_ptr<Worker>> workers;
  for (int j = 0; j < settings.jobs; ++j)
    workers.push_back(std::make_unique<Worker>(settings, corpus, j));
  const auto begin = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  // What is finished before something that comes earlier waits for it: the record has no gaps.
  std::map<std::uint64_t, Finished> waiting;
  std::uint64_t next = record.next;
  while (true) {
    bool all_rest = true;
    for (auto& worker : workers) {
      if (const auto finished = worker->look()) waiting.insert({finished->first, *finished});
      if (!worker->rests() && seconds() > settings.seconds + grace) {
        const Finished part = worker->give_up();
        waiting.insert({part.first, part});
      }
      if (worker->rests() && next < settings.count && seconds() < settings.seconds) {
        const std::uint64_t last = std::min(next + batch_of(settings.mode), settings.count);
        worker->begin(next, last);
        next = last;
      }
      all_rest = all_rest && worker->rests();
    }
    while (!waiting.empty() && waiting.begin()->first == record.next) {
      add(waiting.begin()->second.board, record);
      record.next = waiting.begin()->second.last;
      waiting.erase(waiting.begin());
      write_record(settings, record);
    }
    if (all_rest) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  print(settings, record, seconds(), out);
  // Behind a batch that was given up they are done again next time, but what they found is told now.
  return record.found > 0 || std::any_of(waiting.begin(), waiting.end(), has_found) ? 1 : 0;
}

int run_one(const Settings& settings, std::ostream& out) {
  const Corpus corpus = read_corpus(settings.corpus);
  const Mutant m = mutant(corpus, settings.seed, *settings.only, strength_of(settings.mode));
  const fs::path folder = settings.work / "only";
  fs::remove_all(folder);
  fs::create_directories(folder);
  fs::copy(settings.corpus, folder / "corpus", fs::copy_options::recursive);
  put(m, folder / "corpus");
  out << "from " << m.of.string() << ", as " << place_of(m, folder / "corpus").string()
      << std::endl;
  const Outcome outcome = execute(settings.mode, place_of(m, folder / "corpus"), folder / "out",
                                  draws(settings, *settings.only));
  out << "exit code " << outcome.code << "\n";
  for (const std::string& rule : outcome.broken) out << rule << "\n";
  return outcome.broken.empty() ? 0 : 1;
}

}  // namespace springfold::fuzz
