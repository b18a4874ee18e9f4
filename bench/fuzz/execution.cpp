#include "execution.hpp"

#include <sys/time.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <sstream>

#include "cli/run_main.hpp"

namespace springfold::fuzz {
namespace {

namespace fs = std::filesystem;

struct Said {
  int code = 0;
  std::string out{}, err{};
};

Said call(const std::vector<std::string>& words) {
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  std::ostringstream out, err;
  Said said;
  said.code = cli::run_main(static_cast<int>(arguments.size()), arguments.data(), out, err);
  said.out = out.str();
  said.err = err.str();
  return said;
}

/// Until when a call is let be: so many seconds, or so many of CPU time.
struct Patience {
  double seconds = 0.2;
  bool of_cpu = false;
};

/// A call to whose process SIGINT is sent then, once, if it is not back by then.
Said call_within(const Patience& patience, const std::vector<std::string>& words) {
  static constexpr auto handler = [](int) { ::raise(SIGINT); };
  const auto clock = patience.of_cpu ? ITIMER_PROF : ITIMER_REAL;
  std::signal(patience.of_cpu ? SIGPROF : SIGALRM, handler);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(patience.seconds);
  const double rest = patience.seconds - std::floor(patience.seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(rest * 1e6);
  ::setitimer(clock, &timer, nullptr);
  Said said = call(words);
  timer.it_value = {};
  ::setitimer(clock, &timer, nullptr);
  return said;
}

bool is_control(char c) { return (static_cast<unsigned char>(c) < 32 && c != '\n') || c == 127; }

void check_texts(const Said& said, std::vector<std::string>& broken) {
  for (const std::string* text : {&said.out, &said.err})
    if (std::any_of(text->begin(), text->end(), is_control))
      broken.push_back("control characters reach the terminal");
  if (said.code == 3 && said.err.find("nothing was") == std::string::npos)
    broken.push_back("exit code 3 without saying that nothing was written");
}

bool is_one_of(int code, std::initializer_list<int> codes) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

}  // namespace

fs::path place_of(const Mutant& mutant, const fs::path& folder) {
  return folder / mutant.of.parent_path() / "fuzz.toml";
}

void put(const Mutant& mutant, const fs::path& folder) {
  const fs::path place = place_of(mutant, folder);
  std::ofstream(place, std::ios::binary) << mutant.text;
  const fs::path included = place.parent_path() / "fuzz-include.toml";
  if (mutant.included)
    std::ofstream(included, std::ios::binary) << *mutant.included;
  else
    fs::remove(included);
}

Outcome execute(Mode mode, const fs::path& case_file, const fs::path& out, bool draws) {
  Outcome outcome;
  fs::remove_all(out);  // of a run that was given up, and this process with it
  std::vector<std::string> check{"springfold", "check", case_file.string()};
  if (mode != Mode::check) check.push_back("--no-solve");  // starts without end are stopped below
  const Said checked = call_within({long_check, true}, check);
  outcome.code = checked.code;
  outcome.accepted = is_one_of(checked.code, {0, 4});  // 4: its start is not found
  check_texts(checked, outcome.broken);
  if (!is_one_of(checked.code, {0, 3, 4, 6, 7, ended_by_signal}))
    outcome.broken.push_back("exit code of check");
  if (mode == Mode::check) return outcome;

  std::vector<std::string> words{"springfold", "run", case_file.string(), "--out", out.string()};
  if (!draws) words.push_back("--no-plots");
  const bool to_its_end = mode == Mode::uncapped;
  const Said said = call_within(to_its_end ? Patience{long_run, true} : Patience{}, words);
  outcome.code = said.code;
  check_texts(said, outcome.broken);
  if (!is_one_of(said.code, {0, 3, 4, 5, 6, 7, ended_by_signal}))
    outcome.broken.push_back("exit code of run");
  if (outcome.accepted && said.code == 3)
    outcome.broken.push_back("run refuses what check accepts");
  if (!outcome.accepted && said.code != checked.code &&
      said.code != ended_by_signal)  // before it was read
    outcome.broken.push_back("run accepts what check refuses");
  if (said.code == 3 && fs::exists(out)) outcome.broken.push_back("written with exit code 3");
  const bool wrote =
      is_one_of(said.code, {0, 4, 5}) || (to_its_end && said.code == ended_by_signal);
  if (wrote && !fs::exists(out / "manifest.json")) outcome.broken.push_back("no manifest");
  fs::remove_all(out);
  return outcome;
}

}  // namespace springfold::fuzz
