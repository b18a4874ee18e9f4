# Flags of our own targets. Users of the installed package get none of them.
add_library(springfold_options INTERFACE)
target_compile_options(springfold_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  # A fused multiply-add rounds once instead of twice: the same case would then give other digits
  # on another processor.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms of GCC 12 at -O3, all inside library headers: std::string's operator+ (GCC bug
  # 105651), packets of two that Eigen never loads from vectors of length one, moved std::variants.
  target_compile_options(springfold_options INTERFACE
    -Wno-restrict -Wno-array-bounds -Wno-maybe-uninitialized -Wno-stringop-overread -Wno-stringop-overflow)
endif()

if(SPRINGFOLD_WARNINGS_AS_ERRORS)
  target_compile_options(springfold_options INTERFACE -Werror)
endif()

if(SPRINGFOLD_SANITIZE)
  # Everything that is linked together must agree on these, so they go into all targets.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  # Compilers tell the sources in different ways that sanitizers are on; this is the same for all.
  add_compile_definitions(_GLIBCXX_ASSERTIONS SPRINGFOLD_SANITIZED)
  # Eigen moves null pointers of matrices without entries; nothing is read there. The other four test every access once
  # more: what the address sanitizer (or the processor) stops anyway, what Eigen asserts, casts that we don't write. They
  # cost clang a quarter of its time; GCC's preset `debug` has them.
  add_compile_options($<$<CXX_COMPILER_ID:Clang>:-fno-sanitize=pointer-overflow,null,alignment,object-size,vptr>)
  # Clang's code stops at undefined behaviour as at an illegal instruction, of which the address sanitizer shows the stack
  # (handle_sigill=1). Words and places of each test would be a seventh of its time; GCC's preset `debug` has them.
  add_compile_options($<$<CXX_COMPILER_ID:Clang>:-fsanitize-trap=undefined>)
  add_link_options(-fsanitize=address,undefined)
  # Programs of eighty megabytes: LLVM's linker takes a fifth of the time.
  find_program(SPRINGFOLD_LLD ld.lld)
  if(SPRINGFOLD_LLD AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    add_link_options(-fuse-ld=lld)
  endif()
endif()

set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
