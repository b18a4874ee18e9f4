#include "picture_choice.hpp"

namespace springfold::cli {

const io::PlannedRun* run_of(const io::Case& the_case, const std::string& study, int number) {
  for (const io::PlannedRun& run : the_case.runs)
    if ((study.empty() || run.study == study) && run.run == number) return &run;
  return nullptr;
}

std::string heading_of(const io::PlannedRun& run, const std::string& what) {
  return run.study + (run.label.empty() ? "" : ", " + run.label) + ": " + what;
}

drawing::IllustrationOptions options_of(const Arguments& arguments, const io::Case& the_case) {
  drawing::IllustrationOptions options;
  options.title = the_case.title;
  options.force_unit = the_case.units.force;
  options.energy_unit = the_case.units.force + "·" + the_case.units.length;
  options.colouring = arguments.colour == "force"    ? drawing::Colouring::force
                      : arguments.colour == "energy" ? drawing::Colouring::energy
                      : arguments.colour == "none"   ? drawing::Colouring::none
                                                     : drawing::Colouring::stability;
  if (arguments.view == "xy") options.view = drawing::View{};
  if (arguments.view == "xz")
    options.view = drawing::View{model::Vec3<double>::UnitX(), model::Vec3<double>::UnitZ()};
  if (arguments.view == "yz")
    options.view = drawing::View{model::Vec3<double>::UnitY(), model::Vec3<double>::UnitZ()};
  return options;
}

}  // namespace springfold::cli
