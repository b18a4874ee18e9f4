// What README and docs promise: examples are the files that run, links lead somewhere.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "springfold/analysis/run.hpp"
#include "springfold/io/case_file.hpp"
#include "springfold/io/results.hpp"

namespace springfold {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

const fs::path root{SPRINGFOLD_SOURCE_DIR};

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream{path}.rdbuf();
  return text.str();
}

/// Contains the text, without printing whole documents when it does not.
bool shows(const fs::path& path, const std::string& text) {
  return text_of(path).find(text) != std::string::npos;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files{root / "README.md", root / "CHANGELOG.md", root / "CONTRIBUTING.md"};
  for (const char* folder : {"bench", "cases", "docs", "src"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Places of headings as links name them: lower case, spaces as hyphens, no punctuation.
std::vector<std::string> anchors_of(const std::string& text) {
  std::vector<std::string> anchors;
  std::istringstream lines{text};
  bool in_code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) in_code = !in_code;
    const auto title = line.find_first_not_of('#');
    if (in_code || !line.starts_with('#') || title == std::string::npos || line[title] != ' ')
      continue;
    std::string anchor;
    for (const char c : line.substr(title + 1)) {
      const auto letter = static_cast<unsigned char>(c);
      if (c == ' ') anchor += '-';
      if (letter >= 128 || std::isalnum(letter) || c == '-' || c == '_')
        anchor += static_cast<char>(letter < 128 ? std::tolower(letter) : letter);
    }
    anchors.push_back(anchor);
  }
  return anchors;
}

/// Links of a document to other files of the source tree that lead nowhere.
std::vector<std::string> broken_links(const fs::path& document) {
  static const std::regex link{R"(\]\(([^)\s#]*)(#[^)\s]*)?\))"};
  const std::string text = text_of(document);
  std::vector<std::string> broken;
  for (std::sregex_iterator match{text.begin(), text.end(), link}, end; match != end; ++match) {
    const std::string file = (*match)[1], anchor = (*match)[2];
    if (file.find("://") != std::string::npos) continue;
    const fs::path target = file.empty() ? document : document.parent_path() / file;
    const auto anchors = anchor.empty() ? std::vector<std::string>{} : anchors_of(text_of(target));
    const bool leads_to_a_heading = anchor.empty() || std::find(anchors.begin(), anchors.end(),
                                                                anchor.substr(1)) != anchors.end();
    if (!fs::exists(target) || !leads_to_a_heading)
      broken.push_back(document.lexically_relative(root).string() + ": " + file + anchor);
  }
  return broken;
}

TEST(Documents, LinkOnlyToWhatIsThere) {
  for (const fs::path& document : documents()) EXPECT_THAT(broken_links(document), IsEmpty());
}

/// Characters of a line of UTF-8: all bytes but those that go on with a character.
long characters_of(const std::string& line) {
  return std::count_if(line.begin(), line.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
}

/// Lines of prose with more than 120 characters. Code, tables, headings, and lines that are one link or picture are
/// none.
std::vector<std::string> long_lines(const fs::path& document) {
  static const std::regex no_prose{R"(\s*(\||#|<).*|\s*([-*] )?!?\[[^\]]*\]\([^)]*\)\s*)"};
  std::vector<std::string> found;
  std::ifstream lines{document};
  bool in_code = false, after_blank = true, indented = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto text = line.find_first_not_of(' ');
    const bool fence = text != std::string::npos && line.compare(text, 3, "```") == 0;
    indented = text != std::string::npos && text >= 4 && (indented || after_blank);
    after_blank = text == std::string::npos;
    if (fence) in_code = !in_code;
    if (fence || in_code || indented || characters_of(line) <= 120) continue;
    if (!std::regex_match(line, no_prose))
      found.push_back(document.lexically_relative(root).string() + ":" + std::to_string(number));
  }
  return found;
}

TEST(Documents, HaveLinesOfProseThatEndAt120Characters) {
  for (const fs::path& document : documents()) EXPECT_THAT(long_lines(document), IsEmpty());
}

TEST(Documents, AllStandInTheReadingOrder) {
  for (const auto& entry : fs::directory_iterator(root / "docs")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".md" || name == "README.md") continue;
    EXPECT_TRUE(shows(root / "docs/README.md", "](" + name + ")")) << name;
  }
}

TEST(Gallery, NamesEveryFolderOfTheLibraryAndCountsItsCases) {
  std::size_t count = 0;
  for (const auto& folder : fs::directory_iterator(root / "cases")) {
    if (!folder.is_directory()) continue;
    const std::string name = folder.path().filename().string();
    EXPECT_TRUE(shows(root / "docs/gallery.md", "](../cases/" + name + "/README.md)")) << name;
    for (const auto& file : fs::directory_iterator(folder)) {
      const std::string base = file.path().filename().string();
      count += base.starts_with("case") && base.ends_with(".toml") ? 1 : 0;
    }
  }
  // The last row is that of the last picture of the sheet.
  EXPECT_TRUE(shows(root / "docs/gallery.md", "\n| " + std::to_string(count) + " | "));
  EXPECT_FALSE(shows(root / "docs/gallery.md", "\n| " + std::to_string(count + 1) + " | "));
}

