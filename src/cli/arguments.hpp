// The command line as plain data.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace springfold::cli {

enum class Command { run, check, verify, draw, animate, plot, import };

struct Arguments {
  Command command = Command::run;
  std::filesystem::path case_file{};
  std::vector<std::string> studies{};              ///< empty: all
  std::optional<std::filesystem::path> folder{};   ///< --out
  std::map<std::string, std::string> overrides{};  ///< --set name=value
  int threads = 0;                                 ///< --threads; 0: all cores
  bool resumes = false;                            ///< --resume
  bool draws_plots = true;
  bool makes_report = false;                            ///< run: --report
  bool solves_starts = true;                            ///< check only
  bool draws = false;                                   ///< check only: --draw
  std::optional<std::filesystem::path> picture_file{};  ///< draw, check --draw: --output
  std::string draw_at{};                                ///< draw: "STUDY/LABEL" or "LABEL"
  std::string draw_all{};                               ///< draw: a study
  bool draws_guess = false;                             ///< draw: --guess
  std::string colour = "stability";                     ///< draw
  std::string view{};                  ///< draw: "xy", "xz", "yz", "perspective"; empty: natural
  int run_number = 1;                  ///< draw, animate: --run
  std::string film_from{}, film_to{};  ///< animate: --from, --to
  std::string film_mode{};             ///< animate: --mode
  std::string film_jump{};             ///< animate: --jump
  int film_branch = 0;                 ///< animate: --branch; 0: as the labels say
  int frames = 60;                     ///< animate: --frames
  bool prints_json = false;
  std::filesystem::path results{};                  ///< plot: folder of a run
  bool draws_changed = false;                       ///< plot: --changed
  bool is_quiet = false;                            ///< run: --quiet
  bool is_verbose = false;                          ///< run: --verbose
  bool prints_csv = false;                          ///< verify only
  std::filesystem::path mesh{};                     ///< import: the mesh
  std::optional<std::filesystem::path> new_case{};  ///< import: --output
  std::vector<std::filesystem::path> cases{};       ///< verify: case files and folders of them
  int jobs = 0;  ///< verify: runs at a time; 0: one per processor
};

/// Either arguments, or text that is all there is to say (--help, --version), or what is wrong.
struct ParsedArguments {
  std::optional<Arguments> arguments{};
  std::string text{};   ///< for standard output
  std::string error{};  ///< for standard error
};

ParsedArguments parse_arguments(int argc, const char* const* argv);

}  // namespace springfold::cli
