#include "springfold/io/picture_files.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

#include "atomic_file.hpp"
#include "gnuplot_process.hpp"
#include "undated.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;

/// Runs the converter and waits. @returns whether it ended well
bool convert(const fs::path& converter, const fs::path& svg, const fs::path& file) {
  std::vector<std::string> words{"rsvg-convert", "--format",    file.extension().string().substr(1),
                                 "--output",     file.string(), svg.string()};
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int error =
      ::posix_spawn(&process, converter.c_str(), &files, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return false;
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::string write_picture(const drawing::Picture& picture, const fs::path& file) {
  // Absolute: no name can be taken for an option.
  const fs::path path = fs::absolute(file);
  make_folder(path.parent_path());
  const bool is_svg = path.extension() == ".svg";
  fs::path svg = path;
  svg.replace_extension(".svg");
  write_file(svg, drawing::svg_text(picture));
  if (is_svg) return {};
  const auto converter = find_executable("rsvg-convert");
  if (converter && convert(*converter, svg, path)) {
    finish_picture(path);
    return {};
  }
  return std::string{path.extension() == ".pdf" ? "no PDF file" : "no PNG file"} +
         ": it needs the program rsvg-convert (Debian: librsvg2-bin)" +
         std::string(converter ? ", which failed" : "") + "; the picture is in " + svg.string();
}

void write_movie(const drawing::Movie& movie, const fs::path& file) {
  const fs::path path = fs::absolute(file);
  make_folder(path.parent_path());
  write_file(path, drawing::svg_text(movie));
}

}  // namespace springfold::io
