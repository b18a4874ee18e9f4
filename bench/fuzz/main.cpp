// Fuzzing of the whole program: mutants of all case files of the library are given to `check` and `run`, in processes
// of their own, so that whatever a mutant does is seen, kept and stepped over.
//
//     springfold_fuzz check|run|uncapped [--corpus folder] [--work folder] [--seed s] [--count n] [--seconds t]
//         [--jobs j] [--only i]
//
// Mutant i of a seed is always the same one. The work folder remembers how far each mode and seed has come: the next
// call goes on there, up to `count` executions in all. Exit code 1 if anything was found, now or before. What is found
// lies in findings/: the case file, the name of the file that it comes from, and what was said. A finding is
//
//     a crash or a report of a sanitizer    an exit code that is not documented, "internal error" among them
//     no end: after 300 s of CPU time (`run` 60 s), or ten times as many seconds, though SIGINT came before
//     control characters on the terminal    something written with exit code 3; 0, 4 or 5 without a manifest
//     run and check do not agree
#include <CLI/CLI.hpp>
#include <iostream>

#include "workers.hpp"

int main(int argc, char** argv) {
  using namespace springfold::fuzz;
  Settings settings;
  const std::map<std::string, Mode> modes{
      {"check", Mode::check}, {"run", Mode::run}, {"uncapped", Mode::uncapped}};
  CLI::App app("Mutants of case files, given to the program");
  app.add_option("mode", settings.mode, "check, run or uncapped")
      ->required()
      ->transform(CLI::Transformer(modes));
  app.add_option("--corpus", settings.corpus, "folder of case files")
      ->check(CLI::ExistingDirectory);
  app.add_option("--work", settings.work, "folder for findings and for how far it has come");
  app.add_option("--seed", settings.seed, "the same seed gives the same mutants");
  app.add_option("--count", settings.count, "executions in all");
  app.add_option("--seconds", settings.seconds, "stop after so many, to go on another time");
  app.add_option("--jobs", settings.jobs, "processes at a time")->check(CLI::Range(1, 256));
  app.add_option("--only", settings.only, "this mutant alone, in this process");
  CLI11_PARSE(app, argc, argv);
  try {
    return settings.only ? run_one(settings, std::cout) : run_all(settings, std::cout);
  } catch (const std::exception& e) {
    std::cerr << "springfold_fuzz: " << e.what() << "\n";
    return 2;
  }
}
