#include "springfold/io/case_file.hpp"

#include "case_draft.hpp"
#include "command_reader.hpp"
#include "sha256.hpp"

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
  Problems problems;
  SourceReader sources{problems};
  const std::vector<Document> documents = sources.read_case(file);
  throw_if_any(problems);
  const std::vector<Document> expected =
      read_expected_file(file, documents.back().root, sources, problems);

  CaseDraft read = read_case(documents, overrides, expected, problems);
  read_target_files(file.parent_path(), sources, read, problems);
  const auto draft = std::make_shared<const CaseDraft>(std::move(read));
  check_numbers(*draft, problems);
  throw_if_any(problems);

  Case result = build_case(draft, problems);
  throw_if_any(problems);
  result.file = file;
  result.overrides = overrides;
  result.hash = fingerprint(sources, overrides);
  return result;
}

}  // namespace springfold::io
