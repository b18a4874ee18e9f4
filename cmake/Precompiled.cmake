# Headers of others that most files read, parsed once for each kind of flags: half of the time of a build is reading
# them. Only others' headers stand here, so that ours still warn, and public ones are compiled alone as well
# (tests/CMakeLists.txt). By GCC only: Clang wants the same macros defined in all targets.
option(SPRINGFOLD_PRECOMPILED_HEADERS "Parse the headers of Eigen, GoogleTest and the standard library once" ON)
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(SPRINGFOLD_PRECOMPILED_HEADERS OFF)
endif()

# Tests, readers and writers do little arithmetic themselves: the optimiser would cost minutes. (Without any of it the
# linker would take their slow copies of Eigen's templates for all.)
set(springfold_plain_options $<$<CONFIG:Release>:-O1>)

# With Clang's sanitizers not even that, which takes a third of the time. There the layers of arithmetic are linked before
# all else, whole, so that their copies are the ones that are taken: springfold_link_first(<target> <layers>...)
set(springfold_layers_first OFF)
if(SPRINGFOLD_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  set(springfold_plain_options -O0)
  set(springfold_layers_first ON)
endif()
function(springfold_link_first target)
  if(NOT springfold_layers_first)
    return()
  endif()
  set(archives "")
  foreach(layer IN LISTS ARGN)
    list(APPEND archives $<TARGET_FILE:springfold_${layer}>)
  endforeach()
  target_link_options(${target} PRIVATE "LINKER:--whole-archive" ${archives} "LINKER:--no-whole-archive")
endfunction()
set(springfold_arithmetic_headers
    <Eigen/Core> <Eigen/LU>
    <algorithm> <array> <cassert> <cmath> <functional> <limits> <map> <memory> <numbers> <optional> <set> <span> <string>
    <string_view> <utility> <variant> <vector>)
set(springfold_text_headers ${springfold_arithmetic_headers} <filesystem> <sstream>)
set(springfold_test_headers ${springfold_text_headers} <gmock/gmock.h> <gtest/gtest.h> <random>)

# Files of one kind, compiled as one: what they all instantiate (Eigen above all) is compiled once. Names in unnamed
# namespaces of a layer or a folder of tests must differ for this. More files at once take less time in all and more
# memory for each: about 1 GB for 10, 2 GB for 30.
set(SPRINGFOLD_FILES_AT_ONCE 10 CACHE STRING "How many files SPRINGFOLD_UNITY compiles as one")
if(SPRINGFOLD_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE ${SPRINGFOLD_FILES_AT_ONCE})
endif()

# springfold_precompile(<target> arithmetic|text|test): the headers are parsed for a target of their own, and taken
# from there. All but `arithmetic` are compiled plainly.
function(springfold_precompile target kind)
  if(NOT kind STREQUAL "arithmetic")
    target_compile_options(${target} PRIVATE ${springfold_plain_options})
  endif()
  if(NOT SPRINGFOLD_PRECOMPILED_HEADERS)
    return()
  endif()
  set(parsed springfold_precompiled_${kind})
  if(NOT TARGET ${parsed})
    file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp" CONTENT "namespace springfold {}\n")
    add_library(${parsed} OBJECT EXCLUDE_FROM_ALL "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp")
    target_compile_features(${parsed} PRIVATE cxx_std_20)
    target_link_libraries(${parsed} PRIVATE springfold_options Eigen3::Eigen)
    if(NOT kind STREQUAL "arithmetic")
      target_compile_options(${parsed} PRIVATE ${springfold_plain_options})
    endif()
    if(kind STREQUAL "test")
      target_link_libraries(${parsed} PRIVATE GTest::gmock)
      target_compile_options(${parsed} PRIVATE -fPIE)  # as for programs
      set_target_properties(${parsed} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    endif()
    target_precompile_headers(${parsed} PRIVATE ${springfold_${kind}_headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${parsed})
  target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
endfunction()
