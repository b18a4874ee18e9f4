#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "springfold/io/nearest.hpp"
#include "springfold/version.hpp"

namespace springfold::cli {

namespace {

constexpr const char* description =
    "springfold traces force-deflection curves of parallel manipulators with preloaded passive\n"
    "joints, through their limit points, and says where and why they lose stability.";

constexpr const char* examples =
    "Examples:\n"
    "  springfold run cases/orthoglide-planar/case.toml\n"
    "      all studies; tables on the screen, curves and figures in results/orthoglide-planar\n"
    "  springfold run case.toml --study push --set Kv=0.02 --set 'L=2*0.5' --out /tmp/push\n"
    "      one study with other parameter values, results in another folder\n"
    "  springfold run case.toml --json --no-plots > summary.json\n"
    "      for other programs\n"
    "  springfold check case.toml\n"
    "      reads the case, solves its starts, says what it contains or what is wrong with it\n"
    "  springfold draw case.toml --at push/LP1 --output lp1.svg\n"
    "      the mechanism in its posture at a special point\n"
    "  springfold animate case.toml --study push --output push.svg\n"
    "      the mechanism moved along the curve, beside it\n"
    "  springfold plot results/orthoglide-planar\n"
    "      the figures of an earlier run drawn again, nothing is run\n"
    "  springfold import miura.fold --output miura.toml\n"
    "      a case of bars and folds made of a mesh\n"
    "  springfold verify cases\n"
    "      all cases of a folder against their expected values, one table\n"
    "\n"
    "Exit codes: 0 all done, 2 wrong usage, 3 mistakes in the case file, 4 no trustworthy start\n"
    "point, 5 partial (stopped early, unresolved, or a compared value does not hold),\n"
    "6 input or output, 7 out of memory, 70 internal error, 130 and 143 interrupted.";

/// Adds "name=value"; false if it has not that form or the name was there already.
bool add_override(const std::string& text, std::map<std::string, std::string>& overrides,
                  std::string& error) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    error = "--set " + text + ": need name=value, for example --set Kv=0.02";
    return false;
  }
  const std::string name = text.substr(0, equals);
  if (overrides.emplace(name, text.substr(equals + 1)).second) return true;
  error = "--set " + name + "=...: given twice";
  return false;
}

/// A name that ends in .svg, .png or .pdf.
std::string picture_problem(const std::string& name) {
  const auto extension = std::filesystem::path{name}.extension();
  const bool is_known = extension == ".svg" || extension == ".png" || extension == ".pdf";
  return is_known ? "" : "need a name that ends in .svg, .png or .pdf";
}

/// Numbers of runs and branches.
std::string from_one_on(const std::string& text) {
  const bool is_number = !text.empty() && text.size() < 10 &&
                         text.find_first_not_of("0123456789") == std::string::npos;
  return is_number && std::stoi(text) > 0 ? "" : "need a whole number from 1 on";
}

void add_run_and_colours(CLI::App& command, Arguments& arguments) {
  command.add_option("--run", arguments.run_number, "Run of the study, along its vary list")
      ->type_name("N")
      ->check(from_one_on);
  command.add_option("--colour", arguments.colour, "What colours stand for")
      ->check(CLI::IsMember({"stability", "force", "energy", "none"}));
  command.add_option("--view", arguments.view, "Plane that is looked at, or perspective")
      ->check(CLI::IsMember({"xy", "xz", "yz", "perspective"}));
}

/// Options of pictures.
void add_drawing(CLI::App& draw, CLI::App& check, Arguments& arguments) {
  for (CLI::App* command : {&draw, &check})
    command
        ->add_option(
            "-o,--output", arguments.picture_file,
            "File for the picture, .svg, .png or .pdf (drawing.svg in the results' folder)")
        ->type_name("FILE")
        ->check(picture_problem);
  check.add_flag("--draw", arguments.draws, "Draw the mechanism as it was understood");
  draw.add_option("--study", arguments.studies, "Draw this study's mechanism (the first study)")
      ->type_name("NAME")
      ->expected(1)
      ->allow_extra_args(false);
  const auto at =
      draw.add_option("--at", arguments.draw_at,
                      "Posture at a special point, \"press/LP1\"; also start, end (the first "
                      "equilibrium when not given)")
          ->type_name("STUDY/LABEL");
  const auto all = draw.add_option("--all", arguments.draw_all,
                                   "Postures at the start and all special points of a study")
                       ->type_name("STUDY")
                       ->excludes(at);
  draw.add_flag("--guess", arguments.draws_guess, "The guess of the case, before it is solved")
      ->excludes(at)
      ->excludes(all);
  add_run_and_colours(draw, arguments);
}

