# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# cmake --install: programs, scenes, scripts, the Python package and pages to read
# (component program), and the solvers as a package for other programs (development).
# Folders are those of the GNU coding standards; scripts find theirs relative to
# themselves, so that the whole may be moved.
if(NOT CMAKE_INSTALL_DOCDIR) # else it would have the project's capital letter
  set(CMAKE_INSTALL_DOCDIR share/doc/conetact)
endif()
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
include(GNUInstallDirs)
set(SHARED_FILES ${CMAKE_INSTALL_DATADIR}/conetact)

install(TARGETS conetact conetact-reproductions RUNTIME)
if(TARGET conetact-exchange)
  # of no use to other programs, hence not among the libraries of the system; two
  # folders below them, or CPack would have the package call ldconfig
  set(PRIVATE_LIBRARIES ${CMAKE_INSTALL_LIBDIR}/conetact/private)
  install(TARGETS conetact-exchange LIBRARY DESTINATION ${PRIVATE_LIBRARIES})
  install(TARGETS conetact-fclib RUNTIME)
  file(RELATIVE_PATH FROM_PROGRAMS /usr/${CMAKE_INSTALL_BINDIR} /usr/${PRIVATE_LIBRARIES})
  set_target_properties(conetact conetact-fclib PROPERTIES
    INSTALL_RPATH "$ORIGIN/${FROM_PROGRAMS}")
endif()

set(ONLY_PYTHON FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN "*.ipynb" PATTERN __pycache__ EXCLUDE)
install(DIRECTORY parameter-files DESTINATION ${SHARED_FILES})
install(PROGRAMS scripts/picture.py scripts/curve.py scripts/conetact-report DESTINATION ${SHARED_FILES}/scripts)
install(DIRECTORY scripts/drawing DESTINATION ${SHARED_FILES}/scripts ${ONLY_PYTHON})
install(DIRECTORY python DESTINATION ${SHARED_FILES} USE_SOURCE_PERMISSIONS ${ONLY_PYTHON}
  PATTERN "*.js" PATTERN "*.css" PATTERN "*.html") # of which reports are made

# conetact-picture, conetact-curve and conetact-report: links, as they are in the installed tree
set(LINKS ${CMAKE_BINARY_DIR}/links)
file(MAKE_DIRECTORY ${LINKS}/${CMAKE_INSTALL_BINDIR} ${LINKS}/${SHARED_FILES})
file(CREATE_LINK ${CMAKE_SOURCE_DIR}/scripts ${LINKS}/${SHARED_FILES}/scripts SYMBOLIC)
file(RELATIVE_PATH TO_SCRIPTS /usr/${CMAKE_INSTALL_BINDIR} /usr/${SHARED_FILES}/scripts)
foreach(SCRIPT picture.py curve.py conetact-report)
  string(REGEX REPLACE "^(conetact-)?([a-z]+).*" "conetact-\\2" NAME ${SCRIPT})
  set(LINK ${LINKS}/${CMAKE_INSTALL_BINDIR}/${NAME})
  file(CREATE_LINK ${TO_SCRIPTS}/${SCRIPT} ${LINK} SYMBOLIC)
  install(PROGRAMS ${LINK} TYPE BIN)
endforeach()

install(FILES README.md CHANGELOG.md CITATION.cff cmake/debian/copyright TYPE DOC)
install(DIRECTORY doc DESTINATION ${CMAKE_INSTALL_DOCDIR}
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.geo" PATTERN "*.prm"
  PATTERN doxygen EXCLUDE PATTERN man EXCLUDE PATTERN _static EXCLUDE)
install(FILES doc/doxygen/theory.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/doc/doxygen) # which pages link

# for programs that link the solvers
set_target_properties(conetact-solvers PROPERTIES EXPORT_NAME solvers)
install(TARGETS conetact-solvers EXPORT ConetactTargets ARCHIVE COMPONENT development)
install(DIRECTORY include/conetact/solvers include/conetact/load_path
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/conetact COMPONENT development)
install(EXPORT ConetactTargets NAMESPACE Conetact::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Conetact COMPONENT development)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/ConetactConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES cmake/ConetactConfig.cmake ${CMAKE_BINARY_DIR}/ConetactConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Conetact COMPONENT development)
install(FILES LICENSE TYPE DOC COMPONENT development)
