// Campaign of guyed columns and frames: random structures whose cables are stretched, slack or just at rest while the
// load grows, run as case files and judged against closed forms of the linearised cones.
//
//     guyed [N] [seed] [--check] [--threads n] [--named file] [--draw i] [--verbose] [--case file]
//           [--space-frames] [--mixed] [--wide]
//
// Draw i of a seed is always the same problem. --named: the draws of a file instead of N of a seed. README.md says what
// is drawn and what is judged. With --check the exit code is 1 if anything is wrong, or more than one draw in a hundred
// is unresolved.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <thread>

#include "judge.hpp"
#include "springfold/analysis/history.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::guyed {
namespace {

struct Settings {
  long count = 1000;
  unsigned long long seed = 1;
  unsigned threads = 1;
  long draw = -1;  ///< only this one
  bool verbose = false, check = false;
  Kind kind{};
  std::string file{};   ///< where the case of the draw is kept
  std::string named{};  ///< draws of this file instead
};

struct DrawName {
  unsigned long long seed = 1;
  long number = 0;
  Kind kind{};
};

struct Judged {
  DrawName name{};
  std::string family{};
  double pretension = 0;
  Verdict verdict{};
  double seconds = 0;
};

analysis::StudyResult run_case(const std::string& text, const std::filesystem::path& file) {
  std::ofstream{file, std::ios::binary} << text;
  const io::Case read = io::load_case(file);
  const io::PlannedRun& planned = read.runs.at(0);
  return analysis::run_study_after(planned.history, planned.mechanism, planned.plan, nullptr);
}

void print_truth(const Draw& draw) {
  for (const double at_rest : {1e-15, told_as_resting}) {
    const Truth known = truth(draw.structure, at_rest);
    std::printf("  at rest within %g:\n", at_rest);
    for (const HalfBranch& branch : known.leaving) {
      std::printf("    %.14g  direction", branch.load);
      for (const double w : branch.direction) std::printf(" %.4g", w);
      std::printf("%s\n", branch.load > draw.to ? "  (beyond the range)" : "");
    }
  }
}

/// As files of draws have it.
std::string name_of(const Kind& kind) {
  std::string name;
  const auto add = [&name](bool is, const char* word) {
    if (is) name += (name.empty() ? "" : " ") + std::string{word};
  };
  add(kind.space_frame, "frame in space");
  add(kind.mixed, "mixed");
  add(kind.wide, "wide");
  return name;
}

std::optional<Kind> kind_named(const std::string& name) {
  for (unsigned pattern = 0; pattern < 8; ++pattern) {
    const Kind kind{(pattern & 1u) != 0, (pattern & 2u) != 0, (pattern & 4u) != 0};
    if (name == name_of(kind)) return kind;
  }
  return std::nullopt;
}

/// Lines "seed draw # what it showed"; before the # "frame in space": a draw of --space-frames, "mixed": one of
/// --mixed, "wide": one of --wide, in this order. @throws std::runtime_error with the line that cannot be read
std::vector<DrawName> read_names(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  std::vector<DrawName> names;
  int count = 0;
  for (std::string line; std::getline(file, line);) {
    ++count;
    std::istringstream words(line.substr(0, line.find('#')));
    DrawName name;
    if (!(words >> std::ws) || words.eof()) continue;
    std::string family;
    const bool numbers = static_cast<bool>(words >> name.seed >> name.number) && name.number >= 0;
    std::getline(words >> std::ws, family);
    while (!family.empty() && family.back() == ' ') family.pop_back();
    const auto kind = kind_named(family);
    if (!numbers || !kind)
      throw std::runtime_error(
          path + ":" + std::to_string(count) +
          ": need seed and draw, perhaps \"frame in space\", \"mixed\", \"wide\" or several");
    name.kind = *kind;
    names.push_back(name);
  }
  return names;
}

std::vector<DrawName> draws_of(const Settings& settings) {
  if (!settings.named.empty()) return read_names(settings.named);
  if (settings.draw >= 0) return {{settings.seed, settings.draw, settings.kind}};
  std::vector<DrawName> names;
  for (long i = 0; i < settings.count; ++i) names.push_back({settings.seed, i, settings.kind});
  return names;
}

Judged run(const Settings& settings, const DrawName& name) {
  const long number = name.number;
  Random random(name.seed * 1000003ull + static_cast<unsigned long long>(number));
  const Draw drawn = draw(random, name.kind);
  const auto file = settings.file.empty()
                        ? std::filesystem::temp_directory_path() /
                              ("guyed-" + std::to_string(::getpid()) + "-" +
                               std::to_string(name.seed) + "-" + std::to_string(number) + ".toml")
                        : std::filesystem::path(settings.file);
  Judged judged{.name = name, .family = drawn.family, .pretension = drawn.pretension};
  if (settings.verbose) print_truth(drawn);
  try {
    const analysis::StudyResult result = run_case(drawn.text, file);
    judged.verdict = judge(drawn, result);
    judged.seconds = result.seconds;
  } catch (const std::exception& e) {
    judged.verdict = {Outcome::wrong, {}, {std::string("exception: ") + e.what()}};
  }
  if (settings.file.empty()) std::filesystem::remove(file);
  return judged;
}

std::vector<Judged> run_all(const Settings& settings, const std::vector<DrawName>& names) {
  std::vector<Judged> results(names.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < names.size(); i = next++) results[i] = run(settings, names[i]);
  };
  std::vector<std::jthread> threads;
  for (unsigned t = 1; t < settings.threads; ++t) threads.emplace_back(work);
  work();
  threads.clear();
  return results;
}

