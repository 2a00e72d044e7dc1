# ParaView, or VTK, as the packages of this system have it: what to do before and after find_package. For Waft's own build
# and for projects that use an installation of it.

# waft_name_python_modules(<package>): a way round packages (Debian 13) that name modules of Python by the interpreter,
# vtkX.cpython-313-x86_64-linux-gnu.so, while their exports say vtkX.so: such an export ends CMake, since its files are
# not there. Where all targets of an export exist it returns at once: they are made here, without files, since nothing is
# linked to these modules.
macro(waft_name_python_modules package)
  # No version is 9999: this tells what would be found, and loads nothing.
  set(waft_given "${${package}_DIR}")
  find_package(${package} 9999 CONFIG QUIET)
  if(${package}_CONSIDERED_CONFIGS)
    list(GET ${package}_CONSIDERED_CONFIGS 0 waft_config)
    get_filename_component(waft_config "${waft_config}" DIRECTORY)
    file(GLOB waft_exports "${waft_config}/*Python*-targets.cmake" "${waft_config}/vtk/*Python*-targets.cmake")
    foreach(export IN LISTS waft_exports)
      waft_name_modules_of("${export}")
    endforeach()
  endif()
  unset(${package}_DIR CACHE)
  if(waft_given)
    set(${package}_DIR "${waft_given}" CACHE PATH "The directory containing a CMake configuration file for ${package}.")
  endif()
endmacro()

function(waft_name_modules_of export)
  string(REGEX REPLACE "\\.cmake$" "-*.cmake" located "${export}")
  file(GLOB located "${located}")
  if(NOT located)
    return()
  endif()
  list(GET located 0 located)
  get_filename_component(prefix "${export}" DIRECTORY)
  while(NOT EXISTS "${prefix}/lib" AND NOT prefix STREQUAL "/")
    get_filename_component(prefix "${prefix}" DIRECTORY)
  endwhile()
  file(STRINGS "${located}" lines REGEX "IMPORTED_LOCATION_")
  list(TRANSFORM lines REPLACE ".*\\\${_IMPORT_PREFIX}(/[^\"]*)\".*" "\\1")
  if(NOT lines)
    return()
  endif()
  list(GET lines 0 first)
  if(EXISTS "${prefix}${first}")
    return()
  endif()
  file(STRINGS "${export}" targets REGEX "^foreach\\(_(cmake_)?expected_?[tT]arget ")
  string(REGEX REPLACE "^foreach\\([^ ]* (IN ITEMS )?|\\)$" "" targets "${targets}")
  separate_arguments(targets)
  foreach(target IN LISTS targets)
    if(NOT TARGET ${target})
      add_library(${target} MODULE IMPORTED GLOBAL)
    endif()
  endforeach()
endfunction()

# Libraries of VTK's own readers are in the interface of targets that Waft reaches, though nothing of Waft is linked to
# them; the development packages of ParaView do not ask for theirs.
macro(waft_stand_in_for_unused)
  foreach(unused IN ITEMS hdf5::hdf5 hdf5::hdf5_hl NetCDF::NetCDF)
    if(NOT TARGET ${unused})
      add_library(${unused} INTERFACE IMPORTED)
    endif()
  endforeach()
endmacro()
