#include "import_command.hpp"

#include <fstream>

#include "exit_code.hpp"
#include "messages.hpp"
#include "springfold/io/import.hpp"

namespace springfold::cli {

int import_command(const Arguments& arguments, const Session& session) {
  std::string text;
  try {
    text = io::import_file(arguments.case_file);
  } catch (const io::CaseError&) {
    throw;
  } catch (const std::runtime_error& error) {
    say(session.err, error.what());
    return input_output;
  }
  if (!arguments.case_output) {
    session.out << text << std::flush;
    if (session.out.good()) return all_done;
    say(session.err, "cannot write to standard output");
    return input_output;
  }
  if (std::filesystem::exists(*arguments.case_output)) {
    say(session.err, arguments.case_output->string() + " is there already, and nothing was written");
    return input_output;
  }
  std::ofstream file{*arguments.case_output, std::ios::binary};
  file << text << std::flush;
  if (file.good()) return all_done;
  say(session.err, "cannot write " + arguments.case_output->string());
  return input_output;
}

}  // namespace springfold::cli
