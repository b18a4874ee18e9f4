// Where pictures are drawn before they are whole.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "atomic_file.hpp"

namespace springfold::io {

/// A folder for unfinished pictures, removed at the end of the scope. It lies beside the finished
/// ones, so that these can be renamed into place.
class WorkFolder {
 public:
  explicit WorkFolder(const std::filesystem::path& parent)
      : path_{parent / (".part" + std::to_string(::getpid()))} {
    make_folder(path_);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace springfold::io
