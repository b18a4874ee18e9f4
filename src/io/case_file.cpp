#include "case_draft.hpp"
#include "command_reader.hpp"
#include "memory_limits.hpp"
#include "repetition.hpp"
#include "sha256.hpp"
#include "springfold/io/read_case.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

void throw_if_any(const Problems& problems) {
  if (!problems.empty()) throw CaseError{problems.messages()};
}

/// The file named by `expected`, or expected.toml beside the case if there is one. An empty name
/// means none.
std::vector<Document> read_expected_file(const fs::path& file, const Node& root,
                                         SourceReader& sources, Problems& problems) {
  const Node* named = root.find("expected");
  const fs::path folder = file.parent_path();
  if (!named) {
    const fs::path beside = folder / "expected.toml";
    std::error_code ignored;
    return fs::exists(beside, ignored) ? sources.read_single(beside, {}, "")
                                       : std::vector<Document>{};
  }
  if (named->kind != Node::Kind::text) {
    problems.add(named->place, "expected", "got " + described(*named) + ", need a file name");
    return {};
  }
  if (named->text.empty()) return {};
  return sources.read_single((folder / named->text).lexically_normal(), named->place, "expected");
}

/// Mistakes in a file of expected values that the case does not name: it may belong to another case.
void explain_neighbour(const fs::path& file, const Document& expected, Problems& problems) {
  if (!problems.are_in(expected.name)) return;
  problems.add({expected.name, 0, 0}, "",
               "was read because it lies beside " + file.filename().string() +
                   "; if it belongs to another case, write expected = \"\" at the top of " +
                   file.filename().string());
}

/// Targets of studies that have them in files of their own, beside the case.
void read_target_files(const fs::path& folder, SourceReader& sources, CaseDraft& draft,
                       Problems& problems) {
  for (StudyDraft& study : draft.studies) {
    if (!study.commands.file) continue;
    const TargetFile file = *study.commands.file;
    const fs::path path = (folder / file.name).lexically_normal();
    const auto text = sources.read_text(path, file.place, file.key);
    if (text) read_target_file(file, path.string(), *text, study.commands, study.numbers, problems);
  }
}

std::string fingerprint(const SourceReader& sources,
                        const std::map<std::string, std::string>& overrides) {
  std::string bytes = sources.bytes();
  for (const auto& [name, value] : overrides) bytes += name + "=" + value + "\n";
  return sha256(bytes);
}

}  // namespace

CaseError::CaseError(std::vector<std::string> messages)
    : std::runtime_error{joined(messages)}, messages_{std::move(messages)} {}

Case load_case(const fs::path& file, const std::map<std::string, std::string>& overrides) {
  return load_case(file, overrides, {});
}

Case load_case(const fs::path& file, const std::map<std::string, std::string>& overrides,
               const std::function<bool()>& stop_requested) {
  Problems problems;
  SourceReader sources{problems, stop_requested};
  std::vector<Document> documents = sources.read_case(file);
  throw_if_any(problems);
  const std::vector<std::string> hints = expand_repetitions(documents, problems);
  throw_if_any(problems);
  const std::vector<Document> expected =
      read_expected_file(file, documents.back().root, sources, problems);
  const bool unasked = !expected.empty() && !documents.back().root.find("expected");

  const FileReader files = [&sources](const std::string& name, const Place& place,
                                      const std::string& key) -> std::optional<TextFile> {
    const fs::path path = (fs::path{place.file}.parent_path() / name).lexically_normal();
    auto text = sources.read_text(path, place, key);
    if (!text) return std::nullopt;
    return TextFile{std::move(*text), path.string()};
  };
  CaseDraft read = read_case(documents, overrides, expected, files, problems);
  read_target_files(file.parent_path(), sources, read, problems);
  const auto draft = std::make_shared<const CaseDraft>(std::move(read));
  const std::size_t before = problems.size();
  check_memory(*draft, problems);
  // Numbers of too many runs would take long to check.
  if (problems.size() == before) check_numbers(*draft, problems);
  if (unasked) explain_neighbour(file, expected.front(), problems);
  throw_if_any(problems);

  Case result = build_case(draft, problems);
  if (unasked) explain_neighbour(file, expected.front(), problems);
  throw_if_any(problems);
  result.file = file;
  result.overrides = overrides;
  result.hash = fingerprint(sources, overrides);
  result.hints.insert(result.hints.begin(), hints.begin(), hints.end());
  return result;
}

}  // namespace springfold::io
