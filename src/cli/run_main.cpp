#include "run_main.hpp"

#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>

#include "animate_command.hpp"
#include "arguments.hpp"
#include "check_command.hpp"
#include "draw_command.hpp"
#include "exit_code.hpp"
#include "heap.hpp"
#include "import_command.hpp"
#include "in_time.hpp"
#include "interrupt.hpp"
#include "messages.hpp"
#include "plot_command.hpp"
#include "ranks.hpp"
#include "run_command.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "verify_command.hpp"

namespace springfold::cli {

namespace {

analysis::StudyResult run_planned(const io::PlannedRun& planned,
                                  const analysis::Observer& observer) {
  const auto* family = planned.family ? &*planned.family : nullptr;
  return analysis::run_study_after(planned.history, planned.mechanism, planned.plan, family,
                                   observer);
}

analysis::StudyResult run_planned_map(const io::PlannedRun& planned,
                                      const analysis::Observer& observer,
                                      const analysis::RunOptions& options) {
  return analysis::run_study_after(planned.history, planned.mechanism, planned.plan, nullptr,
                                   observer, options);
}

/// A command that has nothing to keep when a signal comes.
int run_whole(int (*command)(const Arguments&, const Session&), const Arguments& arguments,
              const Session& session) {
  const auto code = done_in_time<int>(
      [command, arguments, session] { return command(arguments, session); }, session);
  if (code) return *code;
  say(session.err, "interrupted: nothing is claimed");
  const int interrupted = interrupted_by(session.signal());
  session.leave_at_once(interrupted);
  return interrupted;
}

int run_parsed(const ParsedArguments& parsed, std::ostream& out, std::ostream& err,
               bool shows_progress, Ranks& ranks) {
  if (ranks.are_missed())
    say(err,
        "warning: mpirun started several processes, but this springfold has no MPI: each of them "
        "works alone");
  if (!parsed.error.empty()) {
    say(err, parsed.error);
    say(err, "try springfold --help");
    return wrong_usage;
  }
  if (!parsed.arguments) {
    out << parsed.text << std::flush;
    return out.good() ? all_done : input_output;
  }
  if (ranks.number() > 0 && parsed.arguments->command != Command::run) return all_done;
  take_memory_in_large_parts(parsed.arguments->threads);
  const InterruptGuard guard;
  const Session session{.out = out,
                        .err = err,
                        .shows_progress = shows_progress,
                        .signal = InterruptGuard::signal,
                        .run_study = run_planned,
                        .run_map = run_planned_map,
                        .leave_at_once = [](int code) { std::_Exit(code); },
                        .ranks = &ranks};
  switch (parsed.arguments->command) {
    case Command::check:
      return run_whole(check_command, *parsed.arguments, session);
    case Command::verify:
      return run_whole(verify_command, *parsed.arguments, session);
    case Command::draw:
      return run_whole(draw_command, *parsed.arguments, session);
    case Command::animate:
      return run_whole(animate_command, *parsed.arguments, session);
    case Command::plot:
      return plot_command(*parsed.arguments, session);
    case Command::import:
      return run_whole(import_command, *parsed.arguments, session);
    case Command::run:
      break;
  }
  return run_command(*parsed.arguments, session);
}

int run_guarded(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                bool shows_progress, Ranks& ranks) {
  try {
    return run_parsed(parse_arguments(argc, argv), out, err, shows_progress, ranks);
  } catch (const io::CaseError& error) {
    // Bare lines: editors jump to "file:line:column".
    for (const auto& message : error.messages()) err << message << "\n";
    say(err, "nothing was run and nothing was written");
    return wrong_case_file;
  } catch (const continuation::Interrupted&) {
    say(err, interrupted_reading_text);
    return interrupted_by(InterruptGuard::signal());
  } catch (const std::bad_alloc&) {
    err << out_of_memory_text;  // there may be no memory for a message that is put together
    return out_of_memory;
  } catch (const std::length_error&) {  // a container cannot be as large
    err << out_of_memory_text;
    return out_of_memory;
  } catch (const std::exception& error) {
    say(err, std::string{"internal error: "} + error.what());
  } catch (...) {
    say(err, "internal error");
  }
  return internal_error;
}

}  // namespace

int run_main(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
             bool shows_progress) noexcept {
  try {
    Ranks ranks;
    if (ranks.number() == 0) return run_guarded(argc, argv, out, err, shows_progress, ranks);
    std::ostringstream nowhere;  // of several processes one speaks
    return run_guarded(argc, argv, nowhere, nowhere, false, ranks);
  } catch (...) {
    return internal_error;
  }
}

}  // namespace springfold::cli
