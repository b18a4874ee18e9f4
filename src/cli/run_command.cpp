#include "run_command.hpp"

#include <algorithm>
#include <csignal>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "exit_code.hpp"
#include "in_time.hpp"
#include "messages.hpp"
#include "ranks.hpp"
#include "runs.hpp"
#include "selection.hpp"
#include "springfold/io/checkpoint.hpp"
#include "springfold/io/plots.hpp"
#include "springfold/io/read_case.hpp"
#include "springfold/io/report.hpp"
#include "springfold/io/result_folder.hpp"
#include "springfold/io/results.hpp"
#include "springfold/io/start_text.hpp"
#include "springfold/io/summary_detail.hpp"

namespace springfold::cli {

namespace {

namespace fs = std::filesystem;
using analysis::StudyResult;
using io::Case;
using io::PlannedRun;

std::string name_of(const StudyResult& result) {
  return result.study + ", run " + std::to_string(result.run) +
         (result.label.empty() ? "" : " (" + result.label + ")");
}

/// What is good to know, and no trouble.
void note(const Arguments& arguments, const Session& session, const std::string& message) {
  if (!arguments.is_quiet) say(session, message);
}

void say_unresolved_points(const StudyResult& result, const Session& session) {
  for (std::size_t b = 0; b < result.branches.size(); ++b)
    for (const auto& event : result.branches[b].events)
      if (event.kind == analysis::EventKind::unresolved)
        say(session, name_of(result) + ": " + event.label + " of branch " + std::to_string(b + 1) +
                         " is unresolved: " + event.detail);
}

/// Says what is missing in a result and gives its exit code.
int judge(const Case& the_case, const StudyResult& result, const Session& session) {
  const auto planned =
      std::find_if(the_case.runs.begin(), the_case.runs.end(), [&](const io::PlannedRun& run) {
        return run.run == result.run && run.study == result.study;
      });
  const io::PlannedRun* plan = planned == the_case.runs.end() ? nullptr : &*planned;
  const std::string problem = io::start_problem(result.start, plan);
  if (!result.start.found) {
    say(session, name_of(result) + ": no trustworthy start point: " + problem);
    return no_start_point;
  }
  if (!problem.empty()) {
    say(session, name_of(result) + ": nothing was traced: " + problem);
    return no_start_point;
  }
  bool is_said = !result.doubts.empty();
  for (const auto& branch : result.branches)
    for (const auto* stop : {&branch.backward, &branch.forward})
      if (!stop->complete) {
        say(session, name_of(result) + ": stopped early: " + stop->reason);
        is_said = true;
      }
  for (const auto& doubt : result.doubts)
    say(session, name_of(result) + ": unresolved: " + io::with_place(doubt, plan));
  if (!is_said) say_unresolved_points(result, session);
  return analysis::complete(result) ? all_done : partial;
}

/// 4 before 5 before 0.
int worse(int a, int b) {
  if (a == no_start_point || b == no_start_point) return no_start_point;
  return std::max(a, b);
}

/// Of many runs it is said how many are not complete; their table says why.
int judge_rows(const Case& the_case, const Results& results, const Session& session) {
  int code = all_done;
  std::map<std::string, int> incomplete;
  for (const StudyResult& result : results.list) {
    if (!result.row || result.row->complete) continue;
    ++incomplete[result.study];
    const bool has_start = result.start.found && result.start.outside.empty();
    code = worse(code, has_start ? partial : no_start_point);
  }
  for (const auto& sweep : the_case.sweeps)
    if (const int count = incomplete[sweep.study]; count > 0)
      say(session, sweep.study + ": " + std::to_string(count) +
                       " runs are not complete: see the column status of their table");
  return code;
}

int judge_all(const Case& the_case, const Results& results,
              const std::vector<io::Comparison>& comparisons, const Session& session) {
  int code = judge_rows(the_case, results, session);
  for (std::size_t i = 0; i < results.list.size(); ++i) {
    const StudyResult& result = results.list[i];
    if (result.row) continue;
    if (results.interrupted[i])
      say(session, name_of(result) + ": interrupted");
    else
      code = worse(code, judge(the_case, result, session));
  }
  for (const PlannedRun* run : results.given_up)
    say(session, run->study + ", run " + std::to_string(run->run) +
                     ": interrupted in the middle of a step: nothing of it is kept");
  const auto how_many = [&](bool interrupted) {
    return std::count_if(comparisons.begin(), comparisons.end(), [&](const io::Comparison& c) {
      return !c.holds && c.is_interrupted == interrupted;
    });
  };
  const std::string all = " of " + std::to_string(comparisons.size()) + " compared values ";
  if (const auto unknown = how_many(true); unknown > 0)
    say(session, std::to_string(unknown) + all + "were not computed (interrupted)");
  const auto failed = how_many(false);
  if (failed == 0) return code;
  say(session, std::to_string(failed) + all + "do not hold: see NOT OK in the table");
  return worse(code, partial);
}

/// Of runs that a signal kept from their end, values that do not hold are not wrong: they are not known.
std::vector<io::Comparison> compared(const Case& the_case, const Results& results,
                                     const Session& session) {
  auto comparisons = io::compare(the_case.expected, results.list);
  if (session.signal() == 0) return comparisons;
  for (io::Comparison& c : comparisons) {
    bool has_ended = false;
    for (std::size_t i = 0; i < results.list.size(); ++i)
      has_ended |= results.list[i].study == c.expected.study &&
                   results.list[i].run == c.expected.run && !results.interrupted[i];
    c.is_interrupted = !has_ended && !c.holds;
  }
  return comparisons;
}

/// True if standard output took everything.
bool print(const Arguments& arguments, const Case& the_case,
           const std::vector<StudyResult>& results, const std::vector<io::Comparison>& comparisons,
           const Session& session) {
  if (arguments.prints_json) {
    session.out << io::summary_json(the_case, results);
  } else {
    session.out << (arguments.is_quiet     ? io::outline_text(the_case, results)
                    : arguments.is_verbose ? io::detailed_summary_table(the_case, results)
                                           : io::summary_table(the_case, results));
    if (arguments.is_verbose) session.out << io::steps_table(results);
    const std::string table = io::comparison_table(comparisons, the_case.expected);
    if (!table.empty() && !arguments.is_quiet) session.out << "\n" << table;
  }
  session.out.flush();
  return session.out.good();
}

/// @returns the pictures that are missing
std::vector<std::string> draw(const fs::path& folder, const Arguments& arguments,
                              const Case& the_case, const std::vector<StudyResult>& results,
                              const Session& session) {
  const io::PlotOptions options{.stop_requested = stop_request_of(session)};
  const auto outcome = io::draw_plots(folder, the_case, results, options);
  for (const auto& warning : outcome.warnings) say(session, "warning: " + warning);
  if (!outcome.files.empty())
    note(arguments, session,
         std::to_string(outcome.files.size()) + " pictures in " + (folder / "plots").string());
  return outcome.missing;
}

std::string signal_name(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "a signal";
}

/// "; not drawn: a, b"; empty if there are none.
std::string list_of(const std::string& what, const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) text += (text.empty() ? "; " + what + ": " : ", ") + file;
  return text;
}

/// What was wanted and is not there.
struct Missing {
  std::vector<std::string> pictures{}, tables{};
  std::vector<std::string> all() const {
    std::vector<std::string> files = tables;
    files.insert(files.end(), pictures.begin(), pictures.end());
    return files;
  }
};

/// What a signal left: never that all is complete.
std::string interruption(int signal, const Case& the_case, const Results& results,
                         const Missing& missing, const fs::path& folder) {
  const std::string begin = "interrupted by " + signal_name(signal),
                    tables = list_of("there was no time to write", missing.tables);
  if (!results.all_done(the_case)) {
    const auto whole = std::count_if(results.list.begin(), results.list.end(), analysis::complete);
    return begin + ": " + std::to_string(whole) + " of " + std::to_string(the_case.runs.size()) +
           " runs are complete; what was found until then is in " + folder.string() + tables;
  }
  return begin + " after all runs were done: their results are in " + folder.string() + tables +
         list_of("not drawn", missing.pictures);
}

/// How long results are written after a signal: with what follows it makes less than a second. Runs that took long to
/// end leave a moment all the same, enough for all but very large tables.
std::function<bool()> end_of_writing(const Results& results, const Session& session) {
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds after_signal{400}, at_least{150};
  return [&session, since = results.signal_since, begin = Clock::now()]() mutable {
    if (!session.signal || session.signal() == 0) return false;
    const auto now = Clock::now();
    if (!since) since = now;
    return now > std::max(*since + after_signal, begin + at_least);
  };
}

std::string shortage(const Case& the_case, const std::vector<StudyResult>& results,
                     const PlannedRun& failed) {
  return "out of memory in " + failed.study + ", run " + std::to_string(failed.run) + ": " +
         std::to_string(results.size()) + " of " + std::to_string(the_case.runs.size()) +
         " runs were done and are written";
}

/// Says what keeps `write` from its work. @returns whether it was done
bool is_done(const std::function<void()>& write, const Session& session) {
  try {
    write();
    return true;
  } catch (const std::runtime_error& error) {
    say(session, error.what());
    return false;
  }
}

/// How a run ended.
struct Ending {
  int code = all_done;
  bool gave_up = false;  ///< a thread is still at work
};

/// Runs all, writes, prints, draws.
Ending run_in(const fs::path& folder, const Arguments& arguments,
              const std::shared_ptr<const Case>& shared, const Session& session) {
  const Case& the_case = *shared;
  const Results all = run_all(arguments, folder, shared, session);
  const bool gave_up = !all.given_up.empty();
  const std::vector<StudyResult>& results = all.list;
  const bool is_whole = all.all_done(the_case);
  io::SetState state = is_whole ? io::SetState::whole : io::SetState::interrupted;
  // [report] of a case is no fault where the program has no page.
  const bool makes_report = arguments.makes_report || (the_case.wants_report && io::has_report());
  if (the_case.wants_report && !io::has_report())
    say(session, "no page: this springfold was built without it (-DSPRINGFOLD_REPORT=OFF)");
  Missing missing;
  const auto write = [&] {
    io::Deadline deadline{end_of_writing(all, session)};
    io::write_results(folder, the_case, results,
                      arguments.draws_plots ? io::SetState::being_written : state, makes_report,
                      &deadline);
    missing.tables = std::move(deadline.unwritten);
    if (!missing.tables.empty()) state = io::SetState::interrupted;
    if (is_whole && session.signal() == 0) io::remove_checkpoints(folder, the_case);
  };
  if (!is_done(write, session)) return {input_output, gave_up};
  const auto comparisons = compared(the_case, all, session);
  const bool is_printed = print(arguments, the_case, results, comparisons, session);
  int code = judge_all(the_case, all, comparisons, session);
  if (code != all_done)
    for (const auto& hint : the_case.hints) say(session, "hint: " + hint);
  const bool has_curves = std::any_of(results.begin(), results.end(),
                                      [](const StudyResult& r) { return !r.branches.empty(); });
  note(arguments, session,
       (has_curves ? "curves in " + (folder / "branches").string() + ", " : std::string{}) +
           "tables and summary in " + folder.string());
  if (makes_report) note(arguments, session, "page in " + (folder / "report.html").string());
  if (arguments.draws_plots) {
    missing.pictures = draw(folder, arguments, the_case, results, session);
    if (!is_done([&] { io::close_results(folder, state, missing.all()); }, session))
      code = input_output;
  }
  if (!is_printed) {
    say(session, "cannot write to standard output");
    code = input_output;
  }
  if (all.failed != nullptr) {
    say(session, shortage(the_case, results, *all.failed));
    code = out_of_memory;
  }
  if (const int signal = session.signal(); signal != 0) {
    say(session, interruption(signal, the_case, all, missing, folder));
    code = interrupted_by(signal);
  }
  return {code, gave_up};
}

}  // namespace

