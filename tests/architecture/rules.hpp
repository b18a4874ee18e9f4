// The rules of docs/design.md about files, as functions of a path and a text.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace springfold::architecture {

struct SourceFile {
  std::string path{};  ///< relative to the source tree, with slashes: "src/io/results.cpp"
  std::string text{};
};

/// All C++ files below the given folders of the source tree, in alphabetical order.
std::vector<SourceFile> cpp_files(const std::filesystem::path& root,
                                  const std::vector<std::string>& folders);

/// Text without comments and without the contents of string and character literals.
std::string code_only(const std::string& text);

/// What the file includes: the words between <> or quotes, in order.
std::vector<std::string> includes_of(const SourceFile& file);

/// Includes that the file's layer must not have, as sentences: layers above it, private headers of
/// other layers, third parties outside their place, anything but Eigen in a public header.
std::vector<std::string> forbidden_includes(const SourceFile& file);

/// Private headers of rooms of the engine that the file's room must not have, as sentences; none for files of other
/// layers.
std::vector<std::string> forbidden_rooms(const SourceFile& file);

/// Third parties that must be confined to one file of their layer, but are included by several.
std::vector<std::string> scattered_libraries(const std::vector<SourceFile>& files);

/// Numbers with a point or an exponent, as they are written; but for 0, 1, 2 and one half.
std::vector<std::string> literals_of(const SourceFile& file);

/// Those below a thousandth, as sentences: tolerances, which need a name and a reason.
std::vector<std::string> bare_tolerances(const SourceFile& file);

/// Lines that are not empty and not comments.
std::size_t code_lines(const SourceFile& file);

/// Calls that print, or that end the program, as sentences.
std::vector<std::string> prints_or_exits(const SourceFile& file);

}  // namespace springfold::architecture
