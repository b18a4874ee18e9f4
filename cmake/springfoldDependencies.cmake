# Third-party libraries that our static libraries need when a program is linked. Read by our own
# build and by the installed springfoldConfig.cmake, so that both find the same things.
include(CMakeFindDependencyMacro)

macro(springfold_find)
  if("${CMAKE_FIND_PACKAGE_NAME}" STREQUAL "springfold")
    find_dependency(${ARGN})
  else()
    find_package(${ARGN} REQUIRED)
  endif()
endmacro()

# Archives are preferred where there are any: to find and bind fifteen shared libraries takes a program as long as to trace
# a curve. -DSPRINGFOLD_ARCHIVES=OFF links shared libraries only.
if(NOT DEFINED SPRINGFOLD_ARCHIVES)
  set(SPRINGFOLD_ARCHIVES ON)
endif()
if(SPRINGFOLD_ARCHIVES)
  find_library(SPRINGFOLD_BOOST_ARCHIVE libboost_iostreams.a)
  mark_as_advanced(SPRINGFOLD_BOOST_ARCHIVE)
  if(SPRINGFOLD_BOOST_ARCHIVE AND NOT DEFINED Boost_USE_STATIC_LIBS)
    set(Boost_USE_STATIC_LIBS ON)
  endif()
endif()

springfold_find(Threads)
springfold_find(Eigen3 3.4 CONFIG)
springfold_find(SUNDIALS 6.4 COMPONENTS kinsol cvode)
springfold_find(NLopt 2.7 CONFIG)
springfold_find(Boost 1.74 CONFIG COMPONENTS filesystem iostreams system)
springfold_find(fmt 9 CONFIG)
springfold_find(muparser CONFIG)
springfold_find(tomlplusplus CONFIG)

foreach(library kinsol cvode)
  set(springfold_${library} SUNDIALS::${library})
  if(SPRINGFOLD_ARCHIVES AND TARGET SUNDIALS::${library}_static)
    set(springfold_${library} SUNDIALS::${library}_static)
  endif()
endforeach()

# The C interface of LAPACK has no package file of its own. Archives of it need those of the Fortran compiler.
if(NOT TARGET springfold::lapacke)
  find_path(SPRINGFOLD_LAPACKE_INCLUDE_DIR lapacke.h REQUIRED)
  mark_as_advanced(SPRINGFOLD_LAPACKE_INCLUDE_DIR)
  if(SPRINGFOLD_ARCHIVES)
    set(archives)
    foreach(library lapacke lapack tmglib blas gfortran quadmath)
      string(TOUPPER "SPRINGFOLD_${library}_ARCHIVE" found)
      execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -print-file-name=lib${library}.a
                      OUTPUT_VARIABLE of_compiler OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
      get_filename_component(folder_of_compiler "${of_compiler}" DIRECTORY)
      find_library(${found} lib${library}.a HINTS "${folder_of_compiler}")
      mark_as_advanced(${found})
      if(${found})
        list(APPEND archives "${${found}}")
      endif()
    endforeach()
    include(CheckCXXSourceCompiles)
    set(CMAKE_REQUIRED_LIBRARIES ${archives})
    set(CMAKE_REQUIRED_INCLUDES "${SPRINGFOLD_LAPACKE_INCLUDE_DIR}")
    check_cxx_source_compiles("#include <lapacke.h>
      int main() {
        double a = 1, w = 0;
        return LAPACKE_dsyev(LAPACK_COL_MAJOR, 'N', 'U', 1, &a, 1, &w);
      }" SPRINGFOLD_LAPACKE_LINKS_AS_ARCHIVE)
    unset(CMAKE_REQUIRED_LIBRARIES)
    unset(CMAKE_REQUIRED_INCLUDES)
    if(SPRINGFOLD_LAPACKE_LINKS_AS_ARCHIVE)
      list(POP_FRONT archives first)
      add_library(springfold::lapacke UNKNOWN IMPORTED)
      set_target_properties(springfold::lapacke PROPERTIES
        IMPORTED_LOCATION "${first}"
        INTERFACE_INCLUDE_DIRECTORIES "${SPRINGFOLD_LAPACKE_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "${archives}")
    endif()
  endif()
endif()
if(NOT TARGET springfold::lapacke)
  springfold_find(LAPACK)
  find_library(SPRINGFOLD_LAPACKE_LIBRARY lapacke REQUIRED)
  mark_as_advanced(SPRINGFOLD_LAPACKE_LIBRARY)
  add_library(springfold::lapacke UNKNOWN IMPORTED)
  set_target_properties(springfold::lapacke PROPERTIES
    IMPORTED_LOCATION "${SPRINGFOLD_LAPACKE_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SPRINGFOLD_LAPACKE_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES LAPACK::LAPACK)
endif()

# Nettle has none either.
if(NOT TARGET springfold::nettle)
  find_path(SPRINGFOLD_NETTLE_INCLUDE_DIR nettle/sha2.h REQUIRED)
  set(names nettle)
  if(SPRINGFOLD_ARCHIVES)
    set(names libnettle.a nettle)
  endif()
  find_library(SPRINGFOLD_NETTLE_LIBRARY NAMES ${names} REQUIRED)
  mark_as_advanced(SPRINGFOLD_NETTLE_INCLUDE_DIR SPRINGFOLD_NETTLE_LIBRARY)
  add_library(springfold::nettle UNKNOWN IMPORTED)
  set_target_properties(springfold::nettle PROPERTIES
    IMPORTED_LOCATION "${SPRINGFOLD_NETTLE_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SPRINGFOLD_NETTLE_INCLUDE_DIR}")
endif()

# Descriptions of robots: optional. Its own package file asks for more than the model's library.
if(SPRINGFOLD_URDF AND NOT TARGET springfold::urdfdom)
  find_path(SPRINGFOLD_URDFDOM_INCLUDE_DIR urdf_parser/urdf_parser.h)
  find_library(SPRINGFOLD_URDFDOM_LIBRARY urdfdom_model)
  find_library(SPRINGFOLD_CONSOLE_BRIDGE_LIBRARY console_bridge)
  mark_as_advanced(SPRINGFOLD_URDFDOM_INCLUDE_DIR SPRINGFOLD_URDFDOM_LIBRARY
                   SPRINGFOLD_CONSOLE_BRIDGE_LIBRARY)
  if(SPRINGFOLD_URDFDOM_INCLUDE_DIR AND SPRINGFOLD_URDFDOM_LIBRARY AND SPRINGFOLD_CONSOLE_BRIDGE_LIBRARY)
    add_library(springfold::urdfdom UNKNOWN IMPORTED)
    set_target_properties(springfold::urdfdom PROPERTIES
      IMPORTED_LOCATION "${SPRINGFOLD_URDFDOM_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${SPRINGFOLD_URDFDOM_INCLUDE_DIR}"
      INTERFACE_LINK_LIBRARIES "${SPRINGFOLD_CONSOLE_BRIDGE_LIBRARY}")
  endif()
endif()
