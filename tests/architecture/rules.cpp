#include "architecture/rules.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace springfold::architecture {
namespace {

using Layers = std::set<std::string>;

/// What each layer may include besides itself.
const std::map<std::string, Layers> below{
    {"core", {}},
    {"continuation", {"core"}},
    {"parameters", {"core", "continuation"}},
    {"model", {"core"}},
    {"statics", {"core", "model"}},
    {"analysis", {"core", "continuation", "parameters", "model", "statics"}},
    {"drawing", {"core", "model", "statics"}},
    {"io", {"core", "continuation", "parameters", "model", "statics", "analysis", "drawing"}},
    {"cli",
     {"core", "continuation", "parameters", "model", "statics", "analysis", "drawing", "io"}},
};

/// What each room of the engine may include besides itself.
const std::map<std::string, Layers> rooms_below{
    {"points", {}},
    {"locating", {"points"}},
    {"kinks", {"points", "locating"}},
    {"branches", {"points", "locating", "kinks"}},
    {"following", {"points", "locating", "kinks"}},
};

struct Library {
  std::string name;
  std::regex headers;
  Layers layers;          ///< whose .cpp files and private headers may include it
  bool one_file = false;  ///< confined to one file of each layer, so that it can be replaced there
};

const std::vector<Library>& libraries() {
  static const std::vector<Library> all{
      {"LAPACK", std::regex{"lapacke\\.h|cblas\\.h"}, {"core"}, true},
      {"SUNDIALS",
       std::regex{"(kinsol|cvode|nvector|sundials|sunlinsol|sunmatrix)/.*"},
       {"statics", "analysis"},
       true},
      {"NLopt", std::regex{"nlopt\\.h(pp)?"}, {"analysis"}, true},
      {"Boost.Odeint", std::regex{"boost/numeric/odeint.*"}, {"continuation"}, true},
      {"Boost", std::regex{"boost/.*"}, {"continuation", "model", "analysis"}},
      {"toml++", std::regex{"toml\\+\\+/.*|toml\\.hpp"}, {"io"}, true},
      {"muParser", std::regex{"muParser.*\\.h"}, {"io"}, true},
      {"gnuplot-iostream", std::regex{"gnuplot-iostream\\.h"}, {"io"}, true},
      {"nlohmann/json", std::regex{"nlohmann/.*"}, {"io", "cli"}},
      {"urdfdom", std::regex{"urdf_parser/.*|console_bridge/.*"}, {"io"}, true},
      {"Nettle", std::regex{"nettle/.*"}, {"io"}, true},
      {"fmt", std::regex{"fmt/.*"}, {"io", "cli"}},
      {"CLI11", std::regex{"CLI/.*"}, {"cli"}, true},
      {"the operating system", std::regex{"[a-z_]+\\.h|sys/[a-z_]+\\.h"}, {"io", "cli"}},
  };
  return all;
}

const Library* library_of(const std::string& include) {
  for (const Library& library : libraries())
    if (std::regex_match(include, library.headers)) return &library;
  return nullptr;
}

struct Place {
  bool is_public = false;
  std::string layer{};
};

/// "include/springfold/io/results.hpp" and "src/io/results.cpp" belong to io.
Place place_of(const SourceFile& file) {
  static const std::regex pattern{"(include/springfold|src)/([a-z]+)/.*"};
  std::smatch match;
  if (!std::regex_match(file.path, match, pattern)) return {};
  return {match[1] != "src", match[2]};
}

std::string sentence(const SourceFile& file, const std::string& include, const std::string& why) {
  return file.path + " includes " + include + ": " + why;
}

bool is_standard(const std::string& include) {
  return include.find_first_of("./") == std::string::npos;
}

}  // namespace

std::vector<SourceFile> cpp_files(const std::filesystem::path& root,
                                  const std::vector<std::string>& folders) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(root / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      std::ostringstream text;
      text << std::ifstream{entry.path()}.rdbuf();
      files.push_back({entry.path().lexically_relative(root).generic_string(), text.str()});
    }
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::string code_only(const std::string& text) {
  std::string code;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size() - 1);
      code += '\n';
    } else if (text.compare(i, 2, "/*") == 0) {
      i = std::min(text.find("*/", i), text.size() - 2) + 1;
      code += ' ';
    } else if (text.compare(i, 3, "R\"(") == 0) {
      i = std::min(text.find(")\"", i), text.size() - 2) + 1;
      code += "\"\"";
    } else if (text[i] == '"' ||
               (text[i] == '\'' &&
                (i == 0 || !std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
      const char quote = text[i];
      for (++i; i < text.size() && text[i] != quote; ++i)
        if (text[i] == '\\') ++i;
      code += std::string{quote, quote};
    } else {
      code += text[i];
    }
  }
  return code;
}

std::vector<std::string> includes_of(const SourceFile& file) {
  static const std::regex pattern{"\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*"};
  std::vector<std::string> includes;
  std::istringstream lines{file.text};
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_match(line, match, pattern)) includes.push_back(match[1]);
  return includes;
}

