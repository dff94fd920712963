# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# What the program makes of its table of entries for shells and editors, target editors:
# completion of bash, colours of scenes in vim and VS Code, a JSON schema of all entries.
if(CONETACT_SANITIZE)
  return()
endif()

add_custom_target(editors ALL)
set(EDITORS ${CMAKE_BINARY_DIR}/editors)
file(MAKE_DIRECTORY ${EDITORS})

# FILE is what `conetact ARGUMENTS` prints; it is installed into FOLDER.
function(add_entry_text FILE FOLDER)
  get_filename_component(NAME ${FOLDER} NAME)
  set(TEXT ${EDITORS}/${NAME}/${FILE})
  file(MAKE_DIRECTORY ${EDITORS}/${NAME})
  add_custom_command(OUTPUT ${TEXT} COMMAND conetact ${ARGN} > ${TEXT} DEPENDS conetact COMMENT "For editors: ${FILE}")
  add_custom_target(editors-${NAME} DEPENDS ${TEXT})
  add_dependencies(editors editors-${NAME})
  install(FILES ${TEXT} DESTINATION ${FOLDER})
endfunction()

set(VIM ${CMAKE_INSTALL_DATADIR}/vim/vimfiles)
set(VSCODE ${SHARED_FILES}/vscode)
add_entry_text(conetact ${CMAKE_INSTALL_DATADIR}/bash-completion/completions --completion bash)
add_entry_text(conetact.vim ${VIM}/syntax --grammar vim)
add_entry_text(conetact.tmLanguage.json ${VSCODE}/syntaxes --grammar vscode)
add_entry_text(scene.schema.json ${SHARED_FILES}/schema --schema)
install(FILES cmake/editors/conetact.vim DESTINATION ${VIM}/ftdetect)
install(FILES cmake/editors/package.json cmake/editors/language-configuration.json DESTINATION ${VSCODE})
