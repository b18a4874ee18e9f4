# Headers, static libraries, program, plot templates, and the package files for find_package.
include(CMakePackageConfigHelpers)

set(springfold_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/springfold")

install(TARGETS ${springfold_libraries} springfold_umbrella EXPORT springfoldTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
if(TARGET springfold_program)
  install(TARGETS springfold_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
if(TARGET springfold_mpi)
  install(TARGETS springfold_mpi LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/springfold")
endif()
install(DIRECTORY include/ "${PROJECT_BINARY_DIR}/include/"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY plots/ DESTINATION "${CMAKE_INSTALL_DATADIR}/springfold/plots")

install(EXPORT springfoldTargets NAMESPACE springfold:: DESTINATION "${springfold_package_dir}")
set(SPRINGFOLD_USES_URDF OFF)
if(TARGET springfold::urdfdom)
  set(SPRINGFOLD_USES_URDF ON)
endif()
configure_package_config_file(cmake/springfoldConfig.cmake.in
  "${PROJECT_BINARY_DIR}/springfoldConfig.cmake" INSTALL_DESTINATION "${springfold_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/springfoldConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
        "${PROJECT_BINARY_DIR}/springfoldConfig.cmake"
        "${PROJECT_BINARY_DIR}/springfoldConfigVersion.cmake"
        cmake/springfoldDependencies.cmake
        DESTINATION "${springfold_package_dir}")
