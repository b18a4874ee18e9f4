#include "strings.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

constexpr std::size_t image_count = 21;

/// The shortest difference of two states: angles modulo their periods.
Vector difference(const Landscape& landscape, const Vector& to, const Vector& from) {
  const auto& moving = landscape.moving();
  Vector d = (to - from)(moving);
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const double period = landscape.periods()[moving[k]];
    const auto i = static_cast<Index>(k);
    if (period > 0) d[i] = std::remainder(d[i], period);
  }
  return d;
}

class StringOfImages {
 public:
  StringOfImages(const Landscape& landscape, const Vector& from, const Vector& to)
      : landscape_{landscape} {
    const Vector way = difference(landscape, to, from);
    for (std::size_t k = 0; k < image_count; ++k) {
      Vector x = from;
      x(landscape.moving()) += static_cast<double>(k) / (image_count - 1) * way;
      images_.push_back(std::move(x));
    }
  }

  RelaxedWay relax() {
    constexpr int rounds = 120;
    constexpr double arrived = 1e-3;  // of the distance between images
    RelaxedWay way;
    for (Vector& x : images_)
      if (!landscape_.close(x)) return way;
    for (int k = 0; k < rounds; ++k) {
      if (!spread()) return way;
      const auto moved = descend_across();
      if (!moved) return way;
      if (*moved < arrived * spacing_) break;
    }
    if (!spread()) return way;
    way.is_whole = is_whole();
    for (const Vector& x : images_) way.energies.push_back(landscape_.energy(x));
    way.images = std::move(images_);
    return way;
  }

 private:
  double gap(std::size_t k) const {
    return (images_[k + 1] - images_[k])(landscape_.moving()).norm();
  }

  /// Images at even lengths of the way. @returns false where one cannot be closed
  bool spread() {
    std::vector<double> length{0};
    for (std::size_t k = 0; k + 1 < images_.size(); ++k) length.push_back(length.back() + gap(k));
    spacing_ = length.back() / static_cast<double>(images_.size() - 1);
    if (!(spacing_ > 0)) return false;
    const std::vector<Vector> old = images_;
    std::size_t k = 0;
    for (std::size_t i = 1; i + 1 < images_.size(); ++i) {
      const double wanted = spacing_ * static_cast<double>(i);
      while (k + 2 < length.size() && length[k + 1] < wanted) ++k;
      const double part = (wanted - length[k]) / std::max(length[k + 1] - length[k], 1e-300);
      images_[i] = old[k] + part * (old[k + 1] - old[k]);
      if (!landscape_.close(images_[i])) return false;
    }
    return true;
  }

  /// One step of every image downhill, at right angles to the way. @returns the longest one
  std::optional<double> descend_across() {
    double longest = 0;
    std::vector<Vector> next = images_;
    for (std::size_t i = 1; i + 1 < images_.size(); ++i) {
      const auto at = landscape_.ground(images_[i]);
      if (!at || at->hessian.size() == 0) return std::nullopt;
      Vector along =
          at->motions.transpose() * (images_[i + 1] - images_[i - 1])(landscape_.moving());
      if (!(along.norm() > 0)) continue;
      along.normalize();
      const Matrix across = kernel_of(along.transpose());
      if (across.cols() == 0) continue;
      const SymmetricEigen modes = symmetric_eigen(across.transpose() * at->hessian * across);
      Vector y = -modes.vectors.transpose() * (across.transpose() * at->slope);
      // No mode is taken as softer than this part of the stiffest one: steps stay bounded.
      constexpr double softest = 1e-2;
      const double floor = softest * modes.values.cwiseAbs().maxCoeff();
      for (Index m = 0; m < y.size(); ++m)
        y[m] /= std::max({floor, std::abs(modes.values[m]), std::numeric_limits<double>::min()});
      const double size = y.norm(), most = spacing_ / 2;
      if (size > most) y *= most / size;
      longest = std::max(longest, std::min(size, most));
      const auto x = landscape_.moved(*at, across * (modes.vectors * y));
      if (!x) return std::nullopt;
      next[i] = *x;
      next[i](landscape_.multipliers()) = images_[i](landscape_.multipliers());
    }
    images_ = std::move(next);
    return longest;
  }

  /// On closures that leave two separate parts, interpolated images fall to one or the other: a gap stays between.
  bool is_whole() const {
    constexpr double allowed = 3;  // times the mean distance
    for (std::size_t k = 0; k + 1 < images_.size(); ++k)
      if (gap(k) > allowed * spacing_) return false;
    return true;
  }

  const Landscape& landscape_;
  std::vector<Vector> images_{};
  double spacing_ = 0;
};

