// When rows are brought to one size, and how far. Private to core.
#pragma once

namespace springfold::equal_sizes {

inline constexpr double alike = 256;       ///< rows whose sizes differ by less are left as they are
inline constexpr double rounding = 1e-13;  ///< of the median row: smaller rows keep their size
inline constexpr int passes = 8;

}  // namespace springfold::equal_sizes
