#include "source_files.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "springfold/continuation/interrupted.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file = std::size_t{4} << 20;  // 4 MiB
constexpr std::size_t deepest_include = 8;

struct Contents {
  std::string bytes{};
  std::string problem{};
};

/// An open file. A pipe is opened whether or not somebody writes into it yet.
class Input {
 public:
  explicit Input(const fs::path& file)
      : number_{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)} {}
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  ~Input() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

/// Until there is something to read or the end: a pipe without a writer has neither.
void wait_for_bytes(const Input& input, const std::function<bool()>& stop_requested) {
  constexpr int patience_ms = 100;
  pollfd wanted{.fd = input.number(), .events = POLLIN, .revents = 0};
  do {
    if (stop_requested && stop_requested()) throw continuation::Interrupted{};
  } while (::poll(&wanted, 1, patience_ms) <= 0);
}

Contents read_bytes(const fs::path& file, const std::function<bool()>& stop_requested) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    const fs::path inside = file / "case.toml";
    const bool likely = fs::is_regular_file(inside, ignored);
    return {{}, "it is a directory" + (likely ? "; its case is " + inside.string() : "")};
  }
  const Input input{file};
  if (input.number() < 0) return {{}, std::generic_category().message(errno)};
  Contents contents;
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    wait_for_bytes(input, stop_requested);
    const ssize_t got = ::read(input.number(), buffer.data(), buffer.size());
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) return {{}, std::generic_category().message(errno)};
    if (got == 0) return contents;
    contents.bytes.append(buffer.data(), static_cast<std::size_t>(got));
    if (contents.bytes.size() > largest_file) return {{}, "it is larger than 4 MiB"};
  }
}

fs::path identity_of(const fs::path& file) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(file, error);
  return error ? file : canonical;
}

}  // namespace

std::vector<Document> SourceReader::read_case(const fs::path& file) {
  std::vector<Document> documents;
  read_with_includes(file, {}, documents);
  return documents;
}

std::vector<Document> SourceReader::read_single(const fs::path& file, const Place& place,
                                                const std::string& key) {
  std::vector<Document> documents;
  if (auto root = read_one(file, {place, key}))
    documents.push_back({std::move(*root), file.string(), false});
  return documents;
}

std::optional<std::string> SourceReader::read_text(const fs::path& file, const Place& place,
                                                   const std::string& key) {
  return read_counted(file, {place, key});
}

std::optional<Node> SourceReader::read_one(const fs::path& file, const Origin& origin) {
  const auto text = read_counted(file, origin);
  return text ? read_toml(*text, file.string(), *problems_) : std::nullopt;
}

std::optional<std::string> SourceReader::read_counted(const fs::path& file, const Origin& origin) {
  const Contents contents = read_bytes(file, stop_requested_);
  if (!contents.problem.empty()) {
    const bool named = !origin.place.file.empty();
    if (named)
      problems_->add(origin.place, origin.key,
                     "\"" + file.string() + "\" cannot be read: " + contents.problem);
    else
      problems_->add({file.string(), 0, 0}, "", "cannot be read: " + contents.problem);
    return std::nullopt;
  }
  bytes_ += std::to_string(contents.bytes.size()) + "\n" + contents.bytes;
  return contents.bytes;
}

std::vector<std::pair<std::string, SourceReader::Origin>> SourceReader::includes_of(
    const Node& root) const {
  std::vector<std::pair<std::string, Origin>> files;
  const Node* include = root.find("include");
  if (!include) return files;
  const auto add = [&](const Node& node, const std::string& key) {
    if (node.kind == Node::Kind::text && !node.text.empty())
      files.push_back({node.text, {node.place, key}});
    else
      problems_->add(node.place, key,
                     "got " + described(node) + ", need a file name or a list of file names");
  };
  if (include->kind != Node::Kind::array) {
    add(*include, "include");
    return files;
  }
  for (std::size_t i = 0; i < include->items.size(); ++i)
    add(include->items[i], "include[" + std::to_string(i + 1) + "]");
  return files;
}

void SourceReader::read_with_includes(const fs::path& file, const Origin& origin,
                                      std::vector<Document>& documents) {
  const fs::path identity = identity_of(file);
  if (std::find(open_.begin(), open_.end(), identity) != open_.end()) {
    problems_->add(origin.place, origin.key,
                   "\"" + file.string() + "\" is being read already: the includes form a circle");
    return;
  }
  if (done_.contains(identity)) return;  // included twice: its tables count once
  if (open_.size() > deepest_include) {
    problems_->add(origin.place, origin.key,
                   "more than " + std::to_string(deepest_include) + " includes within each other");
    return;
  }
  std::optional<Node> root = read_one(file, origin);
  if (!root) return;
  open_.push_back(identity);
  for (const auto& [name, at] : includes_of(*root))
    read_with_includes((file.parent_path() / name).lexically_normal(), at, documents);
  open_.pop_back();
  done_.insert(identity);
  documents.push_back({std::move(*root), file.string(), !origin.place.file.empty()});
}

}  // namespace springfold::io
