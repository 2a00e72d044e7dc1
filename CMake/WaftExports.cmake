# waft_export_classes(<module> <class>...): its library shows these classes and nothing else. What it has of Core, and of
# the templates of other libraries, is bound to its own copy: else the loader takes the first of that name, which may be
# one that ParaView was built with, without optimisation.
function(waft_export_classes module)
  if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
    return()
  endif()
  set(names "")
  foreach(class IN LISTS ARGN)
    string(APPEND names "    ${class}::*;\n    \"vtable for ${class}\";\n    \"typeinfo for ${class}\";\n"
      "    \"typeinfo name for ${class}\";\n")
  endforeach()
  set(script "${CMAKE_CURRENT_BINARY_DIR}/exports.map")
  file(CONFIGURE OUTPUT "${script}" CONTENT "{\n  global:\n  extern \"C++\" {\n${names}  };\n  local: *;\n};\n")
  vtk_module_link_options(${module} PRIVATE "LINKER:--version-script=${script}")
  string(REGEX REPLACE "^.*::" "" library "${module}")
  set_property(TARGET "${library}" APPEND PROPERTY LINK_DEPENDS "${script}")
endfunction()
