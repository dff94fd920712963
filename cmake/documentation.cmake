# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# cmake --build build --target doc: build/doc/html/index.html, with README, pages of doc/, all
# entries of scenes as the program prints them, theory and headers. A warning fails it, as does
# a picture or a file that is linked to but is not there.
find_program(DOXYGEN doxygen)
find_program(DOT dot)
if(NOT DOXYGEN)
  message(STATUS "Doxygen not found: there is no target doc (Debian: doxygen, graphviz)")
  return()
endif()

set(CONETACT_DOC_FOLDER ${CMAKE_BINARY_DIR}/doc)
set(CONETACT_HAVE_DOT NO)
if(DOT)
  set(CONETACT_HAVE_DOT YES)
endif()
file(MAKE_DIRECTORY ${CONETACT_DOC_FOLDER})
configure_file(doc/doxygen/Doxyfile.in ${CONETACT_DOC_FOLDER}/Doxyfile @ONLY)
add_custom_target(doc
  COMMAND sh -c "\"$0\" --parameters | sed '1s/$/ {#entries}/' > entries.md" $<TARGET_FILE:conetact>
  COMMAND ${DOXYGEN} Doxyfile
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/check_site.py html
  WORKING_DIRECTORY ${CONETACT_DOC_FOLDER} VERBATIM)
install(DIRECTORY ${CONETACT_DOC_FOLDER}/html TYPE DOC COMPONENT documentation OPTIONAL)