/// Numbers in the first column of a table: "8 to 10, 14".
std::vector<int> numbers_in(const std::string& cell) {
  std::vector<int> numbers;
  const std::regex part{R"((\d+)(?: to (\d+))?)"};
  for (std::sregex_iterator at{cell.begin(), cell.end(), part}, end; at != end; ++at) {
    const int first = std::stoi((*at)[1]), last = (*at)[2].matched ? std::stoi((*at)[2]) : first;
    for (int i = first; i <= last; ++i) numbers.push_back(i);
  }
  return numbers;
}

TEST(Gallery, NamesEveryPictureOfTheSheetOnce) {
  std::istringstream lines{text_of(root / "docs/gallery.md")};
  std::vector<int> numbers, all;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_search(line, std::regex{R"(^\| \d)"}))
      for (const int number : numbers_in(line.substr(2, line.find(" |", 2) - 2)))
        numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  for (int i = 1; i <= static_cast<int>(numbers.size()); ++i) all.push_back(i);
  EXPECT_EQ(numbers, all);
}

TEST(Documents, ShowLinesOfTheExampleOfPicturesThatCanBeRead) {
  const io::Case example = io::load_case(root / "docs/examples/pictures.toml");
  EXPECT_EQ(example.plots.size(), 5U);
  for (const io::PlotSpec& plot : example.plots)
    EXPECT_TRUE(shows(root / "docs/pictures.md", "name = \"" + plot.name + "\"") ||
                plot.name == "way")
        << plot.name;
}

TEST(Documents, ShowTheFirstCaseAsItIs) {
  const std::string first = text_of(root / "docs/examples/first.toml");
  EXPECT_TRUE(shows(root / "README.md", "```toml\n" + first + "```"));
}

TEST(Documents, ShowTheStrutAsItIsCompiledByThePackageTest) {
  const std::string strut = text_of(root / "docs/examples/strut.cpp");
  const std::string printed = text_of(root / "docs/examples/strut.txt");
  EXPECT_TRUE(shows(root / "docs/engine.md", "```cpp\n" + strut + "```"));
  EXPECT_TRUE(shows(root / "docs/engine.md", "```text\n" + printed + "```"));
  EXPECT_TRUE(shows(root / "tests/package/CMakeLists.txt", "examples/strut.cpp"));
}

TEST(FirstCase, GivesTheNumbersThatTheReadmeShows) {
  const io::Case first = io::load_case(root / "docs/examples/first.toml");
  ASSERT_EQ(first.runs.size(), 1u);

  const auto result = analysis::run_study(first.runs[0].mechanism, first.runs[0].plan);

  ASSERT_TRUE(complete(result));
  const auto column = [&](const std::string& name) {
    const auto q = std::find_if(result.quantities.begin(), result.quantities.end(),
                                [&](const auto& quantity) { return quantity.name == name; });
    return static_cast<std::size_t>(q - result.quantities.begin());
  };
  const analysis::Branch& branch = result.branches.front();
  std::vector<std::string> labels;
  for (const auto& event : branch.events) labels.push_back(event.label);
  ASSERT_THAT(labels, testing::ElementsAre("EP1", "LP1", "LP2", "EP2"));
  const auto at = [&](std::size_t event, const std::string& name) {
    return branch.samples[branch.events[event].row].values[column(name)];
  };
  EXPECT_NEAR(at(1, "force"), 0.027008033908, 1e-11);
  EXPECT_NEAR(at(2, "force"), 0.000837559006, 1e-11);
  EXPECT_NEAR(at(1, "deflection"), 0.20587635, 1e-8);
  const auto& start = branch.samples[branch.start_row].values;
  EXPECT_NEAR(start[column("leg_x.drive.rho")], 1.355785385, 1e-9);

  const std::size_t between = branch.events[1].row + 2;
  ASSERT_LT(between, branch.events[2].row);
  EXPECT_EQ(branch.samples[between].values[column("index")], 0);
  EXPECT_EQ(branch.samples[between].values[column("index_force")], 1);

  std::istringstream lines{io::summary_table(first, {result})};
  for (std::string line; std::getline(lines, line);)
    for (const char* word : {"commands", "K_eig", "points", "EP1", "LP1", "LP2", "EP2"}) {
      if (!line.starts_with(std::string{"    "} + word)) continue;
      EXPECT_TRUE(shows(root / "README.md", line)) << line;
    }
}

}  // namespace
}  // namespace springfold