/// Which minima known saddles join.
class JoinedMinima {
 public:
  explicit JoinedMinima(StateBook& book) {
    for (std::size_t s = 0; s < book.states().size(); ++s)
      if (is_pass(book.states()[s])) book.ways_from(s);  // may add minima
    for (std::size_t s = 0; s < book.states().size(); ++s) group_.push_back(book.first_of_turns(s));
    for (std::size_t s = 0; s < book.states().size(); ++s)
      if (is_pass(book.states()[s]))
        for (const WaysDown& ways = book.ways_from(s); const std::size_t m : ways.minima)
          join(ways.minima.front(), m);
  }
  bool are(std::size_t a, std::size_t b) const { return group_[a] == group_[b]; }
  bool all_one(const std::vector<std::size_t>& minima) const {
    return std::all_of(minima.begin(), minima.end(),
                       [&](std::size_t m) { return are(m, minima.front()); });
  }

 private:
  static bool is_pass(const RestState& state) { return state.index == 1 && state.is_clear; }
  void join(std::size_t a, std::size_t b) {
    const std::size_t old = group_[b], now = group_[a];
    if (old != now) std::replace(group_.begin(), group_.end(), old, now);
  }
  std::vector<std::size_t> group_{};
};

/// Of those that are the same but for whole turns the first.
std::vector<std::size_t> minima_of(const StateBook& book) {
  std::vector<std::size_t> list;
  for (std::size_t s = 0; s < book.states().size(); ++s)
    if (is_minimum(book.states()[s]) && book.first_of_turns(s) == s) list.push_back(s);
  return list;
}

/// What a string between two minima meets goes to the book.
void follow_string(StateBook& book, std::size_t a, std::size_t b) {
  const Landscape& landscape = book.landscape();
  const RelaxedWay way = relaxed_way(landscape, book.states()[a].x, book.states()[b].x);
  if (!way.is_whole) return;
  for (const RestState& saddle : saddles_on(landscape, way)) book.ways_from(book.add(saddle));
  for (std::size_t k = 1; k + 1 < way.energies.size(); ++k)
    if (way.energies[k] < way.energies[k - 1] && way.energies[k] <= way.energies[k + 1])
      book.ways_down(way.images[k]);
}

}  // namespace

RelaxedWay relaxed_way(const Landscape& landscape, const Vector& from, const Vector& to) {
  return StringOfImages(landscape, from, to).relax();
}

std::vector<RestState> saddles_on(const Landscape& landscape, const RelaxedWay& way) {
  std::vector<RestState> list;
  for (std::size_t k = 1; k + 1 < way.images.size(); ++k) {
    if (!(way.energies[k] > way.energies[k - 1] && way.energies[k] >= way.energies[k + 1]))
      continue;
    Vector along = (way.images[k + 1] - way.images[k - 1])(landscape.moving());
    along.normalize();
    auto saddle = climb(landscape, way.images[k], along);
    if (!saddle || saddle->index != 1 || !saddle->is_clear) continue;
    const bool known = std::any_of(list.begin(), list.end(), [&](const RestState& other) {
      return landscape.same(other.x, saddle->x);
    });
    if (!known) list.push_back(std::move(*saddle));
  }
  return list;
}

void join_by_strings(StateBook& book) {
  constexpr std::size_t few = 6;  // minima between all pairs of which there are strings,
  constexpr std::size_t small =
      40;  // in mechanisms with so many coordinates: otherwise they take minutes
  constexpr int most_strings = 400;  // each costs about 0.05 s
  std::set<std::pair<std::size_t, std::size_t>> tried;
  for (int n = 0; n < most_strings; ++n) {
    const std::vector<std::size_t> minima = minima_of(book);
    if (minima.size() < 2) return;
    const JoinedMinima joined(book);
    const bool are_few = minima.size() <= few && book.landscape().moving().size() <= small;
    if (!are_few && joined.all_one(minima)) return;
    std::optional<std::pair<std::size_t, std::size_t>> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < minima.size(); ++i)
      for (std::size_t j = i + 1; j < minima.size(); ++j) {
        const std::pair pair{minima[i], minima[j]};
        if ((!are_few && joined.are(pair.first, pair.second)) || tried.count(pair) > 0) continue;
        const double distance =
            difference(book.landscape(), book.states()[pair.first].x, book.states()[pair.second].x)
                .norm();
        if (distance < least) least = distance, nearest = pair;
      }
    if (!nearest) return;
    tried.insert(*nearest);
    follow_string(book, nearest->first, nearest->second);
  }
}

}  // namespace springfold::analysis
