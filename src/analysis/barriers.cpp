#include "barriers.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "branch_rows.hpp"
#include "springfold/core/number_text.hpp"
#include "start.hpp"
#include "strings.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

/// States that are joined by saddles, lowest saddles first. State 0 stands for all that lies outside: ways lead there,
/// and none back.
class Joined {
 public:
  explicit Joined(std::size_t states) : group_(states + 1), leads_out_(states + 1, false) {
    for (std::size_t i = 0; i < group_.size(); ++i) group_[i] = static_cast<int>(i);
  }
  void join(int a, int b) {
    if (b == 0) {
      leads_out_[of(a)] = true;
      return;
    }
    const bool out = leads_out_[of(a)] || leads_out_[of(b)];
    const int old = group_[static_cast<std::size_t>(b)], now = group_[static_cast<std::size_t>(a)];
    std::replace(group_.begin(), group_.end(), old, now);
    leads_out_[of(a)] = out;
  }
  bool are(int a, int b) const { return b == 0 ? bool{leads_out_[of(a)]} : of(a) == of(b); }

 private:
  std::size_t of(int state) const {
    return static_cast<std::size_t>(group_[static_cast<std::size_t>(state)]);
  }
  std::vector<int> group_;
  std::vector<bool> leads_out_;  ///< per group
};

/// Looks at every saddle of one lambda.
class Barriers {
 public:
  Barriers(const Stretches& stretches, const Tracing& t, const Scales& scales, const Frozen& frozen,
           StudyResult& result, TransitionReport& found)
      : stretches_{stretches},
        t_{t},
        unit_{scales.moment()},
        frozen_{frozen},
        result_{result},
        found_{found},
        first_{found.barriers.size()} {}

  void find(StateBook& book) {
    found_.energy_counts_turns |= book.has_turns();
    for (std::size_t s = 0; s < book.states().size(); ++s) look_at(book, s);
    find_lowest_ways(found_, first_);
    find_unjoined(book);
  }

 private:
  void doubt(const std::string& what) {
    std::string text = "at lambda = " + rounded(t_.lambda_scale * frozen_.lambda()) + " " + what;
    if (std::find(result_.doubts.begin(), result_.doubts.end(), text) == result_.doubts.end())
      result_.doubts.push_back(std::move(text));
  }

  /// The stretch of a minimum; 0: none.
  int number_of(const StateBook& book, std::size_t minimum) {
    numbers_.resize(book.states().size(), unknown);
    if (numbers_[minimum] == unknown)
      numbers_[minimum] = stretches_.number_of(frozen_, book.states()[minimum].x);
    return numbers_[minimum];
  }

  /// One pair of states for every part that no way joins with the others.
  void find_unjoined(const StateBook& book) {
    Joined joined(found_.states.size());
    for (std::size_t i = first_; i < found_.barriers.size(); ++i)
      joined.join(found_.barriers[i].first, found_.barriers[i].second);
    std::set<int> parts;  // by their first states
    std::vector<int> states;
    for (std::size_t s = 0; s < book.states().size(); ++s)
      if (is_minimum(book.states()[s]) && number_of(book, s) > 0)
        states.push_back(number_of(book, s));
    std::sort(states.begin(), states.end());
    for (const int state : states)
      if (std::none_of(parts.begin(), parts.end(),
                       [&](int part) { return joined.are(part, state); }))
        parts.insert(state);
    for (const int part : parts)
      if (part != *parts.begin())
        found_.unjoined.push_back({t_.lambda_scale * frozen_.lambda(), *parts.begin(), part});
  }

  void look_at(StateBook& book, std::size_t s) {
    if (!book.states()[s].is_clear)
      doubt("a state of rest has next to no stiffness: barriers there are not decided");
    if (book.states()[s].index != 1 || !book.states()[s].is_clear) return;
    const WaysDown ways = book.ways_from(s);
    if (ways.lost) doubt("a way down from a saddle ended at no state that is known to be stable");
    const bool leads_away = ways.away && ways.minima.size() == 1;
    if (ways.minima.size() != 2 && !leads_away) return;
    std::size_t a = ways.minima.front(), b = ways.minima.back();
    if (!leads_away && number_of(book, b) < number_of(book, a)) std::swap(a, b);
    // Minima outside of the study's limits are on no stretch: a way to them leads out, as one without end does.
    int first = number_of(book, a), second = leads_away ? 0 : number_of(book, b);
    if (first == 0) std::swap(first, second), std::swap(a, b);
    if (first == 0) return;
    // A state and itself a turn farther: the lower side first.
    if (first == second && book.states()[a].energy < book.states()[b].energy) std::swap(a, b);
    const double height = unit_ * book.states()[s].energy;
    add({.lambda = t_.lambda_scale * frozen_.lambda(),
         .first = first,
         .second = second,
         .from_first = height - unit_ * book.states()[a].energy,
         .from_second = leads_away ? std::numeric_limits<double>::quiet_NaN()
                                   : height - unit_ * book.states()[b].energy},
        book.states()[s]);
  }

