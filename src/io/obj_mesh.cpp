// Wavefront OBJ.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "mesh.hpp"

namespace springfold::io {
namespace {

struct Word {
  std::string_view text{};
  int line = 1, column = 1;
};

bool is_obj_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Adds the words of one line up to a comment.
/// @returns whether the next line continues it: a backslash stands at its end
bool add_obj_words(std::string_view line, int number, std::vector<Word>& words) {
  line = line.substr(0, line.find('#'));
  while (!line.empty() && is_obj_blank(line.back())) line.remove_suffix(1);
  const bool goes_on = line.ends_with('\\');
  if (goes_on) line.remove_suffix(1);
  for (std::size_t at = 0; at < line.size();) {
    if (is_obj_blank(line[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !is_obj_blank(line[end])) ++end;
    words.push_back({line.substr(at, end - at), number, static_cast<int>(at) + 1});
    at = end;
  }
  return goes_on;
}

class ObjReader {
 public:
  ObjReader(const std::string& file, Problems& problems) : file_{file}, problems_{problems} {
    mesh_.first_number = 1;
  }

  Mesh read(std::string_view bytes) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
    std::vector<Word> words;
    for (int line = 1; !bytes.empty() && !is_full_; ++line) {
      const std::size_t end = bytes.find('\n');
      const bool goes_on = add_obj_words(bytes.substr(0, end), line, words);
      bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
      if (goes_on && !bytes.empty()) continue;
      read_line(words);
      words.clear();
    }
    return std::move(mesh_);
  }

 private:
  void refuse(const Word& word, const std::string& key, const std::string& need) {
    problems_.add({file_, word.line, word.column}, key,
                  "got \"" + std::string{word.text} + "\", need " + need);
  }

  Place place_of(const std::vector<Word>& words) const {
    return {file_, words.front().line, words.front().column};
  }

  void read_line(const std::vector<Word>& words) {
    if (words.empty()) return;
    const std::string what{words.front().text};
    if (what == "v")
      read_vertex(words);
    else if (what == "f")
      read_face(words);
    else if (what == "l")
      read_polyline(words);
    else if (std::find(mesh_.left_out.begin(), mesh_.left_out.end(), what) == mesh_.left_out.end())
      mesh_.left_out.push_back(what);
  }

  void read_vertex(const std::vector<Word>& words) {
    is_full_ = mesh_.vertices.size() == most_vertices;
    if (is_full_)
      return refuse(words.front(), "v", "at most " + std::to_string(most_vertices) + " vertices");
    model::Vec3<double> at = model::Vec3<double>::Zero();
    if (words.size() < 4) refuse(words.front(), "v", "three coordinates behind it");
    for (std::size_t i = 1; i < std::min<std::size_t>(words.size(), 4); ++i) {
      const std::string_view text = words[i].text;
      double& value = at[static_cast<Index>(i) - 1];
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      const bool is_number = error == std::errc{} && end == text.data() + text.size();
      if (!is_number || !(std::abs(value) <= largest_coordinate))
        refuse(words[i], "v", coordinate_need);
    }
    mesh_.vertices.push_back(at);
  }

  /// "3", "3/1", "3/1/2", "3//2", and "-1" for the last one so far.
  std::optional<std::size_t> vertex(const Word& word, const std::string& key) {
    const std::string_view text = word.text.substr(0, word.text.find('/'));
    long number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const long count = std::ssize(mesh_.vertices);
    if (number < 0) number += count + 1;
    const bool usable =
        error == std::errc{} && end == text.data() + text.size() && number >= 1 && number <= count;
    if (usable) return static_cast<std::size_t>(number - 1);
    refuse(word, key,
           count == 0 ? "vertices before it"
                      : "the number of a vertex that stands before it, 1 to " +
                            std::to_string(count) + ", or -1 for the last one");
    return std::nullopt;
  }

  std::vector<std::size_t> vertices(const std::vector<Word>& words, std::size_t fewest) {
    const std::string key{words.front().text};
    std::vector<std::size_t> list;
    for (std::size_t i = 1; i < words.size(); ++i)
      if (const auto found = vertex(words[i], key)) list.push_back(*found);
    if (words.size() <= fewest)
      refuse(words.front(), key, "at least " + std::to_string(fewest) + " vertices behind it");
    return list.size() + 1 == words.size() && list.size() >= fewest ? list
                                                                    : std::vector<std::size_t>{};
  }

  void read_face(const std::vector<Word>& words) {
    std::vector<std::size_t> corners = vertices(words, 3);
    if (!corners.empty()) mesh_.faces.push_back({std::move(corners), place_of(words), "f"});
  }

  void read_polyline(const std::vector<Word>& words) {
    const std::vector<std::size_t> list = vertices(words, 2);
    for (std::size_t i = 0; i + 1 < list.size(); ++i)
      mesh_.edges.push_back({{list[i], list[i + 1]}, Crease::fold, place_of(words), "l"});
  }

  const std::string& file_;
  Problems& problems_;
  Mesh mesh_{};
  bool is_full_ = false;  ///< there are too many vertices: nothing more is read
};

}  // namespace

Mesh read_obj(std::string_view bytes, const std::string& file, Problems& problems) {
  return ObjReader{file, problems}.read(bytes);
}

}  // namespace springfold::io