/// Options of movies.
void add_animation(CLI::App& animate, Arguments& arguments) {
  animate
      .add_option("-o,--output", arguments.picture_file,
                  "File for the movie, .svg (animation.svg in the results' folder)")
      ->type_name("FILE")
      ->check([](const std::string& name) {
        return std::filesystem::path{name}.extension() == ".svg" ? ""
                                                                 : "need a name that ends in .svg";
      });
  animate
      .add_option("--study", arguments.studies,
                  "Along the curve of this study (the first that has one)")
      ->type_name("NAME")
      ->expected(1)
      ->allow_extra_args(false);
  const auto from =
      animate
          .add_option("--from", arguments.film_from, "Begin at this special point; also start, end")
          ->type_name("LABEL");
  const auto to =
      animate.add_option("--to", arguments.film_to, "End at this one")->type_name("LABEL");
  const auto mode = animate
                        .add_option("--mode", arguments.film_mode,
                                    "To and fro in the mode of this limit point or branch point "
                                    "instead of along the curve")
                        ->type_name("LABEL")
                        ->excludes(from)
                        ->excludes(to);
  const auto branch =
      animate
          .add_option("--branch", arguments.film_branch,
                      "Number of the branch, from 1 (the first that has the labels)")
          ->type_name("N")
          ->check(from_one_on);
  animate
      .add_option("--jump", arguments.film_jump,
                  "The jump of this label to its landing instead of along the curve")
      ->type_name("LABEL")
      ->excludes(from)
      ->excludes(to)
      ->excludes(mode)
      ->excludes(branch);
  constexpr int fewest = 2, most = 100;  // more make large files that look the same
  animate.add_option("--frames", arguments.frames, "At most as many pictures (60)")
      ->type_name("N")
      ->check(CLI::Range(fewest, most));
  add_run_and_colours(animate, arguments);
}

void add_import(CLI::App& import, Arguments& arguments) {
  import
      .add_option("MESH", arguments.mesh, "Mesh: Wavefront .obj, or .fold of origami; robot: .urdf")
      ->required();
  import
      .add_option("-o,--output", arguments.new_case,
                  "Case file to be written; it must not exist (standard output when not given)")
      ->type_name("FILE");
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// "did you mean ...?", or all that there are.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const std::string near = io::nearest(word, names);
  return near.empty() ? "; there are: " + listed(names) : ", did you mean \"" + near + "\"?";
}

/// The first word, if it is no command: with the nearest one, or with all of them.
std::optional<std::string> unknown_command(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
  const std::string word = argc > 1 ? argv[1] : "";
  if (word.empty() || word.front() == '-' ||
      std::find(commands.begin(), commands.end(), word) != commands.end())
    return std::nullopt;
  if (word.ends_with(".toml"))
    return "\"" + word + "\" is no command; did you mean \"springfold run " + word + "\"?";
  return "no command \"" + word + "\"" + suggestion(word, commands);
}

/// The first option that the command does not have, with the nearest one or all of them; nothing if it has them all.
std::optional<std::string> unknown_option(const CLI::App& app, int argc, const char* const* argv) {
  for (const CLI::App* command : app.get_subcommands()) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (int i = 2; i < argc; ++i) {
      const std::string word = argv[i], name = word.substr(0, word.find('='));
      if (!name.starts_with("--") || name == "--") continue;
      if (command->get_option_no_throw(name) != nullptr) continue;
      return "\"" + command->get_name() + "\" has no option \"" + name + "\"" +
             suggestion(name, names);
    }
  }
  return std::nullopt;
}

/// What is wrong, in the words of the program where it knows them.
std::string mistake_of(const CLI::App& app, const CLI::ParseError& mistake, int argc,
                       const char* const* argv) {
  if (const auto command = unknown_command(app, argc, argv)) return *command;
  if (dynamic_cast<const CLI::ExtrasError*>(&mistake) != nullptr)
    if (const auto option = unknown_option(app, argc, argv)) return *option;
  return mistake.what();
}

}  // namespace

