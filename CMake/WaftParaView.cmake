# The VTK modules, the ParaView plugin and the Python package, against the distribution's ParaView.
set(WAFT_PYTHON_DIR "lib/python3/dist-packages" CACHE STRING "Where Python modules go, below the prefix")

find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingCore RemotingViews)

# ParaView's own window. What these libraries say that they link to asks for the development packages of all that
# ParaView was built from; the plugin itself needs none of it.
find_package(Qt5 QUIET COMPONENTS Widgets)
set(has_window ${Qt5_FOUND})
foreach(library IN ITEMS pqCore pqComponents)
  if(TARGET ParaView::${library})
    get_target_property(configurations ParaView::${library} IMPORTED_CONFIGURATIONS)
    foreach(configuration IN LISTS configurations)
      set_property(TARGET ParaView::${library} PROPERTY IMPORTED_LINK_DEPENDENT_LIBRARIES_${configuration})
    endforeach()
    set_property(TARGET ParaView::${library} PROPERTY INTERFACE_LINK_LIBRARIES Qt5::Widgets)
  else()
    set(has_window OFF)
  endif()
endforeach()
option(WAFT_WINDOW "Build what needs Qt: Waft's tool bar in ParaView's window" ${has_window})
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# Wrappers and plugin are installed side by side with lib/: found from either place, and from lib itself.
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../..;$ORIGIN/../../..")

add_subdirectory(Filters/Bridge)

vtk_module_scan(
  MODULE_FILES
    "${CMAKE_CURRENT_SOURCE_DIR}/Sources/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Motion/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/Proxies/vtk.module"
  PROVIDES_MODULES waft_modules
  REQUIRES_MODULES waft_required_modules
  WANT_BY_DEFAULT ON
  HIDE_MODULES_FROM_CACHE ON)
vtk_module_build(
  MODULES ${waft_modules}
  PACKAGE Waft
  INSTALL_EXPORT Waft
  INSTALL_HEADERS ON
  TEST_DIRECTORY_NAME NONE
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/waft")

set(plugin_files "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/paraview.plugin")
if(WAFT_WINDOW)
  list(APPEND plugin_files "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/Qt/paraview.plugin")
endif()
paraview_plugin_scan(
  PLUGIN_FILES ${plugin_files}
  PROVIDES_PLUGINS waft_plugins
  REQUIRES_MODULES waft_plugin_modules
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
paraview_plugin_build(
  PLUGINS ${waft_plugins}
  PLUGINS_FILE_NAME "waft.plugins.xml"
  LIBRARY_SUBDIRECTORY "paraview-${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}/plugins"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  AUTOLOAD ${waft_plugins})

# Proxies are made by their names in XML; ParaView's own wrapping serves them in Python.
set(waft_python_modules ${waft_modules})
list(REMOVE_ITEM waft_python_modules Waft::WaftProxies)
vtk_module_wrap_python(
  MODULES ${waft_python_modules}
  TARGET Waft::Python
  PYTHON_PACKAGE "waft"
  MODULE_DESTINATION "${WAFT_PYTHON_DIR}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/waft"
  INSTALL_HEADERS OFF
  BUILD_STATIC OFF
  WRAPPED_MODULES waft_wrapped_modules)

add_subdirectory(Plugin/Python)
add_subdirectory(Plugin/Blender)
include(WaftPackage)
