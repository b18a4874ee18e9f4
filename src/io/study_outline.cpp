// What happened in all runs of a study, in words.
#include <algorithm>

#include "outline.hpp"
#include "summary_line.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;
using Runs = std::vector<const StudyResult*>;

constexpr std::size_t most_lines_of_outline = 3;

/// Runs of which the same is told.
struct Group {
  std::string story{};
  Runs runs{};
};

std::vector<Group> groups_of(const Case& the_case, const Runs& runs, std::size_t most) {
  std::vector<Group> groups;
  for (const StudyResult* run : runs) {
    std::string story;
    for (const std::string& sentence : story_of(the_case, *run, most))
      story += (story.empty() ? "" : "; ") + sentence;
    if (story.empty()) story = "nothing was found";
    const auto known = std::find_if(groups.begin(), groups.end(),
                                    [&](const Group& group) { return group.story == story; });
    if (known == groups.end())
      groups.push_back({story, {run}});
    else
      known->runs.push_back(run);
  }
  return groups;
}

/// "run 3 (L = 1)", "runs 1 to 4 (L = 1 to L = 2)", "runs 1, 2 and 5".
std::string name_of(const Runs& runs, bool has_labels) {
  const StudyResult &first = *runs.front(), &last = *runs.back();
  const auto in_brackets = [&](const std::string& text) {
    return text.empty() || !has_labels ? std::string{} : " (" + text + ")";
  };
  if (runs.size() == 1) return "run " + std::to_string(first.run) + in_brackets(first.label);
  if (last.run - first.run + 1 == std::ssize(runs))
    return "runs " + std::to_string(first.run) + (runs.size() == 2 ? " and " : " to ") +
           std::to_string(last.run) +
           in_brackets(first.label.empty() ? "" : first.label + " to " + last.label);
  constexpr std::size_t readable = 6;
  if (runs.size() > readable)
    return counted(static_cast<int>(runs.size()), "run") + ", the first of them " +
           std::to_string(first.run) + in_brackets(first.label);
  std::vector<std::size_t> numbers;
  for (const StudyResult* run : runs) numbers.push_back(static_cast<std::size_t>(run->run));
  return "runs " + numbers_text(numbers);
}

std::vector<std::string> lines_of(const std::vector<Group>& groups, bool has_labels) {
  std::vector<std::string> lines;
  for (const Group& group : groups)
    for (std::string& line : wrapped(name_of(group.runs, has_labels) + ": " + group.story,
                                     table_width - 2 * summary_indent))
      lines.push_back(std::move(line));
  return lines;
}

/// What has no more room than a line.
std::string in_a_line(const Group& group) {
  const std::vector<std::string> lines = lines_of({group}, true);
  return lines.front() + (lines.size() > 1 ? " ..." : "");
}

}  // namespace

std::vector<std::string> study_outline(const Case& the_case, const Runs& runs) {
  constexpr std::size_t whole = 4,
                        fewest = 2;  // stretches: of less than two a story tells too little
  for (std::size_t most = whole; most >= fewest; --most) {
    const std::vector<Group> groups = groups_of(the_case, runs, most);
    for (const bool has_labels : {true, false}) {
      std::vector<std::string> lines = lines_of(groups, has_labels);
      if (lines.size() <= most_lines_of_outline) return lines;
    }
  }
  const std::vector<Group> groups = groups_of(the_case, runs, whole);
  std::vector<std::string> lines;
  if (groups.size() <= most_lines_of_outline) {
    for (const Group& group : groups) lines.push_back(in_a_line(group));
    return lines;
  }
  const std::size_t told = groups.front().runs.size() + groups.back().runs.size();
  return {in_a_line(groups.front()),
          "otherwise in " + counted(static_cast<int>(runs.size() - told), "run") + ": see below",
          in_a_line(groups.back())};
}

}  // namespace springfold::io