  void add(Barrier barrier, const RestState& saddle) {
    const auto same =
        std::find_if(found_.barriers.begin() + static_cast<std::ptrdiff_t>(first_),
                     found_.barriers.end(), [&](const Barrier& other) {
                       return other.first == barrier.first && other.second == barrier.second;
                     });
    if (same != found_.barriers.end() && same->from_first <= barrier.from_first) return;
    CurvePoint point;
    point.x = t_.problem.reduce(frozen_.unknowns(saddle.x));
    point.lambda = frozen_.lambda();
    point.piece = saddle.piece;
    count_negative(t_.problem, point);
    Branch single = single_point(point, t_.evaluator, t_.quantities, t_.problem);
    barrier.saddle = {std::move(single.samples.front().values),
                      single.samples.front().piece,
                      unit_ * saddle.energy,
                      1,
                      0,
                      0};
    if (same != found_.barriers.end())
      *same = std::move(barrier);
    else
      found_.barriers.push_back(std::move(barrier));
  }

  static constexpr int unknown = -1;
  const Stretches& stretches_;
  const Tracing& t_;
  double unit_;
  const Frozen& frozen_;
  StudyResult& result_;
  TransitionReport& found_;
  std::size_t first_;
  std::vector<int> numbers_{};  ///< of the book's states
};

}  // namespace

SearchEnd search_all(StateBook& book, const SnapSettings& settings,
                     const std::function<bool(const RestState&)>& is_within) {
  const StateSearch options{.starts = settings.transitions->starts,
                            .seed = settings.seed,
                            .modes = std::numeric_limits<int>::max(),
                            .drives = std::numeric_limits<int>::max(),
                            .maximum = most_states,
                            .is_within = is_within};
  book.search(options);
  join_by_strings(book);
  book.climb_from_minima(options);  // from those that only strings met
  return {std::ssize(book.states()) >= most_states, book.met_bounds()};
}

void find_barriers(const Stretches& stretches, const Tracing& tracing, const Scales& scales,
                   const Frozen& frozen, StateBook& book, StudyResult& result,
                   TransitionReport& found) {
  Barriers(stretches, tracing, scales, frozen, result, found).find(book);
}

namespace {

/// Of every state beside one of the barriers the lowest one.
void find_escapes(const std::vector<Barrier*>& barriers, TransitionReport& report) {
  std::vector<std::optional<Escape>> lowest(report.states.size() + 1);
  const auto see = [&](double lambda, int state, int to, double energy) {
    auto& known = lowest[static_cast<std::size_t>(state)];
    if (state > 0 && (!known || energy < known->energy)) known = {lambda, state, to, energy};
  };
  for (const Barrier* b : barriers) {
    see(b->lambda, b->first, b->second, b->from_first);
    see(b->lambda, b->second, b->first, b->from_second);
  }
  for (const auto& escape : lowest)
    if (escape) report.escapes.push_back(*escape);
  std::stable_sort(report.escapes.begin(), report.escapes.end(),
                   [](const Escape& a, const Escape& b) {
                     return a.lambda != b.lambda ? a.lambda < b.lambda : a.state < b.state;
                   });
}

}  // namespace

void find_lowest_ways(TransitionReport& report, std::size_t from) {
  std::vector<Barrier*> list;
  for (std::size_t i = from; i < report.barriers.size(); ++i) list.push_back(&report.barriers[i]);
  std::stable_sort(list.begin(), list.end(), [](const Barrier* a, const Barrier* b) {
    return a->saddle.energy < b->saddle.energy;
  });
  Joined joined(report.states.size());
  find_escapes(list, report);
  if (report.energy_counts_turns) return;  // of saddles some turns apart neither is the lower one
  std::vector<bool> has_way(list.size(), false);
  for (std::size_t done = 0; done < list.size(); ++done) {
    const Barrier& now = *list[done];
    if (joined.are(now.first, now.second)) continue;
    joined.join(now.first, now.second);
    for (std::size_t i = done; i < list.size(); ++i) {
      Barrier& b = *list[i];
      if (has_way[i] || !joined.are(b.first, b.second)) continue;
      has_way[i] = true;
      b.lowest_from_first = b.from_first - (b.saddle.energy - now.saddle.energy);
      b.lowest_from_second = b.from_second - (b.saddle.energy - now.saddle.energy);
    }
  }
}

}  // namespace springfold::analysis