ParsedArguments parse_arguments(int argc, const char* const* argv) {
  Arguments arguments;
  std::vector<std::string> settings;

  CLI::App app{description, "springfold"};
  app.footer(examples);
  app.require_subcommand(1);
  app.set_version_flag("--version", "springfold " + std::string{version});

  CLI::App* run = app.add_subcommand("run", "Run the studies of a case file");
  CLI::App* check =
      app.add_subcommand("check", "Read and check a case file and solve its starts, trace nothing");
  CLI::App* draw = app.add_subcommand("draw", "Draw the mechanism in a posture (SVG, PNG)");
  CLI::App* animate =
      app.add_subcommand("animate", "Move the mechanism along its curve (animated SVG)");
  for (CLI::App* command : {run, check, draw, animate}) {
    command->add_option("CASE", arguments.case_file, "Case file (TOML)")->required();
    command
        ->add_option("--set", settings, "Replace a parameter's value or formula; may be repeated")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
  }
  bool is_without_solving = false;
  add_drawing(*draw, *check, arguments);
  add_animation(*animate, arguments);
  check->add_flag("--no-solve", is_without_solving, "Do not close the chains and solve the starts");
  run->add_option("--study", arguments.studies, "Run this study only; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  run->add_option("-o,--out", arguments.folder,
                  "Folder for results (results/<name of the case> when not given)")
      ->type_name("DIR");
  run->add_option("--threads", arguments.threads,
                  "Threads (all cores when not given); results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  run->add_flag(
      "--resume", arguments.resumes,
      "Complete maps and tables of many runs that an interrupted run of the same case left in "
      "the folder");
  bool is_without_plots = false;
  run->add_flag("--no-plots", is_without_plots, "Draw no figures");
  run->add_flag("--report", arguments.makes_report,
                "Write report.html too: curves, and the mechanism in the posture under the cursor");
  const auto prints_json = run->add_flag("--json", arguments.prints_json,
                                         "Print summary.json instead of tables on standard output");
  const auto quiet =
      run->add_flag("--quiet", arguments.is_quiet,
                    "Print what happened in words, no tables; say only what is wrong");
  run->add_flag("--verbose", arguments.is_verbose,
                "Print refused and cut steps too, with their reasons")
      ->excludes(quiet)
      ->excludes(prints_json);

  CLI::App* plot = app.add_subcommand("plot", "Draw the figures of an earlier run again");
  plot->add_option("RESULTS", arguments.results, "Folder of its results")->required();
  plot->add_flag("--changed", arguments.draws_changed,
                 "Also scripts that were changed since they were written");

  CLI::App* verify = app.add_subcommand("verify", "Compare many cases with their expected values");
  verify
      ->add_option("PATH", arguments.cases,
                   "Case files, or folders: then case*.toml in it and in its sub-folders")
      ->required();
  verify->add_option("--jobs", arguments.jobs, "Runs at a time (one per processor when not given)")
      ->check(CLI::Range(1, 1024));
  const auto json = verify->add_flag("--json", arguments.prints_json, "Print JSON, not a table");
  verify->add_flag("--csv", arguments.prints_csv, "Print CSV, not a table")->excludes(json);

  CLI::App* import = app.add_subcommand(
      "import",
      "Make a case file of a mesh (bars along its edges, folds between faces) or of a robot");
  add_import(*import, arguments);

  ParsedArguments parsed;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    parsed.text = app.help();
    return parsed;
  } catch (const CLI::CallForVersion& call) {
    parsed.text = std::string{call.what()} + "\n";
    return parsed;
  } catch (const CLI::ParseError& mistake) {
    parsed.error = mistake_of(app, mistake, argc, argv);
    return parsed;
  }
  for (const auto& text : settings)
    if (!add_override(text, arguments.overrides, parsed.error)) return parsed;
  arguments.draws_plots = !is_without_plots;
  arguments.solves_starts = !is_without_solving;
  arguments.command = run->parsed()       ? Command::run
                      : verify->parsed()  ? Command::verify
                      : draw->parsed()    ? Command::draw
                      : animate->parsed() ? Command::animate
                      : plot->parsed()    ? Command::plot
                      : import->parsed()  ? Command::import
                                          : Command::check;
  parsed.arguments = std::move(arguments);
  return parsed;
}

}  // namespace springfold::cli
