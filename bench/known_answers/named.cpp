#include "named.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace springfold::known_answers {

std::vector<NamedDraw> read_named(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  std::vector<NamedDraw> draws;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    NamedDraw draw;
    if (!(words >> std::ws) || words.eof()) continue;
    const bool numbers = static_cast<bool>(words >> draw.seed >> draw.number >> std::ws);
    std::getline(words, draw.family);
    draw.family.erase(draw.family.find_last_not_of(' ') + 1);
    const std::string wide = "wide ";
    draw.wide = draw.family.starts_with(wide);
    if (draw.wide) draw.family.erase(0, wide.size());
    if (!numbers || draw.number < 0 || draw.family.empty())
      throw std::runtime_error(path + ":" + std::to_string(number) +
                               ": need seed, draw and family");
    draws.push_back(draw);
  }
  return draws;
}

void write_failures(const std::string& path, unsigned long long seed, bool wide,
                    const std::map<long, Failure>& failures) {
  if (failures.empty()) return;
  std::ofstream file(path);
  for (const auto& [number, failure] : failures)
    file << seed << ' ' << number << (wide ? " wide " : " ") << failure.family << "  # "
         << failure.requirement << '\n';
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace springfold::known_answers
