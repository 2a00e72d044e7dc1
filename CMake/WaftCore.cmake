# What Filters/Core and Testing/Core are made of: their libraries, and one function for each kind of thing.

# In the order of their dependencies.
set(WAFT_CORE_PARTS Base Files Store Obstacles Constraints Scene Shapes Grid Volumes Trajectory Database Planning Air Vortex
  Particles Spacetime Rotation Chain Export)
# Where their headers are installed.
set(WAFT_CORE_INCLUDES "${CMAKE_INSTALL_INCLUDEDIR}/waft/Core")

# waft_build_alone(<source>...): of this folder, sources whose own names (ports, kernels, scenes of a test) are others'
# too, and that CMAKE_UNITY_BUILD must not put into one unit with others.
function(waft_build_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# waft_core_library(<Name> SOURCES ... [DEPENDS <Core libraries>...] [PRIVATE <third-party targets>...]
#   [HEADERS <third-party targets>...] [LINKS <libraries>...])
# A static, position-independent library WaftCore<Name>, installed as the target Waft::Core<Name>. Its include root is
# Filters/Core, and no VTK folder is on its include path. Third-party libraries stay private, Eigen excepted (types of
# Base). Programs that use an installation link to those of PRIVATE, which CMake/WaftConfig.cmake.in finds, and to LINKS;
# of those of HEADERS they need nothing.
function(waft_core_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;PRIVATE;HEADERS;LINKS" ${ARGN})
  set(target WaftCore${name})
  add_library(${target} STATIC ${arg_SOURCES})
  set_target_properties(${target} PROPERTIES EXPORT_NAME Core${name})
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/Filters/Core>"
    "$<INSTALL_INTERFACE:${WAFT_CORE_INCLUDES}>")
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wno-unknown-pragmas -Werror=switch
    -Werror=switch-enum $<$<BOOL:${WAFT_WARNINGS_AS_ERRORS}>:-Werror>)
  foreach(dependency IN LISTS arg_DEPENDS)
    target_link_libraries(${target} PUBLIC WaftCore${dependency})
  endforeach()
  list(TRANSFORM arg_HEADERS REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  list(TRANSFORM arg_LINKS REPLACE "(.+)" "$<INSTALL_INTERFACE:\\1>")
  target_link_libraries(${target} PUBLIC Eigen3::Eigen PRIVATE ${arg_PRIVATE} ${arg_HEADERS} ${arg_LINKS})
endfunction()

# The suites of GoogleTest that take longer than some seconds, of any program; all others are fast.
set(WAFT_SLOW_SUITES AirAssimilation AssimilationContacts AssimilationEdits AssimilationRows AssimilationStart Checkpoint
  *ChainFaces ClusterRuns Clusters DatabaseBuild Edit FreeFlight Landing Landings Mazes MotionDatabaseSource MovingObstacles PlanCache
  Planner PlannerBadInput PropertyValues RunChain RunSpacetime SceneSchema SpacetimeMotion StylisticPlannerFilter Surfaces WarmStart Windows)

# waft_collect_tests(<folder>): the target WaftTests, which builds all programs of a folder and of those below it.
function(waft_collect_tests folder)
  set(targets "")
  set(folders "${CMAKE_CURRENT_SOURCE_DIR}/${folder}")
  while(folders)
    list(POP_FRONT folders next)
    get_directory_property(own DIRECTORY "${next}" BUILDSYSTEM_TARGETS)
    get_directory_property(below DIRECTORY "${next}" SUBDIRECTORIES)
    list(APPEND targets ${own})
    list(APPEND folders ${below})
  endwhile()
  add_custom_target(WaftTests DEPENDS ${targets})
endfunction()

# waft_discover_tests(<program> <prefix>): each TEST of a program is an entry of ctest, labelled fast or slow; those of suites whose
# names end with ByNight are left to the night.
function(waft_discover_tests target prefix)
  list(TRANSFORM WAFT_SLOW_SUITES APPEND ".*" OUTPUT_VARIABLE slow)
  list(JOIN slow ":" slow)
  gtest_discover_tests(${target} TEST_PREFIX ${prefix} DISCOVERY_TIMEOUT 600 TEST_FILTER "-${slow}:*ByNight.*" PROPERTIES LABELS fast)
  gtest_discover_tests(${target} TEST_PREFIX ${prefix} DISCOVERY_TIMEOUT 600 TEST_FILTER "${slow}" PROPERTIES LABELS slow)
  gtest_discover_tests(${target} TEST_PREFIX ${prefix} DISCOVERY_TIMEOUT 600 TEST_FILTER "*ByNight.*" PROPERTIES LABELS nightly)
endfunction()

# waft_label_tests(<label>): of all tests that add_test made in this folder so far.
macro(waft_label_tests label)
  get_directory_property(tests TESTS)
  set_tests_properties(${tests} PROPERTIES LABELS ${label})
endmacro()

# waft_core_test(<Library> <source>... [DEPENDS <more Core libraries>] [PRIVATE <third-party targets>])
# One GoogleTest program WaftTest<Library>; each TEST becomes a ctest entry named Core.<Library>.*.
function(waft_core_test name)
  cmake_parse_arguments(arg "" "" "DEPENDS;PRIVATE" ${ARGN})
  set(target WaftTest${name})
  add_executable(${target} ${arg_UNPARSED_ARGUMENTS})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/Testing/Core")
  target_link_libraries(${target} PRIVATE WaftCore${name} GTest::gtest_main ${arg_PRIVATE})
  foreach(dependency IN LISTS arg_DEPENDS)
    target_link_libraries(${target} PRIVATE WaftCore${dependency})
  endforeach()
  target_compile_definitions(${target} PRIVATE "WAFT_SOURCE_DIR=\"${PROJECT_SOURCE_DIR}\"")
  waft_discover_tests(${target} "Core.${name}.")
endfunction()

# waft_core_benchmark(<Name> <source>... DEPENDS <Core libraries>): a program WaftBenchmark<Name>
# that prints figures; it is built with the tests and never run as one.
function(waft_core_benchmark name)
  cmake_parse_arguments(arg "" "" "DEPENDS;PRIVATE" ${ARGN})
  set(target WaftBenchmark${name})
  add_executable(${target} ${arg_UNPARSED_ARGUMENTS})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/Testing/Core")
  target_link_libraries(${target} PRIVATE ${arg_PRIVATE})
  foreach(dependency IN LISTS arg_DEPENDS)
    target_link_libraries(${target} PRIVATE WaftCore${dependency})
  endforeach()
  target_compile_definitions(${target} PRIVATE "WAFT_SOURCE_DIR=\"${PROJECT_SOURCE_DIR}\"")
endfunction()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)

# waft_find_openvdb(): the target OpenVDB::openvdb in the folder that calls it; it brings targets that must not be seen by
# other folders' packages.
include(WaftFindOpenVDB)
macro(waft_find_openvdb)
  waft_add_openvdb_module()
  find_package(OpenVDB REQUIRED COMPONENTS openvdb)
endmacro()
