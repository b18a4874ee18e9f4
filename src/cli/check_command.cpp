#include "check_command.hpp"

#include <fmt/format.h>

#include "draw_command.hpp"
#include "exit_code.hpp"
#include "messages.hpp"
#include "selection.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/read_case.hpp"
#include "springfold/io/shown_text.hpp"
#include "springfold/io/start_text.hpp"

namespace springfold::cli {

namespace {

using analysis::StudyKind;

/// "push, run 2 (Kv = 0.01)".
std::string name_of(const io::PlannedRun& planned) {
  return planned.study + ", run " + std::to_string(planned.run) +
         (planned.label.empty() ? "" : " (" + planned.label + ")");
}

/// One line for a start that is found but deserves a word.
std::string remark_on(const analysis::StartReport& start) {
  if (start.free_motions.empty()) return {};
  return fmt::format("nothing resists a motion of {}", start.free_motions);
}

/// Solves the starts of all runs up to a number that is solved in no time.
int check_starts(const io::Case& the_case, const Session& session) {
  constexpr std::size_t most = 50;
  std::size_t tried = 0, found = 0, left_out = 0;
  int code = all_done;
  for (const auto& planned : the_case.runs) {
    if (session.signal() != 0) break;
    if (tried == most) {
      ++left_out;
      continue;
    }
    const auto* family = planned.family ? &*planned.family : nullptr;
    const auto start =
        analysis::solve_start_after(planned.history, planned.mechanism, planned.plan, family);
    if (!start) continue;
    ++tried;
    const bool may_miss = planned.plan.kind == StudyKind::equilibria && !start->found;
    const std::string problem = io::start_problem(*start, &planned);
    if (may_miss)
      session.out << "  remark    " << io::shown(name_of(planned)) << ": none near the guess ("
                  << io::shown(problem) << "); the search looks elsewhere too\n";
    else if (!problem.empty())
      say(session.err,
          name_of(planned) + ": " +
              (start->found ? "nothing would be traced: " : "no trustworthy start point: ") +
              problem);
    if (!problem.empty() && !may_miss) code = no_start_point;
    if (problem.empty()) ++found;
    if (const std::string remark = remark_on(*start); problem.empty() && !remark.empty())
      session.out << "  remark    " << io::shown(name_of(planned) + ": " + remark) << "\n";
  }
  if (tried > 0)
    session.out << "  starts    " << found << " of " << tried << " found"
                << (left_out > 0 ? fmt::format("; {} more runs were not tried", left_out) : "")
                << "\n";
  return session.signal() != 0 ? interrupted_by(session.signal()) : code;
}

}  // namespace

int check_command(const Arguments& arguments, const Session& session) {
  const io::Case the_case =
      io::load_case(arguments.case_file, arguments.overrides, stop_request_of(session));
  session.out << description_of(the_case);
  for (const auto& remark : settings_without_effect(the_case, arguments.overrides))
    say(session.err, remark);
  for (const auto& hint : the_case.hints) session.out << "  hint      " << io::shown(hint) << "\n";
  int code = all_done;
  if (arguments.draws) code = draw_guess(arguments, the_case, session);
  if (arguments.solves_starts && code == all_done) code = check_starts(the_case, session);
  session.out.flush();
  if (session.out.good()) return code;
  say(session.err, "cannot write to standard output");
  return input_output;
}

}  // namespace springfold::cli
