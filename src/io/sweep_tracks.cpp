#include "sweep_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "result_access.hpp"

namespace springfold::io {
namespace {

using Run = SweepPoints::Run;
using Match = std::pair<std::size_t, std::size_t>;  // numbers before and now

/// Lambda, deflection and force of a point, each in parts of how much it changes over all runs.
class Places {
 public:
  Places(const SweepPoints& sweep, const std::vector<const Run*>& runs, const std::string& code) {
    for (const char* name : {"lambda", "deflection", "force"}) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Run* run : runs)
        for (std::size_t i = 0; i < sweep.codes.size(); ++i) {
          const double value = sweep.codes[i] == code ? value_of(*run, i, name) : NAN;
          if (!std::isfinite(value)) continue;
          low = std::min(low, value);
          high = std::max(high, value);
        }
      if (low < high) ranges_.emplace_back(name, high - low);
    }
  }

  double between(const Run& a, std::size_t i, const Run& b, std::size_t j) const {
    double sum = 0;
    for (const auto& [name, range] : ranges_) {
      const double apart = std::abs(value_of(a, i, name) - value_of(b, j, name)) / range;
      if (std::isfinite(apart)) sum += apart;
    }
    return sum;
  }

 private:
  static double value_of(const Run& run, std::size_t point, const std::string& name) {
    const auto& place = run.places[point];
    return place ? value_at(*run.result, *place->branch, place->row, name) : NAN;
  }
  std::vector<std::pair<std::string, double>> ranges_{};
};

/// The shorter list's entries each with one of the longer list's, in their order, with the least sum of distances.
template <class Distance>
std::vector<Match> matches(std::size_t before, std::size_t now, const Distance& distance) {
  const bool is_swapped = before > now;
  const std::size_t few = std::min(before, now), many = std::max(before, now);
  const auto apart = [&](std::size_t i, std::size_t k) {
    return is_swapped ? distance(k, i) : distance(i, k);
  };
  // least[i][k]: the first i of the shorter list among the first k of the longer one.
  std::vector<std::vector<double>> least(
      few + 1, std::vector<double>(many + 1, std::numeric_limits<double>::infinity()));
  std::fill(least[0].begin(), least[0].end(), 0.0);
  for (std::size_t i = 1; i <= few; ++i)
    for (std::size_t k = i; k <= many; ++k)
      least[i][k] = std::min(least[i][k - 1], least[i - 1][k - 1] + apart(i - 1, k - 1));
  std::vector<Match> list;
  for (std::size_t i = few, k = many; i > 0; --k)
    if (least[i][k] != least[i][k - 1]) {
      list.push_back(is_swapped ? Match{k - 1, i - 1} : Match{i - 1, k - 1});
      --i;
    }
  return list;
}

std::vector<std::size_t> points_of(const SweepPoints& sweep, const Run& run,
                                   const std::string& code) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < sweep.codes.size(); ++i)
    if (sweep.codes[i] == code && run.places[i]) points.push_back(i);
  return points;
}

/// @param all  tracks are appended
void follow(const SweepPoints& sweep, const std::vector<const Run*>& runs, const std::string& code,
            std::vector<SweepTrack>& all) {
  const Places places{sweep, runs, code};
  std::vector<std::size_t> before, tracks;  // points of the last run that has any, and their tracks
  const Run* last = nullptr;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::vector<std::size_t> now = points_of(sweep, *runs[r], code);
    if (now.empty()) continue;
    std::vector<std::optional<std::size_t>> goes_on(now.size());
    if (last != nullptr)
      for (const auto& [i, k] :
           matches(before.size(), now.size(), [&](std::size_t a, std::size_t b) {
             return places.between(*last, before[a], *runs[r], now[b]);
           }))
        goes_on[k] = tracks[i];
    tracks.clear();
    for (std::size_t k = 0; k < now.size(); ++k) {
      tracks.push_back(goes_on[k].value_or(all.size()));
      if (!goes_on[k])
        all.push_back(
            {.code = code, .points = std::vector<std::optional<std::size_t>>(runs.size())});
      all[tracks.back()].points[r] = now[k];
    }
    before = now;
    last = runs[r];
  }
}

std::string name_of(const SweepPoints& sweep, const SweepTrack& track) {
  std::vector<std::string> labels;
  for (const auto& point : track.points)
    if (point && std::find(labels.begin(), labels.end(), sweep.labels[*point]) == labels.end())
      labels.push_back(sweep.labels[*point]);
  std::string name;
  for (const std::string& label : labels) name += (name.empty() ? "" : "/") + label;
  return name;
}

}  // namespace

std::vector<SweepTrack> tracks_of(const SweepPoints& sweep, const std::vector<const Run*>& runs) {
  std::vector<SweepTrack> tracks;
  std::vector<std::string> done;
  for (const std::string& code : sweep.codes) {
    if (std::find(done.begin(), done.end(), code) != done.end()) continue;
    done.push_back(code);
    follow(sweep, runs, code, tracks);
  }
  for (SweepTrack& track : tracks) track.name = name_of(sweep, track);
  return tracks;
}

}  // namespace springfold::io
