// The files of a case: read, parsed, includes followed.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "problems.hpp"
#include "toml_reader.hpp"

namespace springfold::io {

struct Document {
  Node root{};
  std::string name{};     ///< as shown in messages
  bool included = false;  ///< by another file
};

/// Reads files for one case and keeps their bytes for its fingerprint.
class SourceReader {
 public:
  /// @param stop_requested  asked while files are read; then Interrupted is thrown. May be empty
  explicit SourceReader(Problems& problems, std::function<bool()> stop_requested = {})
      : problems_{&problems}, stop_requested_{std::move(stop_requested)} {}

  /// The file and all that it includes: included ones first, each once, the file itself last.
  /// Unreadable, too large, ill-formed files and circles are problems.
  std::vector<Document> read_case(const std::filesystem::path& file);

  /// One file without includes; nothing if there is a problem.
  /// @param place, key  where the file is named; a place without file: nowhere
  std::vector<Document> read_single(const std::filesystem::path& file, const Place& place,
                                    const std::string& key);

  /// The text of a file that is no TOML; nothing if it cannot be read, which is reported.
  std::optional<std::string> read_text(const std::filesystem::path& file, const Place& place,
                                       const std::string& key);

  /// The bytes of all files read so far, in order, each with its length.
  const std::string& bytes() const { return bytes_; }

 private:
  struct Origin {
    Place place{};
    std::string key{};
  };
  void read_with_includes(const std::filesystem::path& file, const Origin& origin,
                          std::vector<Document>& documents);
  std::optional<std::string> read_counted(const std::filesystem::path& file, const Origin& origin);
  std::optional<Node> read_one(const std::filesystem::path& file, const Origin& origin);
  std::vector<std::pair<std::string, Origin>> includes_of(const Node& root) const;

  Problems* problems_;
  std::function<bool()> stop_requested_{};
  std::string bytes_{};
  std::vector<std::filesystem::path> open_{};  ///< files that are being read, outermost first
  std::set<std::filesystem::path> done_{};
};

}  // namespace springfold::io
