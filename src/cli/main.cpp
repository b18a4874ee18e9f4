#include <unistd.h>

#include <iostream>

#include "cli/memory_shortage.hpp"
#include "cli/run_main.hpp"

int main(int argc, char** argv) {
  springfold::cli::prepare_for_memory_shortage();
  const bool is_terminal = ::isatty(STDERR_FILENO) == 1;
  return springfold::cli::run_main(argc, argv, std::cout, std::cerr, is_terminal);
}
