# The plugin of ParaView, of the modules that are there.
paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/Plugin/paraview.plugin"
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
