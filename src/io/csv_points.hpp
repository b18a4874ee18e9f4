// Pairs of numbers in a file of comma-separated values.
#pragma once

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

}  // namespace springfold::io
