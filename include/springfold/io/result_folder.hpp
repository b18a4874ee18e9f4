// The folder of a run: one run at a time writes into it.
#pragma once

#include <filesystem>
#include <string>

namespace springfold::io {

/// While it lives no other run may write into the folder. It is a file `.springfold.lock` that says
/// whose it is, held by the operating system's lock (flock): a program that was killed holds none,
/// however its file may look.
class FolderLock {
 public:
  /// @throws std::runtime_error "<folder> is being written by another run: springfold, process 12 on
  /// host, since ...", or why the file cannot be made
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Removes what killed runs left: unfinished files and folders, which have names that only springfold
/// gives: ".NAME.partPROCESS", ".partPROCESS", ".springfold-" and six letters.
/// @pre the folder is locked
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace springfold::io
