# What was compiled before is not compiled again: ccache, where it is installed. -DCMAKE_CXX_COMPILER_LAUNCHER=... or
# the environment's variable of that name comes first.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(SPRINGFOLD_CCACHE ccache)
  mark_as_advanced(SPRINGFOLD_CCACHE)
  if(SPRINGFOLD_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${SPRINGFOLD_CCACHE}")
  endif()
endif()
