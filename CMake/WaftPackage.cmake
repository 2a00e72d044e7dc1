# find_package(Waft) for other projects: vtk_module_build installs the targets, these are the two files
# that CMake looks for.
include(CMakePackageConfigHelpers)
set(package "${CMAKE_BINARY_DIR}/cmake")
configure_file("${PROJECT_SOURCE_DIR}/CMake/WaftConfig.cmake.in" "${package}/WaftConfig.cmake" @ONLY)
write_basic_package_version_file("${package}/WaftConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${package}/WaftConfig.cmake" "${package}/WaftConfigVersion.cmake"
  DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/waft")
