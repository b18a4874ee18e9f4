#include "messages.hpp"

#include "springfold/io/shown_text.hpp"

namespace springfold::cli {

void say(std::ostream& err, const std::string& message) {
  err << "springfold: " << io::shown(message) << "\n";
}

}  // namespace springfold::cli
