# find_package(Waft) for other projects: the files that CMake looks for, and the targets of Core. Those of the modules are
# installed by vtk_module_build.
include(CMakePackageConfigHelpers)

set(package "${CMAKE_INSTALL_LIBDIR}/cmake/waft")
install(EXPORT WaftCore NAMESPACE Waft:: FILE Waft-core-targets.cmake DESTINATION "${package}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/CMake/WaftConfig.cmake.in" "${CMAKE_BINARY_DIR}/cmake/WaftConfig.cmake"
  INSTALL_DESTINATION "${package}" NO_CHECK_REQUIRED_COMPONENTS_MACRO NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${CMAKE_BINARY_DIR}/cmake/WaftConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/cmake/WaftConfig.cmake" "${CMAKE_BINARY_DIR}/cmake/WaftConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/CMake/WaftFindOpenVDB.cmake" "${PROJECT_SOURCE_DIR}/CMake/WaftFindParaView.cmake"
  DESTINATION "${package}")
