# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# The Debian package: scripts/make-deb, or target deb. It holds what cmake --install
# brings but for the solvers as a library.
set(CONETACT_MAINTAINER "Conetact authors <conetact@example.org>" CACHE STRING
  "Maintainer of the Debian package: Name <address>")

# what only Debian wants: its change log, and Python packages where its Python looks
set(DEBIAN ${CMAKE_BINARY_DIR}/debian)
string(TIMESTAMP CONETACT_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/debian/changelog.in ${DEBIAN}/changelog @ONLY)
execute_process(COMMAND gzip -9nkf ${DEBIAN}/changelog)
file(CREATE_LINK ../../../share/conetact/python/conetact ${DEBIAN}/conetact SYMBOLIC)
install(FILES ${DEBIAN}/changelog.gz DESTINATION share/doc/conetact
  COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES ${DEBIAN}/conetact DESTINATION lib/python3/dist-packages
  COMPONENT debian EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME conetact)
set(CPACK_PACKAGE_CONTACT ${CONETACT_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "frictional contact of elastic bodies with the exact Coulomb cone")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Conetact computes quasi-static frictional contact of linear elastic bodies in
the plane and in space, with the exact Coulomb cone and without penalty
parameters. Scenes are described in text files. Each load increment is accepted
only after an independent check of contact law, equilibrium and balance; where
no equilibrium exists a sentence says why.

The package holds the program, scenes to start from, scripts that draw pictures
and curves of results, and a Python package for runs and sweeps.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3:any")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin, python3-matplotlib, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gmsh, paraview, python3-vtk9, xvfb")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  "${CMAKE_SOURCE_DIR}/cmake/debian/postinst;${CMAKE_SOURCE_DIR}/cmake/debian/prerm")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_COMPONENTS_ALL program debian)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)

add_custom_target(deb COMMAND ${CMAKE_CPACK_COMMAND} -G DEB WORKING_DIRECTORY ${CMAKE_BINARY_DIR} VERBATIM)
add_dependencies(deb conetact conetact-reproductions)
foreach(TARGET conetact-fclib man editors)
  if(TARGET ${TARGET})
    add_dependencies(deb ${TARGET})
  endif()
endforeach()
