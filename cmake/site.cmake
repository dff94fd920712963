# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# cmake --build build --target site: build/site/html, the documentation for users, one folder
# without network. Any warning of Sphinx fails it, as does a link or a picture that leads
# nowhere. Where the target doc has made its pages of the C++ code, they come along.
find_program(SPHINX_BUILD sphinx-build PATHS /usr/bin)
execute_process(COMMAND /usr/bin/python3 -c "import myst_parser, furo" RESULT_VARIABLE NO_MYST ERROR_QUIET)
if(NOT SPHINX_BUILD OR NO_MYST OR NOT EXISTS /usr/share/javascript/mathjax/MathJax.js)
  message(STATUS "Sphinx not found: there is no target site (Debian: python3-sphinx, python3-myst-parser, furo, libjs-mathjax)")
  return()
endif()

add_custom_target(site
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/scripts/site.py $<TARGET_FILE:conetact> ${CMAKE_BINARY_DIR}/site
    --cpp ${CMAKE_BINARY_DIR}/doc/html
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/check_site.py ${CMAKE_BINARY_DIR}/site/html **/*.html
  VERBATIM)
install(DIRECTORY ${CMAKE_BINARY_DIR}/site/html DESTINATION ${CMAKE_INSTALL_DOCDIR}/site COMPONENT documentation OPTIONAL)
