#include "problems.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_set>

#include "springfold/io/shown_text.hpp"

namespace springfold::io {
namespace {

/// More messages than that help nobody.
constexpr std::size_t most_messages = 100;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Letters to change: insertions, deletions, replacements and swaps of neighbours
/// (Damerau-Levenshtein in its restricted form), without regard to case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

/// "bar[2].free" of "bar[2, i = 3].free": one mistake in what is repeated is one mistake.
std::string without_indices(const std::string& text) {
  std::string once;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t end = text[i] == ',' ? text.find(']', i) : std::string::npos;
    const bool indices =
        end != std::string::npos && text.substr(i, end - i).find(" = ") != std::string::npos;
    if (indices && text.find_first_not_of("0123456789", text.rfind('[', i) + 1) == i) i = end;
    once += text[i];
  }
  return once;
}

}  // namespace

void Problems::add(const Place& place, const std::string& key, const std::string& what,
                   const std::string& when) {
  if (std::find(files_.begin(), files_.end(), place.file) == files_.end())
    files_.push_back(place.file);
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  text += ": ";
  if (!key.empty()) text += key + ": ";
  text += what;
  text = shown(text);  // keys and names come from the file: one message stays one line
  const std::string once = without_indices(text);
  // The same mistake comes again soon, with the next run or the next index of a repetition; others are
  // found when all are printed.
  constexpr std::ptrdiff_t looked_at = 200;
  const auto begin = items_.end() - std::min(std::ssize(items_), looked_at);
  const auto is_same = [&once](const Item& item) { return item.once == once; };
  if (std::none_of(begin, items_.end(), is_same)) items_.push_back({place, text, once, when});
}

bool Problems::are_in(const std::string& file) const {
  return std::any_of(items_.begin(), items_.end(),
                     [&file](const Item& item) { return item.place.file == file; });
}

std::vector<std::string> Problems::messages() const {
  const auto rank = [this](const Item& item) {
    const auto file = std::find(files_.begin(), files_.end(), item.place.file);
    return std::tuple{file - files_.begin(), item.place.line, item.place.column};
  };
  std::vector<Item> sorted = items_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Item& a, const Item& b) { return rank(a) < rank(b); });
  std::vector<std::string> texts;
  std::unordered_set<std::string_view> seen;
  std::size_t others = 0;
  for (const Item& item : sorted) {
    if (!seen.insert(item.text).second) continue;
    if (texts.size() == most_messages)
      ++others;
    else
      texts.push_back(item.text + item.when);
  }
  if (others > 0)
    texts.push_back("and " + std::to_string(others) + " other mistake" + (others > 1 ? "s" : ""));
  return texts;
}

std::string nearest(std::string_view got, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 60;  // nobody mistypes a name of that length by a few letters
  if (got.empty() || got.size() > longest) return {};
  const std::size_t most = std::max<std::size_t>(1, (got.size() + 1) / 3);
  const auto difference = [&got](const std::string& name) {
    return std::max(got.size(), name.size()) - std::min(got.size(), name.size());
  };
  // Words that begin alike, "studies" and "study", may differ by one letter more.
  const auto begins_alike = [&got](const std::string& name) {
    constexpr std::size_t letters = 4;
    return name.size() >= letters && got.substr(0, letters) == name.substr(0, letters);
  };
  std::string best;
  std::pair least{most + 2, std::size_t{0}};
  constexpr std::size_t most_candidates = 1000;
  std::size_t looked_at = 0;
  for (const std::string& candidate : known) {
    if (++looked_at > most_candidates) break;
    if (difference(candidate) > most + 1) continue;  // the distance is at least that
    const std::size_t distance = edit_distance(got, candidate);
    if (distance >= std::max(got.size(), candidate.size())) continue;
    if (distance > most + (begins_alike(candidate) ? 1 : 0)) continue;
    const std::pair rank{distance, difference(candidate)};
    if (rank >= least) continue;
    least = rank;
    best = candidate;
  }
  return best;
}

std::string suggestion(std::string_view got, const std::vector<std::string>& known) {
  const std::string near = nearest(got, known);
  return near.empty() ? known_names(known) : ", did you mean \"" + near + "\"?";
}

std::string known_names(const std::vector<std::string>& known) {
  if (known.empty()) return {};
  constexpr std::size_t most = 40;
  std::string list;
  for (std::size_t i = 0; i < std::min(known.size(), most); ++i)
    list += (i == 0 ? "" : ", ") + known[i];
  return "; known here: " + list + (known.size() > most ? ", ..." : "");
}

std::string choices(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += "\"" + words[i] + "\"";
  }
  return text;
}

}  // namespace springfold::io
