# Headers of others that most files read, parsed once for each kind of flags: half of the time of a build is reading
# them. Only others' headers stand here, so that ours still warn, and public ones are compiled alone as well
# (tests/CMakeLists.txt).
option(SPRINGFOLD_PRECOMPILED_HEADERS "Parse the headers of Eigen, GoogleTest and the standard library once" ON)

set(springfold_common_headers
    <Eigen/Core> <Eigen/LU>
    <algorithm> <array> <cassert> <cmath> <functional> <limits> <map> <memory> <numbers> <optional> <set> <span> <string>
    <string_view> <utility> <variant> <vector>)
# Tests do little arithmetic themselves; the optimiser would cost minutes.
set(springfold_test_options $<$<CONFIG:Release>:-O1>)
set(springfold_test_headers ${springfold_common_headers} <gmock/gmock.h> <gtest/gtest.h> <filesystem> <random>)

# springfold_precompile(<target> [TESTS]): the headers are parsed for a target of their own, and taken from there.
function(springfold_precompile target)
  if(NOT SPRINGFOLD_PRECOMPILED_HEADERS)
    return()
  endif()
  set(kind common)
  if("TESTS" IN_LIST ARGN)
    set(kind test)
  endif()
  set(parsed springfold_precompiled_${kind})
  if(NOT TARGET ${parsed})
    file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp" CONTENT "namespace springfold {}\n")
    add_library(${parsed} OBJECT EXCLUDE_FROM_ALL "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp")
    target_compile_features(${parsed} PRIVATE cxx_std_20)
    target_link_libraries(${parsed} PRIVATE springfold_options Eigen3::Eigen)
    if(kind STREQUAL "test")
      target_link_libraries(${parsed} PRIVATE GTest::gmock)
      target_compile_options(${parsed} PRIVATE ${springfold_test_options} -fPIE)  # as for programs
      set_target_properties(${parsed} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    endif()
    target_precompile_headers(${parsed} PRIVATE ${springfold_${kind}_headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${parsed})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
  endif()
endfunction()
