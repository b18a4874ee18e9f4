// The numbers of one part of a case: what each is, what it must be, its value for given parameters.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "parameters.hpp"

namespace springfold::io {

using NumberId = std::size_t;

enum class Range {
  finite,
  non_negative,
  positive,
  maybe_infinite,  ///< anything but NaN
  whole,           ///< 0, 1, 2, ...
  small_count,     ///< 1, 2, ... 1000000
  at_least_one,    ///< any finite number >= 1
  at_least_two,    ///< 2, 3, ... 1000000
  segment_count,   ///< 1, 2, ... 5000
};

/// What a number must be.
struct Rule {
  Range range = Range::finite;
  std::string unit{};  ///< for messages: "N/m"; empty: a pure number
  std::string hint{};  ///< for messages: "; what else would help"
};

/// "a number >= 0 [N/m]".
std::string need_of(const Rule& rule);

class NumberTable {
 public:
  /// A default value: no rule, no place.
  NumberId add(double constant);
  NumberId add(const Definition& definition, const Rule& rule);

  /// Values must increase; `what` names the rule: "low < high".
  void require_less(NumberId lower, NumberId upper, const std::string& what);

  /// Not all of `ids` may be zero. @param what  "an axis needs a length"
  void require_nonzero(const std::vector<NumberId>& ids, const Place& place, const std::string& key,
                       const std::string& what);

  /// @param problem_in  of these values, all finite: what is wrong with them; empty when usable
  /// @param infinite    values may be infinite too
  void require(const std::vector<NumberId>& ids, const Place& place, const std::string& key,
               std::function<std::string(const std::vector<double>&)> problem_in,
               bool infinite = false);

  std::size_t size() const { return entries_.size(); }
  const Rule& rule(NumberId id) const { return entries_[id].rule; }
  const Definition& definition(NumberId id) const { return entries_[id].definition; }

  Values values(const FormulaBook& book, const Values& parameters) const;

  /// Reports every number and relation that breaks its rule, except those marked in `reported`
  /// (empty at first), and marks them there.
  void check(const Values& values, const std::string& when, Problems& problems,
             std::vector<bool>& reported) const;

  /// Numbers whose formulas name one of the parameters marked in `moves`.
  std::vector<Update> updates_for(const std::vector<bool>& moves, const FormulaBook& book) const;

 private:
  struct Entry {
    Definition definition{};
    Rule rule{};
  };
  struct Relation {
    std::vector<NumberId> ids{};
    bool nonzero = false;  ///< otherwise: ids[0] < ids[1]
    Place place{};
    std::string key{};
    std::string what{};
    std::function<std::string(const std::vector<double>&)> problem_in{};  ///< instead of these
    bool infinite = false;  ///< may values be infinite?
  };
  std::string broken(const Relation& relation, const Values& values) const;

  std::vector<Entry> entries_;
  std::vector<Relation> relations_;
};

}  // namespace springfold::io
