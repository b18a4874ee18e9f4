// How the program takes memory from the system.
#pragma once

namespace springfold::cli {

/// Asks glibc for memory in parts of megabytes: a short run would otherwise spend a good part of its time on growing
/// its heap page by page. With one thread of work, memory comes from one place for all. Other C libraries: does
/// nothing.
/// @param threads  of work; 0: not known. To be called before the first of them begins
void take_memory_in_large_parts(int threads);

/// Has the system provide the next pages of this thread's heap at once, a megabyte and a half: one by one, when they
/// are touched, they cost several times as much, on virtual machines a good part of a short run.
void fill_first_pages();

}  // namespace springfold::cli
