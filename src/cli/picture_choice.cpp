#include "picture_choice.hpp"

#include "springfold/io/postures.hpp"

namespace springfold::cli {

const io::PlannedRun* run_of(const io::Case& the_case, const std::string& study, int number) {
  for (const io::PlannedRun& run : the_case.runs)
    if ((study.empty() || run.study == study) && run.run == number) return &run;
  return nullptr;
}

drawing::IllustrationOptions options_of(const Arguments& arguments, const io::Case& the_case) {
  return io::illustration_options(the_case, arguments.view, arguments.colour);
}

}  // namespace springfold::cli
