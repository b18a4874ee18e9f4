// Wavefront OBJ: points, faces, lines.
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "mesh.hpp"

namespace springfold::io {
namespace {

class ObjReader {
 public:
  ObjReader(const std::string& shown_name, Problems& problems)
      : file_{shown_name}, problems_{problems} {}

  Mesh read(const std::string& bytes) {
    mesh_.first_number = 1;
    std::istringstream lines{bytes};
    for (std::string line; std::getline(lines, line);) {
      ++line_;
      read_line(line.substr(0, line.find('#')));
    }
    for (const auto& [word, count] : ignored_)
      mesh_.left_out.push_back(std::to_string(count) + " lines \"" + word + "\"");
    if (mesh_.points.empty()) problems_.add({file_, 0, 0}, "", "has no points, need lines \"v x y z\"");
    return std::move(mesh_);
  }

 private:
  void report(const std::string& what) { problems_.add({file_, line_, 1}, "", what); }

  void read_line(const std::string& line) {
    std::istringstream fields{line};
    std::string word;
    if (!(fields >> word)) return;
    std::vector<std::string> rest;
    for (std::string field; fields >> field;) rest.push_back(field);
    if (word == "v") return read_point(rest);
    if (word == "f" || word == "l") return read_corners(rest, word == "f");
    ++ignored_[word.size() <= longest_word ? word : word.substr(0, longest_word) + "..."];
  }

  void read_point(const std::vector<std::string>& fields) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    bool good = fields.size() >= 3;
    for (std::size_t k = 0; k < 3 && good; ++k) {
      const char* end = fields[k].data() + fields[k].size();
      const auto [at, error] = std::from_chars(fields[k].data(), end, p[static_cast<Index>(k)]);
      good = error == std::errc{} && at == end && std::isfinite(p[static_cast<Index>(k)]);
    }
    if (!good) report("a point needs three numbers, \"v x y z\"");
    mesh_.points.push_back(p);
  }

  /// "3", "3/1", "3//2": the number before the first slash counts from 1, negative ones from the last point.
  void read_corners(const std::vector<std::string>& fields, bool face) {
    std::vector<std::size_t> corners;
    for (const std::string& field : fields) {
      long number = 0;
      const char* end = field.data() + std::min(field.find('/'), field.size());
      const auto [at, error] = std::from_chars(field.data(), end, number);
      const auto count = static_cast<long>(mesh_.points.size());
      if (number < 0) number += count + 1;
      if (error != std::errc{} || at != end || number < 1 || number > count)
        return report("got \"" + field + "\", need the number of a point before, 1 to " +
                      std::to_string(count));
      corners.push_back(static_cast<std::size_t>(number - 1));
    }
    std::vector<std::size_t> different = corners;
    std::sort(different.begin(), different.end());
    if (std::adjacent_find(different.begin(), different.end()) != different.end())
      return report("the same point twice, need different ones");
    if (corners.size() < (face ? 3U : 2U))
      return report(face ? "a face needs three points or more" : "a line needs two points or more");
    if (face) return mesh_.faces.push_back(corners);
    for (std::size_t k = 0; k + 1 < corners.size(); ++k)
      mesh_.edges.push_back({corners[k], corners[k + 1]});
  }

  static constexpr std::size_t longest_word = 20;
  std::string file_;
  Problems& problems_;
  int line_ = 0;
  Mesh mesh_{};
  std::map<std::string, int> ignored_{};
};

}  // namespace

Mesh read_obj(const std::string& bytes, const std::string& shown_name, Problems& problems) {
  return ObjReader{shown_name, problems}.read(bytes);
}

}  // namespace springfold::io