std::vector<std::string> forbidden_includes(const SourceFile& file) {
  static const std::regex our_public{"springfold/([a-z]+)/.*"},
      our_private{"(([a-z]+)/([a-z]+/)?)?\\w+\\.hpp"};
  const Place place = place_of(file);
  const auto allowed = below.find(place.layer);
  if (allowed == below.end()) return {file.path + " belongs to no layer"};
  const auto may_include = [&](const std::string& layer) {
    return layer == place.layer || allowed->second.count(layer) > 0;
  };

  std::vector<std::string> found;
  for (const std::string& include : includes_of(file)) {
    std::smatch match;
    if (is_standard(include) || include.starts_with("Eigen/") ||
        include == "springfold/version.hpp")
      continue;
    if (std::regex_match(include, match, our_public)) {
      if (!may_include(match[1]))
        found.push_back(sentence(file, include, "not below " + place.layer));
    } else if (const Library* library = library_of(include)) {
      if (place.is_public)
        found.push_back(sentence(file, include, "only Eigen may stand in public headers"));
      else if (library->layers.count(place.layer) == 0)
        found.push_back(sentence(file, include, library->name + " has no place here"));
    } else if (std::regex_match(include, match, our_private)) {
      if (place.is_public)
        found.push_back(sentence(file, include, "a private header in a public one"));
      else if (match[2].matched && match[2] != place.layer)
        found.push_back(sentence(file, include, "a private header of another layer"));
    } else {
      found.push_back(sentence(file, include, "no library that design.md knows"));
    }
  }
  return found;
}

std::vector<std::string> forbidden_rooms(const SourceFile& file) {
  static const std::regex inside{"src/continuation/([a-z]+)/.*"},
      private_header{"continuation/([a-z]+)/\\w+\\.hpp"};
  std::smatch match;
  if (!file.path.starts_with("src/continuation/")) return {};
  if (!std::regex_match(file.path, match, inside) || rooms_below.count(match[1]) == 0)
    return {file.path + " stands in no room of the engine"};
  const std::string room = match[1];
  std::vector<std::string> found;
  for (const std::string& include : includes_of(file))
    if (std::regex_match(include, match, private_header) && match[1] != room &&
        rooms_below.at(room).count(match[1]) == 0)
      found.push_back(sentence(file, include, "not below " + room));
  return found;
}

std::vector<std::string> scattered_libraries(const std::vector<SourceFile>& files) {
  std::map<std::pair<std::string, std::string>, std::set<std::string>> users;  // library, layer
  for (const SourceFile& file : files)
    for (const std::string& include : includes_of(file))
      if (const Library* library = library_of(include); library && library->one_file)
        users[{library->name, place_of(file).layer}].insert(file.path);

  std::vector<std::string> found;
  for (const auto& [user, paths] : users) {
    if (paths.size() == 1) continue;
    std::string text = user.first + " is included by";
    for (const std::string& path : paths) text += " " + path;
    found.push_back(text);
  }
  return found;
}

std::vector<std::string> literals_of(const SourceFile& file) {
  static const std::regex pattern{
      "(^|[^\\w.])((\\d+\\.\\d*|\\.\\d+)(e[+-]?\\d+)?|\\d+e[+-]?\\d+)(?!\\w)"};
  const std::string code = code_only(file.text);
  std::vector<std::string> found;
  for (std::sregex_iterator match{code.begin(), code.end(), pattern}, end; match != end; ++match) {
    const double value = std::stod((*match)[2]);
    if (value != 0 && value != 1 && value != 2 && value != 0.5) found.push_back((*match)[2]);
  }
  return found;
}

std::vector<std::string> bare_tolerances(const SourceFile& file) {
  std::vector<std::string> found;
  for (const std::string& literal : literals_of(file))
    if (std::stod(literal) < 1e-3)
      found.push_back(file.path + " has a tolerance of its own: " + literal);
  return found;
}

std::size_t code_lines(const SourceFile& file) {
  std::istringstream lines{code_only(file.text)};
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);)
    count += line.find_first_not_of(" \t") != std::string::npos;
  return count;
}

std::vector<std::string> prints_or_exits(const SourceFile& file) {
  static const std::regex pattern{
      "\\bstd::(cout|cerr|clog)\\b|\\bfmt::print\\b"
      "|\\b(f|v|vf)?printf\\s*\\(|\\bf?puts\\s*\\(|\\bputchar\\s*\\(|\\bperror\\s*\\("
      "|\\b(std::|::)?(exit|abort|_exit|_Exit|quick_exit|terminate)\\s*\\("};
  const std::string code = code_only(file.text);
  std::vector<std::string> found;
  for (std::sregex_iterator match{code.begin(), code.end(), pattern}, end; match != end; ++match)
    found.push_back(file.path + " uses " + match->str());
  return found;
}

}  // namespace springfold::architecture
