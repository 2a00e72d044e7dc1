# The plugin of ParaView, of the modules that are there.

# ParaView's own window. What these libraries say that they link to asks for the development packages of all that
# ParaView was built from; the plugin itself needs none of it. ParaView 5.11 has Qt 5 and does not tell so.
set(WAFT_QT_VERSION 5)
if(PARAVIEW_QT_MAJOR_VERSION)
  set(WAFT_QT_VERSION ${PARAVIEW_QT_MAJOR_VERSION})
endif()
find_package(Qt${WAFT_QT_VERSION} QUIET COMPONENTS Widgets)
set(has_window ${Qt${WAFT_QT_VERSION}_FOUND})
foreach(library IN ITEMS pqCore pqComponents)
  if(TARGET ParaView::${library})
    get_target_property(configurations ParaView::${library} IMPORTED_CONFIGURATIONS)
    foreach(configuration IN LISTS configurations)
      set_property(TARGET ParaView::${library} PROPERTY IMPORTED_LINK_DEPENDENT_LIBRARIES_${configuration})
    endforeach()
    set_property(TARGET ParaView::${library} PROPERTY INTERFACE_LINK_LIBRARIES Qt${WAFT_QT_VERSION}::Widgets)
  else()
    set(has_window OFF)
  endif()
endforeach()
option(WAFT_WINDOW "Build what needs Qt: Waft's tool bar in ParaView's window" ${has_window})

# Pages of help from the proxies' XML: ParaView makes none with Qt 6 before 6.0.
set(WAFT_HELP_PAGES ON)
if(WAFT_QT_VERSION GREATER 5 AND ParaView_VERSION VERSION_LESS 6.0)
  set(WAFT_HELP_PAGES OFF)
endif()

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
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  AUTOLOAD ${waft_plugins})
