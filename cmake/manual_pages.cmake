# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Pages of man, made from what the programs print for --help, target man.
find_program(HELP2MAN help2man)
find_program(GZIP gzip)
if(NOT HELP2MAN OR NOT GZIP OR CONETACT_SANITIZE)
  if(NOT CONETACT_SANITIZE)
    message(STATUS "help2man not found: there are no pages of man (Debian: help2man)")
  endif()
  return()
endif()

add_custom_target(man ALL)

# PROGRAM prints --help; the page is made anew when one of DEPENDS changes. help2man knows
# the line of usage by a capital letter.
function(add_manual_page NAME PROGRAM SUMMARY)
  cmake_parse_arguments(PAGE "" "" DEPENDS ${ARGN})
  set(PAGE ${CMAKE_BINARY_DIR}/man/${NAME}.1)
  set(MORE ${CMAKE_SOURCE_DIR}/doc/man/${NAME}.txt)
  set(TELLER ${CMAKE_BINARY_DIR}/man/programs/${NAME})
  file(GENERATE OUTPUT ${TELLER}
    CONTENT "#!/bin/sh\n\"${PROGRAM}\" \"$@\" | sed '1s/^usage:/Usage:/'\n"
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  add_custom_command(OUTPUT ${PAGE}.gz
    COMMAND ${HELP2MAN} --no-info --name=${SUMMARY} "--version-string=${PROJECT_VERSION}"
      "--source=Conetact ${PROJECT_VERSION}" --include=${MORE} --output=${PAGE} ${TELLER}
    COMMAND ${GZIP} -9nf ${PAGE}
    DEPENDS ${PAGE_DEPENDS} ${MORE} ${TELLER} COMMENT "Page of man: ${NAME}" VERBATIM)
  add_custom_target(man-${NAME} DEPENDS ${PAGE}.gz)
  add_dependencies(man man-${NAME})
  install(FILES ${PAGE}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endfunction()

add_manual_page(conetact $<TARGET_FILE:conetact>
  "frictional contact of elastic bodies with the exact Coulomb cone" DEPENDS conetact)
add_manual_page(conetact-reproductions $<TARGET_FILE:conetact-reproductions>
  "methods that only reproduce tables of two papers" DEPENDS conetact-reproductions)
if(TARGET conetact-fclib)
  add_manual_page(conetact-fclib $<TARGET_FILE:conetact-fclib>
    "solve frictional contact problems in files of FCLib" DEPENDS conetact-fclib)
endif()

# the scripts need their packages to tell their options
execute_process(COMMAND /usr/bin/python3 -c "import numpy, matplotlib"
  RESULT_VARIABLE NO_PYTHON ERROR_QUIET OUTPUT_QUIET)
if(NO_PYTHON)
  message(STATUS "numpy or matplotlib not found: scripts have no pages of man "
    "(Debian: python3-numpy, python3-matplotlib)")
else()
  add_manual_page(conetact-picture ${LINKS}/${CMAKE_INSTALL_BINDIR}/conetact-picture
    "draw the bodies and contacts of a run of Conetact" DEPENDS scripts/picture.py)
  add_manual_page(conetact-curve ${LINKS}/${CMAKE_INSTALL_BINDIR}/conetact-curve
    "draw columns of the tables of a run of Conetact" DEPENDS scripts/curve.py)
  add_manual_page(conetact-report ${LINKS}/${CMAKE_INSTALL_BINDIR}/conetact-report
    "show a run of Conetact in one page for a browser" DEPENDS scripts/conetact-report)
endif()
