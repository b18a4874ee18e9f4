#include "draw_command.hpp"

#include <algorithm>
#include <stdexcept>

#include "exit_code.hpp"
#include "messages.hpp"
#include "picture_choice.hpp"
#include "selection.hpp"
#include "springfold/io/picture_files.hpp"
#include "springfold/io/postures.hpp"
#include "springfold/io/read_case.hpp"
#include "springfold/io/start_text.hpp"

namespace springfold::cli {

namespace {

using analysis::StudyKind;
using analysis::StudyResult;
using drawing::Panel;
using io::PlannedRun;

/// What is to be drawn, or the exit code if that is nothing.
struct Wanted {
  std::vector<Panel> panels{};
  int code = all_done;
};

/// "press/LP1": the label is behind the last slash.
struct Target {
  std::string study{}, label{};
};

Target target_of(const Arguments& arguments) {
  if (!arguments.draw_all.empty()) return {arguments.draw_all, ""};
  const auto slash = arguments.draw_at.rfind('/');
  if (slash == std::string::npos)
    return {arguments.studies.empty() ? "" : arguments.studies.front(), arguments.draw_at};
  return {arguments.draw_at.substr(0, slash), arguments.draw_at.substr(slash + 1)};
}

StudyResult result_of(const PlannedRun& run, const Session& session) {
  return session.run_study(run, [&](int, double) { return session.signal() == 0; });
}

/// Only the start of a study: one equilibrium.
PlannedRun start_alone(PlannedRun run) {
  run.plan.kind = StudyKind::equilibrium;
  run.plan.until.clear();
  run.plan.marks.clear();
  run.plan.branches = {};
  run.plan.snap.reset();
  // At the start they are zero, and an equilibrium has no lambda.
  std::erase_if(run.mechanism.loads, [](const model::Load& load) { return load.with_lambda; });
  return run;
}

Wanted first_equilibrium(const io::Case& the_case, const PlannedRun& run, const Session& session) {
  const StudyKind kind = run.plan.kind;
  if (kind == StudyKind::map || kind == StudyKind::workspace)
    return {{io::guess_panel(run, io::posture_title(run, "as it is given"))}};
  const PlannedRun alone = kind == StudyKind::control ? run : start_alone(run);
  const StudyResult result = result_of(alone, session);
  if (!result.branches.empty() && !result.branches.front().samples.empty()) {
    // The whole plan knows how the study drives the mechanism. But lambda of a start alone is zero,
    // not the parameter's value.
    const bool is_family = run.plan.control == analysis::ControlMode::parameter;
    const io::RowScenes scenes{is_family ? alone : run, result};
    const auto& row = result.branches.front().samples.front();
    if (auto panel =
            scenes.panel_of(row, io::posture_title(run, "first equilibrium"), the_case.units))
      return {{std::move(*panel)}};
  }
  say(session.err, run.study + ": no first equilibrium: " + io::start_problem(result.start, &run) +
                       "; this is the guess");
  return {{io::guess_panel(run, io::posture_title(run, "guess, no equilibrium"))}, no_start_point};
}

Wanted at_points(const Arguments& arguments, const io::Case& the_case, const PlannedRun& run,
                 const std::string& label, const Session& session) {
  const StudyResult result = result_of(run, session);
  const io::RowScenes scenes{run, result};
  std::vector<io::FoundRow> rows;
  if (arguments.draw_all.empty())
    rows.push_back(io::row_at(result, label));
  else
    rows = io::special_postures(result);
  Wanted wanted;
  for (const io::FoundRow& row : rows) {
    if (row.row == nullptr) continue;
    const std::string title =
        arguments.draw_all.empty() ? io::posture_title(run, row.title) : row.title;
    if (auto panel = scenes.panel_of(*row.row, title, the_case.units))
      wanted.panels.push_back(std::move(*panel));
  }
  if (!wanted.panels.empty()) return wanted;
  wanted.code = result.start.found ? wrong_usage : no_start_point;
  const bool knows_postures = !result.start.found || scenes.has_postures();
  say(session.err, io::why_no_posture(run, result, label) +
                       (knows_postures ? "" : "; try springfold draw without --at"));
  return wanted;
}

/// @returns the exit code
int write(const std::filesystem::path& file, const drawing::Picture& picture,
          const Session& session) {
  try {
    const std::string missing = io::write_picture(picture, file);
    say(session.err, missing.empty() ? "picture in " + file.string() : missing);
    return missing.empty() ? all_done : input_output;
  } catch (const std::runtime_error& error) {
    say(session.err, error.what());
    return input_output;
  }
}

std::filesystem::path file_of(const Arguments& arguments) {
  if (arguments.picture_file) return *arguments.picture_file;
  return default_folder(arguments.case_file) / "drawing.svg";
}

}  // namespace

int draw_guess(const Arguments& arguments, const io::Case& the_case, const Session& session) {
  if (the_case.runs.empty()) return all_done;
  const PlannedRun& run = the_case.runs.front();
  const Panel panel = io::guess_panel(run, io::posture_title(run, "as it is given"));
  return write(file_of(arguments), illustrate({panel}, options_of(arguments, the_case)), session);
}

int draw_command(const Arguments& arguments, const Session& session) {
  const io::Case the_case =
      io::load_case(arguments.case_file, arguments.overrides, stop_request_of(session));
  const Target target = target_of(arguments);
  if (!target.study.empty())
    if (const auto problem = unknown_study(the_case, {target.study}); !problem.empty()) {
      say(session.err, problem);
      return wrong_usage;
    }
  const PlannedRun* run = run_of(the_case, target.study, arguments.run_number);
  if (run == nullptr) {
    say(session.err, "there is no run " + std::to_string(arguments.run_number) + " to draw");
    return wrong_usage;
  }
  for (const auto& remark :
       settings_without_effect(with_studies(the_case, {run->study}), arguments.overrides))
    say(session.err, remark);
  Wanted wanted;
  if (arguments.draws_guess)
    wanted.panels = {io::guess_panel(*run, io::posture_title(*run, "guess"))};
  else if (target.label.empty() && arguments.draw_all.empty())
    wanted = first_equilibrium(the_case, *run, session);
  else
    wanted = at_points(arguments, the_case, *run, target.label, session);
  if (const int signal = session.signal(); signal != 0) return interrupted_by(signal);
  if (wanted.panels.empty()) return wanted.code;
  const auto picture = illustrate(wanted.panels, options_of(arguments, the_case));
  const int code = write(file_of(arguments), picture, session);
  return code == all_done ? wanted.code : code;
}

}  // namespace springfold::cli
