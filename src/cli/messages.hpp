// Messages of the program on standard error.
#pragma once

#include <ostream>
#include <string>

namespace springfold::cli {

/// One line "springfold: message". What is not visible in the message is written out: names, file
/// names and words of other programs reach the terminal as text only.
void say(std::ostream& err, const std::string& message);

inline constexpr const char* interrupted_reading_text =
    "interrupted while the case was read: nothing was run and nothing was written";

/// For where nothing more can be done.
inline constexpr const char* out_of_memory_text =
    "springfold: out of memory: the case needs more than there is; nothing more was written\n";

}  // namespace springfold::cli
