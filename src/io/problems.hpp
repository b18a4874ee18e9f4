// Mistakes of a case, collected where they are found and printed where the user can mend them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "springfold/io/nearest.hpp"

namespace springfold::io {

/// A position in a file. Line 0: the file as a whole. Columns count characters from 1.
struct Place {
  std::string file{};
  int line = 0;
  int column = 0;
};

/// A name in the case file that is checked once the mechanism is built.
struct NamedPlace {
  std::string name{};
  Place place{};
  std::string key{};
};

class Problems {
 public:
  /// @param key   key path of the value, "chain[2].elements[1].spring.stiffness"; may be empty
  /// @param what  what is wrong and what is needed
  /// @param when  added to the message: ` (study "Q2", run 3)`. The same mistake at the same place
  ///              is kept once, as it is found first.
  void add(const Place& place, const std::string& key, const std::string& what,
           const std::string& when = "");

  /// Is one of them in this file?
  bool are_in(const std::string& file) const;

  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }

  /// "file:line:col: key: what", files in the order in which they first occur, then by position.
  std::vector<std::string> messages() const;

 private:
  struct Item {
    Place place{};
    std::string text{};
    std::string once{};  ///< without the indices of repetitions
    std::string when{};
  };
  std::vector<Item> items_;
  std::vector<std::string> files_;
};

/// `, did you mean "spring"?`, or `; known here: at, rotate` if none is near.
std::string suggestion(std::string_view got, const std::vector<std::string>& known);

/// `; known here: at, rotate`; nothing where none is known.
std::string known_names(const std::vector<std::string>& known);

/// "a", "b" or "c": the allowed words of a choice.
std::string choices(const std::vector<std::string>& words);

}  // namespace springfold::io
