// Keys that the laws of springs share. Private to their readers.
#pragma once

#include <string>
#include <vector>

#include "mechanism_reader.hpp"

namespace springfold::io {

/// The numbers of one spring, in the units of its joint.
struct SpringReader {
  const Item& item;
  const JointUnits units;
  NumberTable& numbers;
  Reading& reading;

  TableReader table(std::vector<std::string> keys) const;

  /// @param falling  may it be negative?
  NumberId stiffness(const TableReader& t, const std::string& name, bool falling = false) const;
  NumberId coordinate(const TableReader& t, const std::string& name) const;
  NumberId free(const TableReader& t) const;

  /// `side`: below?
  bool below(const TableReader& t) const;

  void report(const TableReader& t, const std::string& name, const std::string& what) const;
};

/// Laws that are not made of straight lines, and tables. @pre item is a table with this law
SpringDraft read_polynomial(const SpringReader& reader);
SpringDraft read_formula_law(const SpringReader& reader);
SpringDraft read_logarithmic(const SpringReader& reader);
SpringDraft read_power(const SpringReader& reader);
SpringDraft read_table_law(const SpringReader& reader);

}  // namespace springfold::io
