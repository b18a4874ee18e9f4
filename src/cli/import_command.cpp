#include "import_command.hpp"

#include <stdexcept>

#include "exit_code.hpp"
#include "springfold/io/import_urdf.hpp"

namespace springfold::cli {

int import_command(const Arguments& arguments, const Session& session) {
  const bool is_robot = arguments.mesh.extension() == ".urdf";
  const io::ImportedCase imported =
      (is_robot ? io::import_urdf : io::import_mesh)(arguments.mesh, stop_request_of(session));
  for (const std::string& line : imported.report) say(session, line);
  if (!arguments.new_case) {
    session.out << imported.text << std::flush;
    if (session.out.good()) return all_done;
    say(session, "cannot write to standard output");
    return input_output;
  }
  try {
    io::write_new_case(*arguments.new_case, imported.text);
  } catch (const std::runtime_error& error) {
    say(session, error.what());
    return input_output;
  }
  return all_done;
}

}  // namespace springfold::cli