namespace {

/// Several processes go on only if all of them can.
bool all_can(bool this_one, const Session& session) {
  return session.ranks == nullptr ? this_one : session.ranks->all(this_one);
}

std::optional<Case> load(const Arguments& arguments, const Session& session) {
  try {
    auto loaded = done_in_time<Case>(
        [arguments, session] {
          return io::load_case(arguments.case_file, arguments.overrides, stop_request_of(session));
        },
        session);
    if (!loaded) {
      say(session, interrupted_reading_text);
      session.leave_at_once(interrupted_by(session.signal()));
      return std::nullopt;
    }
    if (all_can(true, session)) return loaded;
  } catch (...) {
    all_can(false, session);
    throw;
  }
  throw std::runtime_error("another process of mpirun could not read the case");
}

/// A process that does its part of sweeps for process 0 and writes nothing.
int help(const Arguments& arguments, const std::shared_ptr<const Case>& the_case,
         const Session& session) {
  if (!all_can(true, session)) return all_done;
  const Results results = run_all(arguments, {}, the_case, session);
  if (session.signal() == 0) return all_done;
  session.ranks->give_up();
  if (!results.given_up.empty()) session.leave_at_once(interrupted_by(session.signal()));
  return interrupted_by(session.signal());
}

bool is_helper(const Session& session) {
  return session.ranks != nullptr && session.ranks->number() > 0;
}

}  // namespace

