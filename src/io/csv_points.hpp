// Numbers, and pairs of them, in a file of comma-separated values.
#pragma once

#include <string>
#include <vector>

#include "table_reader.hpp"

namespace springfold::io {

struct CsvPoint {
  double x = 0, y = 0;
  int line = 0, column = 0;  ///< where y stands
};

/// One pair per line; blank lines and what follows a `#` do not count, nor a first line of words. Reports other
/// lines.
std::vector<CsvPoint> read_csv_points(const TextFile& file, Problems& problems);

struct CsvNumber {
  double value = 0;
  int line = 0;
};

/// One number per line, otherwise as above. @param what  that the numbers are, in messages
std::vector<CsvNumber> read_csv_numbers(const TextFile& file, const std::string& what,
                                        Problems& problems);

}  // namespace springfold::io
