# For Waft's own build and for projects that use an installation of it.

# waft_add_openvdb_module(): find_package(OpenVDB) finds its module, which is not where CMake looks for such.
macro(waft_add_openvdb_module)
  find_path(WAFT_OPENVDB_MODULES FindOpenVDB.cmake
    HINTS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB /usr/lib/cmake/OpenVDB
    PATH_SUFFIXES lib/cmake/OpenVDB lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB
    DOC "The folder cmake/OpenVDB that libopenvdb-dev installs")
  mark_as_advanced(WAFT_OPENVDB_MODULES)
  list(APPEND CMAKE_MODULE_PATH "${WAFT_OPENVDB_MODULES}")
endmacro()
