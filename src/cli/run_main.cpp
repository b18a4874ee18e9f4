#include "run_main.hpp"

#include <exception>

#include "arguments.hpp"
#include "check_command.hpp"
#include "exit_code.hpp"
#include "interrupt.hpp"
#include "run_command.hpp"
#include "verify_command.hpp"

namespace springfold::cli {

namespace {

analysis::StudyResult run_planned(const io::PlannedRun& planned,
                                  const analysis::Observer& observer) {
  const auto* family = planned.family ? &*planned.family : nullptr;
  return analysis::run_study(planned.mechanism, planned.plan, family, observer);
}

analysis::StudyResult run_planned_map(const io::PlannedRun& planned,
                                      const analysis::Observer& observer,
                                      const analysis::RunOptions& options) {
  return analysis::run_study(planned.mechanism, planned.plan, nullptr, observer, options);
}

int run_parsed(const ParsedArguments& parsed, std::ostream& out, std::ostream& err,
               bool shows_progress) {
  if (!parsed.error.empty()) {
    err << "springfold: " << parsed.error << "\nspringfold: try springfold --help\n";
    return wrong_usage;
  }
  if (!parsed.arguments) {
    out << parsed.text << std::flush;
    return out.good() ? all_done : input_output;
  }
  const InterruptGuard guard;
  const Session session{.out = out,
                        .err = err,
                        .shows_progress = shows_progress,
                        .signal = InterruptGuard::signal,
                        .run_study = run_planned,
                        .run_map = run_planned_map};
  switch (parsed.arguments->command) {
    case Command::check:
      return check_command(*parsed.arguments, session);
    case Command::verify:
      return verify_command(*parsed.arguments, session);
    case Command::run:
      break;
  }
  return run_command(*parsed.arguments, session);
}

}  // namespace

int run_main(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
             bool shows_progress) noexcept {
  try {
    return run_parsed(parse_arguments(argc, argv), out, err, shows_progress);
  } catch (const io::CaseError& error) {
    // Bare lines: editors jump to "file:line:column".
    for (const auto& message : error.messages()) err << message << "\n";
    err << "springfold: nothing was run and nothing was written\n";
    return wrong_case_file;
  } catch (const std::exception& error) {
    err << "springfold: internal error: " << error.what() << "\n";
  } catch (...) {
    err << "springfold: internal error\n";
  }
  return internal_error;
}

}  // namespace springfold::cli
