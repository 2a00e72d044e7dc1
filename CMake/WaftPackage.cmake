# What an installation has besides the modules, and packages of all of it: cmake --build build --target package.

# ParaView's programs load what is in the folder `plugins` beside them, and look nowhere else by themselves: an
# installation into ParaView's own prefix is found so.
file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/beside-paraview")
file(CREATE_LINK "../../${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/Waft" "${CMAKE_BINARY_DIR}/beside-paraview/Waft" SYMBOLIC)
install(FILES "${CMAKE_BINARY_DIR}/beside-paraview/Waft" DESTINATION "${CMAKE_INSTALL_BINDIR}/plugins")

# The manual page and the completions of the command.
set(described man/man1/waft.1 bash-completion/completions/waft zsh/vendor-completions/_waft)
list(TRANSFORM described PREPEND "${CMAKE_BINARY_DIR}/share/" OUTPUT_VARIABLE files)
set(modules "${CMAKE_BINARY_DIR}/${WAFT_PYTHON_DIR}")
add_custom_command(OUTPUT ${files}
  COMMAND ${CMAKE_COMMAND} -E env "PYTHONPATH=${modules}" PYTHONDONTWRITEBYTECODE=1
    "$<TARGET_FILE:Python3::Interpreter>" "${PROJECT_SOURCE_DIR}/CMake/describe_command.py" ${files}
  DEPENDS WaftOptions WaftScenes WaftChain WaftCommands "${modules}/waft/commands.json" "${modules}/waft/options.json" "${modules}/waft/run/_options.py"
    "${PROJECT_SOURCE_DIR}/CMake/describe_command.py" "${modules}/waft/cli/command.py"
    "${modules}/waft/run/_chain.py" "${modules}/waft/chain.json" "${modules}/waft/run/request.py" "${modules}/waft/render/_styles.py" "${modules}/waft/scene.schema.json"
  VERBATIM)
add_custom_target(WaftDescription ALL DEPENDS ${files})
foreach(file IN LISTS described)
  get_filename_component(folder "${file}" DIRECTORY)
  install(FILES "${CMAKE_BINARY_DIR}/share/${file}" DESTINATION "share/${folder}")
endforeach()

# Pages, with the pictures and the schema that they lead to.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE DESTINATION share/doc/waft)
install(FILES LICENSE DESTINATION share/doc/waft RENAME copyright)
install(DIRECTORY Documentation DESTINATION share/doc/waft
  FILES_MATCHING REGEX "\\.(md|png|webp|svg|json|pvsm)$"
  PATTERN scripts EXCLUDE)

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME waft)
set(CPACK_PACKAGE_VENDOR "the Waft developers")
set(CPACK_PACKAGE_CONTACT "${CPACK_PACKAGE_VENDOR}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "motion of light things in air for ParaView and artists")
set(CPACK_PACKAGE_DESCRIPTION
  "Waft makes leaves, feathers, petals, paper and bubbles fly where you say, and still move like things carried by
one body of air. It is a plugin of ParaView with the command waft, a package for Python and an add-on for Blender.
The sources are under the BSD 3-clause licence; with the parts of CGAL in it this package is under GPL-3.0-or-later.")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# Libraries that are linked are found in the binaries. These are used besides: ParaView's programs, its package for
# Python and what that needs, Qt's painter of SVG (ParaView's toolbars are blank without it), a display for pictures
# where there is none, three.js for pages, Pillow for pictures that loop.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
math(EXPR next "${ParaView_VERSION_MINOR} + 1")
math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PACKAGE_DEPENDS "paraview (>= ${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR})"
  "paraview (<< ${ParaView_VERSION_MAJOR}.${next})" python3-paraview
  "python3 (>= 3.${Python3_VERSION_MINOR})" "python3 (<< 3.${next_python})" python3-numpy python3-pil
  libqt5svg5 xvfb xauth libjs-three)
if(WAFT_QT_VERSION GREATER 5)
  list(TRANSFORM CPACK_DEBIAN_PACKAGE_DEPENDS REPLACE "^libqt5svg5$" "qt${WAFT_QT_VERSION}-svg-plugins")
endif()
list(JOIN CPACK_DEBIAN_PACKAGE_DEPENDS ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "blender, ffmpeg, python3-sklearn, python3-matplotlib, mpi-default-bin")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/CMake/debian/postinst" "${PROJECT_SOURCE_DIR}/CMake/debian/prerm")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
