// What a run of the program leaves.
#pragma once

#include <string>

namespace springfold::cli {

struct Outcome {
  int code = -1;
  std::string out{}, err{};
};

}  // namespace springfold::cli
