#include "animate_command.hpp"

#include <stdexcept>

#include "exit_code.hpp"
#include "messages.hpp"
#include "picture_choice.hpp"
#include "selection.hpp"
#include "springfold/io/film.hpp"
#include "springfold/io/picture_files.hpp"
#include "springfold/io/read_case.hpp"
#include "springfold/io/start_text.hpp"

namespace springfold::cli {

namespace {

io::FilmWish wish_of(const Arguments& arguments) {
  return {.from = arguments.film_from,
          .to = arguments.film_to,
          .mode = arguments.film_mode,
          .branch = arguments.film_branch,
          .jump = arguments.film_jump,
          .frames = arguments.frames};
}

/// The study that is named; otherwise the first that follows a curve.
std::string study_of(const Arguments& arguments, const io::Case& the_case) {
  if (!arguments.studies.empty()) return arguments.studies.front();
  for (const io::PlannedRun& run : the_case.runs)
    if (run.plan.kind == analysis::StudyKind::force_deflection) return run.study;
  return "";
}

/// @returns the exit code
int write(const std::filesystem::path& file, const drawing::Movie& movie, const Session& session) {
  try {
    io::write_movie(movie, file);
    say(session.err, "movie in " + file.string());
    return all_done;
  } catch (const std::runtime_error& error) {
    say(session.err, error.what());
    return input_output;
  }
}

/// Traces the run, and once more with rows for the frames.
io::FilmOutcome film_of(const io::Case& the_case, const io::PlannedRun& run,
                        const io::FilmWish& wish, const Session& session) {
  const auto traced = [&](const io::PlannedRun& planned) {
    auto result = session.run_study(planned, [&](int, double) { return session.signal() == 0; });
    result.study = run.study;
    result.run = run.run;
    result.label = run.label;
    return result;
  };
  const auto result = traced(run);
  if (!result.start.found && !result.start.message.empty())
    return {.problem = run.study + ": " + io::start_problem(result.start, &run),
            .has_start = false};
  if (session.signal() != 0) return {};
  const io::PlannedRun fine = io::with_rows_for(wish, run, result);
  return io::film_of(fine, traced(fine), the_case.units, wish);
}

}  // namespace

int animate_command(const Arguments& arguments, const Session& session) {
  const io::Case the_case =
      io::load_case(arguments.case_file, arguments.overrides, stop_request_of(session));
  const std::string study = study_of(arguments, the_case);
  if (!study.empty())
    if (const auto problem = unknown_study(the_case, {study}); !problem.empty()) {
      say(session.err, problem);
      return wrong_usage;
    }
  const io::PlannedRun* run = run_of(the_case, study, arguments.run_number);
  if (run == nullptr) {
    say(session.err, "there is no run " + std::to_string(arguments.run_number) + " to animate");
    return wrong_usage;
  }
  for (const auto& remark :
       settings_without_effect(with_studies(the_case, {run->study}), arguments.overrides))
    say(session.err, remark);
  const io::FilmOutcome outcome = film_of(the_case, *run, wish_of(arguments), session);
  if (const int signal = session.signal(); signal != 0) return interrupted_by(signal);
  if (!outcome.problem.empty()) {
    say(session.err, outcome.problem);
    return outcome.has_start ? wrong_usage : no_start_point;
  }
  const auto file =
      arguments.picture_file.value_or(default_folder(arguments.case_file) / "animation.svg");
  return write(file, animate(outcome.film, options_of(arguments, the_case)), session);
}

}  // namespace springfold::cli
