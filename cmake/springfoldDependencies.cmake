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

springfold_find(Threads)
springfold_find(Eigen3 3.4 CONFIG)
springfold_find(LAPACK)
springfold_find(SUNDIALS 6.4 COMPONENTS kinsol cvode)
springfold_find(NLopt 2.7 CONFIG)
springfold_find(Boost 1.74 CONFIG COMPONENTS filesystem iostreams system)
springfold_find(fmt 9 CONFIG)
springfold_find(muparser CONFIG)
springfold_find(tomlplusplus CONFIG)

# The C interface of LAPACK has no package file of its own.
if(NOT TARGET springfold::lapacke)
  find_path(SPRINGFOLD_LAPACKE_INCLUDE_DIR lapacke.h REQUIRED)
  find_library(SPRINGFOLD_LAPACKE_LIBRARY lapacke REQUIRED)
  mark_as_advanced(SPRINGFOLD_LAPACKE_INCLUDE_DIR SPRINGFOLD_LAPACKE_LIBRARY)
  add_library(springfold::lapacke UNKNOWN IMPORTED)
  set_target_properties(springfold::lapacke PROPERTIES
    IMPORTED_LOCATION "${SPRINGFOLD_LAPACKE_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SPRINGFOLD_LAPACKE_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES LAPACK::LAPACK)
endif()

# Nettle has none either.
if(NOT TARGET springfold::nettle)
  find_path(SPRINGFOLD_NETTLE_INCLUDE_DIR nettle/sha2.h REQUIRED)
  find_library(SPRINGFOLD_NETTLE_LIBRARY nettle REQUIRED)
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