int run_command(const Arguments& arguments, const Session& given) {
  Session session = given;
  if (arguments.is_quiet) session.shows_progress = false;
  if (arguments.makes_report && !io::has_report()) {
    say(session, "--report: this springfold was built without the page (-DSPRINGFOLD_REPORT=OFF)");
    return wrong_usage;
  }
  auto loaded = load(arguments, session);
  if (!loaded) return interrupted_by(session.signal());
  if (const auto problem = unknown_study(*loaded, arguments.studies); !problem.empty()) {
    say(session, problem);
    return wrong_usage;
  }
  const auto the_case =
      std::make_shared<const Case>(with_studies(std::move(*loaded), arguments.studies));
  if (is_helper(session)) return help(arguments, the_case, session);
  for (const auto& remark : settings_without_effect(*the_case, arguments.overrides))
    say(session, remark);
  const fs::path folder = arguments.folder.value_or(default_folder(arguments.case_file));
  const std::string problem = problem_with_folder(folder);
  if (!problem.empty()) say(session, problem);
  std::optional<io::FolderLock> lock;
  const bool usable = problem.empty() && is_done([&] { lock.emplace(folder); }, session);
  if (!all_can(usable, session)) return input_output;
  io::remove_leftovers(folder);
  const Ending ending = run_in(folder, arguments, the_case, session);
  lock.reset();
  if (session.ranks != nullptr && session.signal() != 0) session.ranks->give_up();
  if (ending.gave_up) session.leave_at_once(ending.code);
  return ending.code;
}

}  // namespace springfold::cli
