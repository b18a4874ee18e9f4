# What was compiled before is not compiled again: ccache, where it is installed. -DCMAKE_CXX_COMPILER_LAUNCHER=... or
# the environment's variable of that name comes first.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(SPRINGFOLD_CCACHE ccache)
  mark_as_advanced(SPRINGFOLD_CCACHE)
  if(SPRINGFOLD_CCACHE)
    # It shares objects that were compiled with precompiled headers only where it is told that it may.
    set(CMAKE_CXX_COMPILER_LAUNCHER
        "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${SPRINGFOLD_CCACHE}")
  endif()
endif()