void print(const Judged& judged, bool all) {
  const Verdict& verdict = judged.verdict;
  std::printf("seed %llu, draw %ld, %s, pretension %g, %.2f s: %s\n", judged.name.seed,
              judged.name.number, judged.family.c_str(), judged.pretension, judged.seconds,
              verdict.outcome == Outcome::wrong        ? "WRONG"
              : verdict.outcome == Outcome::unresolved ? "unresolved"
                                                       : "right");
  const std::size_t most = all ? 100 : 3;
  for (std::size_t i = 0; i < std::min(most, verdict.faults.size()); ++i)
    std::printf("    %s\n", verdict.faults[i].c_str());
  for (std::size_t i = 0; i < std::min(most, verdict.reasons.size()); ++i)
    std::printf("    said: %s\n", verdict.reasons[i].c_str());
}

struct Tally {
  long right = 0, unresolved = 0, wrong = 0;
  void add(Outcome outcome) {
    ++(outcome == Outcome::right ? right : outcome == Outcome::unresolved ? unresolved : wrong);
  }
};

void print(const std::map<std::string, Tally>& table) {
  std::printf("%-34s %8s %12s %8s\n", "", "right", "unresolved", "wrong");
  for (const auto& [name, tally] : table)
    std::printf("%-34s %8ld %12ld %8ld\n", name.c_str(), tally.right, tally.unresolved,
                tally.wrong);
}

/// Is everything right, but for one draw in a hundred that is unresolved?
bool report(const std::vector<Judged>& results, const Settings& settings) {
  std::map<std::string, Tally> by_pretension, by_family;
  Tally all;
  double seconds = 0;
  for (const Judged& judged : results) {
    const Outcome outcome = judged.verdict.outcome;
    if (settings.verbose || outcome != Outcome::right) print(judged, settings.verbose);
    char name[40];
    if (std::isnan(judged.pretension))
      std::snprintf(name, sizeof name, "pretensions of their own");
    else
      std::snprintf(name, sizeof name, "pretension %g", judged.pretension);
    by_pretension[name].add(outcome);
    by_family[judged.family].add(outcome);
    all.add(outcome);
    seconds += judged.seconds;
  }
  by_family["all"] = all;
  std::printf("\n");
  print(by_pretension);
  print(by_family);
  std::printf("%.1f s of computation\n", seconds);
  return all.wrong == 0 && 100 * all.unresolved <= static_cast<long>(results.size());
}

}  // namespace
}  // namespace springfold::guyed

int main(int argc, char** argv) {
  using namespace springfold::guyed;
  Settings settings;
  CLI::App app("Random guyed columns and frames: what leaves their upright state?");
  app.add_option("N", settings.count, "number of draws")->check(CLI::NonNegativeNumber);
  app.add_option("seed", settings.seed, "the same seed gives the same draws");
  app.add_option("--threads", settings.threads, "default: 1")->check(CLI::Range(1, 256));
  app.add_option("--named", settings.named, "a file of lines: seed, draw; instead of N and seed");
  app.add_option("--draw", settings.draw, "only this draw");
  app.add_option("--case", settings.file, "with --draw: keep the case in this file");
  app.add_flag("--space-frames", settings.kind.space_frame, "frames in space, nothing else");
  app.add_flag("--mixed", settings.kind.mixed, "every cable, or pair, has a pretension of its own");
  app.add_flag("--wide", settings.kind.wide, "stiffnesses of cables from 1e-4 to 1e4");
  app.add_flag("--verbose", settings.verbose, "all that was expected and found");
  app.add_flag("--check", settings.check, "exit code 1 if a requirement is not met");
  CLI11_PARSE(app, argc, argv);
  if (settings.draw < 0 || !settings.named.empty()) settings.file.clear();
  try {
    const bool met = report(run_all(settings, draws_of(settings)), settings);
    return settings.check && !met ? 1 : 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "guyed: %s\n", e.what());
    return 2;
  }
}
