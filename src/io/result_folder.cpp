#include "springfold/io/result_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <ctime>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "atomic_file.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;

std::string owner() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  std::array<char, 32> time{};
  ::gmtime_r(&now, &utc);
  std::strftime(time.data(), time.size(), "%Y-%m-%d %H:%M:%S UTC", &utc);
  return "springfold, process " + std::to_string(::getpid()) + " on " + host.data() + ", since " +
         time.data();
}

[[noreturn]] void fail(const fs::path& file, int error) {
  throw std::runtime_error{"cannot lock " + file.string() + ": " +
                           std::generic_category().message(error)};
}

[[noreturn]] void refuse(const fs::path& file) {
  std::string who = read_file(file);
  who.erase(std::find(who.begin(), who.end(), '\n'), who.end());
  throw std::runtime_error{file.parent_path().string() + " is being written by another run: " +
                           (who.empty() ? "its name is not known" : who) +
                           "; wait for it, or choose another folder with --out"};
}

/// Is the open file still the one of that name? The one before may have removed it meanwhile.
bool is_in_place(int descriptor, const fs::path& file) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

/// Some file systems have no locks: there is no protection there.
bool has_no_locks(int error) { return error == ENOLCK || error == EOPNOTSUPP || error == ENOSYS; }

bool all_of(std::string_view text, int (*is_kind)(int)) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [is_kind](char c) {
    return is_kind(static_cast<unsigned char>(c)) != 0;
  });
}

bool is_leftover(const std::string& name) {
  if (!name.starts_with('.')) return false;
  constexpr std::string_view probe = ".springfold-", part = ".part";
  if (name.starts_with(probe))
    return name.size() == probe.size() + 6 && all_of(name.substr(probe.size()), std::isalnum);
  const std::size_t at = name.rfind(part);
  return at != std::string::npos && all_of(name.substr(at + part.size()), std::isdigit);
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : file_{folder / ".springfold.lock"} {
  for (;;) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) fail(file_, errno);
    const int error = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    const bool is_ours = error == 0 || has_no_locks(error);
    if (is_ours && is_in_place(descriptor_, file_)) break;
    ::close(descriptor_);
    if (error == EWOULDBLOCK) refuse(file_);
    if (!is_ours && error != EINTR) fail(file_, error);
  }
  const std::string text = owner() + "\n";
  if (::ftruncate(descriptor_, 0) != 0 ||
      ::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    const int error = errno;
    ::close(descriptor_);
    fail(file_, error);
  }
}

FolderLock::~FolderLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

void remove_leftovers(const fs::path& folder) {
  for (const char* part : {".", "branches", "equilibria", "graphs", "plots", "sweeps"}) {
    std::error_code error;
    std::vector<fs::path> leftovers;
    // A folder that cannot be read to its end keeps what is left over there: the run goes on.
    for (fs::directory_iterator entry{folder / part, error}, end; !error && entry != end;
         entry.increment(error))
      if (is_leftover(entry->path().filename().string())) leftovers.push_back(entry->path());
    for (const fs::path& leftover : leftovers) fs::remove_all(leftover, error);
  }
}

}  // namespace springfold::io
