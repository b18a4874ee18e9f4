// Reads a case with the umbrella target, which needs every third-party library at link time.
#include <cstdio>
#include <springfold/io/case_file.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const springfold::io::Case the_case = springfold::io::load_case(argv[1]);
  std::printf("%s: %zu runs\n", the_case.title.c_str(), the_case.runs.size());
  return the_case.runs.empty() ? 1 : 0;
}
