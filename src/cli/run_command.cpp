#include "run_command.hpp"

#include <algorithm>
#include <csignal>
#include <stdexcept>

#include "exit_code.hpp"
#include "map_runs.hpp"
#include "progress.hpp"
#include "selection.hpp"
#include "springfold/io/checkpoint.hpp"
#include "springfold/io/plots.hpp"
#include "springfold/io/results.hpp"

namespace springfold::cli {

namespace {

namespace fs = std::filesystem;
using analysis::StudyResult;
using io::Case;

std::string name_of(const StudyResult& result) {
  return result.study + ", run " + std::to_string(result.run) +
         (result.label.empty() ? "" : " (" + result.label + ")");
}

void say(const Session& session, const std::string& message) {
  session.err << "springfold: " << message << "\n";
}

/// Runs until all is done or a signal comes. The run that the signal stops is kept as well.
std::vector<StudyResult> run_all(const Arguments& arguments, const fs::path& folder,
                                 const Case& the_case, const Session& session) {
  std::vector<StudyResult> results;
  Progress progress{session.err, session.shows_progress};
  for (const auto& planned : the_case.runs) {
    if (session.signal() != 0) break;
    const auto number = std::to_string(results.size() + 1) + "/" +
                        std::to_string(the_case.runs.size()) + " " + planned.study;
    progress.begin(planned.label.empty() ? number : number + ", " + planned.label);
    const bool is_map = planned.plan.kind == analysis::StudyKind::map && session.run_map;
    StudyResult result = is_map ? run_map(arguments, folder, the_case, planned, session, progress)
                                : session.run_study(planned, [&](int points, double) {
                                    progress.points(points);
                                    return session.signal() == 0;
                                  });
    result.study = planned.study;
    result.run = planned.run;
    result.label = planned.label;
    results.push_back(std::move(result));
  }
  return results;
}

/// Says what is missing in a result and gives its exit code.
int judge(const StudyResult& result, const Session& session) {
  if (!result.start.found) {
    say(session, name_of(result) + ": no trustworthy start point: " + result.start.message);
    return no_start_point;
  }
  for (const auto& branch : result.branches)
    for (const auto* stop : {&branch.backward, &branch.forward})
      if (!stop->complete) say(session, name_of(result) + ": stopped early: " + stop->reason);
  for (const auto& doubt : result.doubts) say(session, name_of(result) + ": unresolved: " + doubt);
  if (!analysis::complete(result)) return partial;
  const bool is_resolved = std::all_of(
      result.branches.begin(), result.branches.end(), [](const analysis::Branch& branch) {
        return std::none_of(branch.events.begin(), branch.events.end(), [](const auto& event) {
          return event.kind == analysis::EventKind::unresolved;
        });
      });
  if (is_resolved) return all_done;
  say(session, name_of(result) + ": has points that could not be resolved");
  return partial;
}

/// 4 before 5 before 0.
int worse(int a, int b) {
  if (a == no_start_point || b == no_start_point) return no_start_point;
  return std::max(a, b);
}

int judge_all(const std::vector<StudyResult>& results,
              const std::vector<io::Comparison>& comparisons, const Session& session) {
  int code = all_done;
  for (const auto& result : results) code = worse(code, judge(result, session));
  const auto failed = std::count_if(comparisons.begin(), comparisons.end(),
                                    [](const io::Comparison& c) { return !c.holds; });
  if (failed == 0) return code;
  say(session, std::to_string(failed) + " of " + std::to_string(comparisons.size()) +
                   " compared values do not hold: see NOT OK in the table");
  return worse(code, partial);
}

/// True if standard output took everything.
bool print(const Arguments& arguments, const Case& the_case,
           const std::vector<StudyResult>& results, const std::vector<io::Comparison>& comparisons,
           const Session& session) {
  if (arguments.prints_json) {
    session.out << io::summary_json(the_case, results);
  } else {
    session.out << io::summary_table(the_case, results);
    const std::string table = io::comparison_table(comparisons, the_case.expected);
    if (!table.empty()) session.out << "\n" << table;
  }
  session.out.flush();
  return session.out.good();
}

void draw(const fs::path& folder, const Case& the_case, const std::vector<StudyResult>& results,
          const Session& session) {
  const io::PlotOptions options{.stop_requested = [&] { return session.signal() != 0; }};
  const auto outcome = io::draw_plots(folder, the_case, results, options);
  for (const auto& warning : outcome.warnings) say(session, "warning: " + warning);
  if (!outcome.files.empty())
    say(session,
        std::to_string(outcome.files.size()) + " pictures in " + (folder / "plots").string());
}

std::string signal_name(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "a signal";
}

}  // namespace

int run_command(const Arguments& arguments, const Session& session) {
  Case the_case = io::load_case(arguments.case_file, arguments.overrides);
  if (const auto problem = unknown_study(the_case, arguments.studies); !problem.empty()) {
    say(session, problem);
    return wrong_usage;
  }
  the_case = with_studies(std::move(the_case), arguments.studies);
  const fs::path folder = arguments.folder.value_or(default_folder(arguments.case_file));
  if (const auto problem = problem_with_folder(folder); !problem.empty()) {
    say(session, problem);
    return input_output;
  }

  const auto results = run_all(arguments, folder, the_case, session);
  try {
    io::write_results(folder, the_case, results);
    const bool all_ran = results.size() == the_case.runs.size();
    if (all_ran && session.signal() == 0) io::remove_checkpoints(folder, the_case);
  } catch (const std::runtime_error& error) {
    say(session, error.what());
    return input_output;
  }
  const auto comparisons = io::compare(the_case.expected, results);
  const bool is_printed = print(arguments, the_case, results, comparisons, session);
  int code = judge_all(results, comparisons, session);
  say(session,
      "curves in " + (folder / "branches").string() + ", tables and summary in " + folder.string());
  if (arguments.draws_plots && session.signal() == 0) draw(folder, the_case, results, session);
  if (!is_printed) {
    say(session, "cannot write to standard output");
    code = input_output;
  }
  if (const int signal = session.signal(); signal != 0) {
    const auto whole = std::count_if(results.begin(), results.end(), analysis::complete);
    say(session, "interrupted by " + signal_name(signal) + ": " + std::to_string(whole) + " of " +
                     std::to_string(the_case.runs.size()) +
                     " runs are complete; what was found until then is in " + folder.string());
    code = interrupted_by(signal);
  }
  return code;
}

}  // namespace springfold::cli
