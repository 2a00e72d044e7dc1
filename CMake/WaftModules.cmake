# The VTK modules of sources and stages with their Python wrappings, against the distribution's ParaView or, as
# WAFT_PLAIN_VTK has it, its VTK; with ParaView the plugin besides.
set(WAFT_PYTHON_DIR "lib/python3/dist-packages" CACHE STRING "Where Python modules go, below the prefix")

set(waft_folders Sources Filters/Motion)
include(WaftFindParaView)
if(WAFT_PLAIN_VTK)
  waft_name_python_modules(VTK)
  # What vtk.module files and the bridge name, and what tests use besides: all of VTK would ask for Qt, databases and more.
  set(WAFT_RUN_VTK CommonCore CommonDataModel CommonExecutionModel CommonTransforms FiltersCore FiltersGeneral FiltersGeometry FiltersSources
    ImagingCore IOCore IOGeometry IOImage IOXML IOXMLParser ParallelCore RenderingCore RenderingFreeType)
  find_package(VTK 9.1 REQUIRED COMPONENTS ${WAFT_RUN_VTK} Python WrappingPythonCore OPTIONAL_COMPONENTS ParallelMPI)
else()
  waft_name_python_modules(ParaView)
  find_package(ParaView REQUIRED COMPONENTS RemotingCore RemotingViews)
  if(ParaView_VERSION VERSION_LESS 5.11)
    message(FATAL_ERROR "ParaView ${ParaView_VERSION} is too old: 5.11 or newer is needed")
  endif()
  list(APPEND waft_folders Plugin/Proxies)
endif()
waft_stand_in_for_unused()
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# Wrappers and plugin are installed side by side with lib/: found from either place, and from lib itself.
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../..;$ORIGIN/../../..")

include(WaftExports)
add_subdirectory(Filters/Bridge)
add_subdirectory(Filters/Programs)

list(TRANSFORM waft_folders REPLACE "(.+)" "${CMAKE_CURRENT_SOURCE_DIR}/\\1/vtk.module" OUTPUT_VARIABLE files)
vtk_module_scan(
  MODULE_FILES ${files}
  PROVIDES_MODULES waft_modules
  REQUIRES_MODULES waft_required_modules
  WANT_BY_DEFAULT ON
  HIDE_MODULES_FROM_CACHE ON)
vtk_module_build(
  MODULES ${waft_modules}
  PACKAGE Waft
  INSTALL_EXPORT Waft
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/waft"
  TEST_DIRECTORY_NAME NONE
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/waft")

if(NOT WAFT_PLAIN_VTK)
  include(WaftParaView)
endif()

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

add_subdirectory(Plugin/Command)
add_subdirectory(Plugin/Python)
if(NOT WAFT_PLAIN_VTK)
  add_subdirectory(Plugin/Blender)
  include(WaftPackage)
endif()
