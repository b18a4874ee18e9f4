#include "atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace springfold::io {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(std::string_view what, const fs::path& path, int error) {
  throw std::runtime_error{std::string{what} + " " + path.string() + ": " +
                           std::generic_category().message(error)};
}

/// An open file that is closed at the end of the scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_{number} {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  /// Closes now; 0 or the error, which some file systems report only here.
  int close() { return ::close(std::exchange(number_, -1)) == 0 ? 0 : errno; }

 private:
  int number_;
};

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path{"."};
}

/// 0 or the error; ECANCELED once it is over.
int write_all(int file, std::string_view bytes, const std::function<bool()>& is_over) {
  constexpr std::size_t part = std::size_t{1} << 22;  // [byte], a few milliseconds
  while (!bytes.empty()) {
    if (is_over && is_over()) return ECANCELED;
    const ssize_t written = ::write(file, bytes.data(), std::min(part, bytes.size()));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Some file systems cannot synchronise and say EINVAL: that is no loss.
int synchronise(int file) { return ::fsync(file) == 0 || errno == EINVAL ? 0 : errno; }

/// A file or, with O_DIRECTORY, a folder.
int synchronise(const fs::path& path, int flags) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags)};
  return file.number() < 0 ? errno : synchronise(file.number());
}

int create_with(const fs::path& path, std::string_view bytes,
                const std::function<bool()>& is_over) {
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC;
  Descriptor file{::open(path.c_str(), flags, 0666)};
  if (file.number() < 0) return errno;
  if (const int error = write_all(file.number(), bytes, is_over)) return error;
  return file.close();
}

/// 0 or the error. Where a file is replaced, the two change places and the old one is removed:
/// renaming over it would make some file systems (ext4) wait for the disk.
int rename_into_place(const fs::path& from, const fs::path& to) {
  struct stat old {};
  if (::lstat(to.c_str(), &old) == 0 && S_ISREG(old.st_mode) &&
      ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0)
    return ::unlink(from.c_str()) == 0 ? 0 : errno;
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

}  // namespace

void write_file(const fs::path& path, std::string_view bytes) { write_file(path, bytes, {}); }

bool write_file(const fs::path& path, std::string_view bytes,
                const std::function<bool()>& is_over) {
  // The process number keeps two runs into one folder from sharing a temporary file.
  const fs::path temporary =
      folder_of(path) / ("." + path.filename().string() + ".part" + std::to_string(::getpid()));
  int error = create_with(temporary, bytes, is_over);
  if (error == 0) error = rename_into_place(temporary, path);
  if (error == 0) return true;
  ::unlink(temporary.c_str());
  if (error == ECANCELED) return false;
  fail("cannot write", path, error);
}

void publish_file(const fs::path& from, const fs::path& to) {
  if (const int error = rename_into_place(from, to)) fail("cannot write", to, error);
}

void put_on_disk(const fs::path& path) {
  int error = synchronise(path, 0);
  if (error == 0) error = synchronise(folder_of(path), O_DIRECTORY);
  if (error != 0) fail("cannot write", path, error);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw std::runtime_error{"cannot create folder " + folder.string() + ": " + error.message()};
}

std::string read_file(const fs::path& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number() < 0) fail("cannot read", path, errno);
  std::string bytes;
  std::array<char, 1 << 16> part{};
  for (;;) {
    const ssize_t count = ::read(file.number(), part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("cannot read", path, errno);
    if (count == 0) return bytes;
    bytes.append(part.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace springfold::io
