#include "frontal_plan.hpp"

#include <algorithm>

namespace springfold {
namespace {

/// One string at a time; `last` is the last front that holds a variable, `place` its place in the
/// present one, or -1.
class Planner {
 public:
  explicit Planner(const FrontalPattern& pattern)
      : pattern_{pattern},
        last_(static_cast<std::size_t>(pattern.size), 0),
        place_(static_cast<std::size_t>(pattern.size), -1) {}

  Plans plan() {
    std::vector<char> seen(last_.size(), 0);
    for (std::size_t f = 0; f < pattern_.front_count(); ++f)
      for (std::size_t i = pattern_.first_variable[f]; i < pattern_.first_variable[f + 1]; ++i) {
        const auto v = static_cast<std::size_t>(pattern_.variables[i]);
        last_[v] = f;
        seen[v] = 1;
      }
    std::vector<Index> stayed;
    for (std::size_t f = 0; f < pattern_.front_count(); ++f) {
      add_front(f, stayed);
      if (pattern_.ends_string[f] != 0) stayed.clear();
    }
    for (Index v = 0; v < pattern_.size; ++v)
      if (seen[static_cast<std::size_t>(v)] == 0 && !is_root(v)) plans_.loose.push_back(v);
    return std::move(plans_);
  }

 private:
  bool is_root(Index v) const {
    return v >= pattern_.root_first && v < pattern_.root_first + pattern_.root_count;
  }

  void add_front(std::size_t f, std::vector<Index>& stayed) {
    std::vector<Index> all;  // new ones first: they are tried first as pivots
    const auto begin = pattern_.variables.begin();
    for (std::size_t i = pattern_.first_variable[f]; i < pattern_.first_variable[f + 1]; ++i) {
      const Index v = *(begin + static_cast<std::ptrdiff_t>(i));
      if (std::find(stayed.begin(), stayed.end(), v) == stayed.end()) all.push_back(v);
    }
    all.insert(all.end(), stayed.begin(), stayed.end());
    const auto ends = [&](Index v) {
      return !is_root(v) && last_[static_cast<std::size_t>(v)] == f;
    };
    const auto middle = std::stable_partition(all.begin(), all.end(), ends);
    const Plan plan{middle - all.begin(), all.end() - middle, plans_.ids.size()};
    for (std::size_t i = 0; i < all.size(); ++i)
      place_[static_cast<std::size_t>(all[i])] = static_cast<Index>(i);
    plans_.first_carried.push_back(plans_.carried_places.size());
    for (const Index v : stayed)
      plans_.carried_places.push_back(place_[static_cast<std::size_t>(v)]);
    for (std::size_t i = pattern_.first_variable[f]; i < pattern_.first_variable[f + 1]; ++i)
      plans_.element_places.push_back(place_[static_cast<std::size_t>(pattern_.variables[i])]);
    plans_.ids.insert(plans_.ids.end(), all.begin(), all.end());
    plans_.fronts.push_back(plan);
    stayed.assign(middle, all.end());
  }

  const FrontalPattern& pattern_;
  Plans plans_;
  std::vector<std::size_t> last_;
  std::vector<Index> place_;
};

}  // namespace

Plans plan_fronts(const FrontalPattern& pattern) { return Planner(pattern).plan(); }

}  // namespace springfold
