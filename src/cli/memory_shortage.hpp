// When there is no more memory: room to end cleanly, and an exit code of its own also where that fails.
#pragma once

namespace springfold::cli {

/// From now on a first shortage sets free a reserve, with which what is under way can be taken apart and what
/// was finished be written; and an end of the program in the middle of that (destructors of others want memory
/// too) is exit code 7 with a message, not an abort. Once, at the beginning of main.
void prepare_for_memory_shortage();

}  // namespace springfold::cli
