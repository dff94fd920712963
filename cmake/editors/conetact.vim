" SPDX-FileCopyrightText: Conetact authors
" SPDX-License-Identifier: LGPL-2.1-or-later
"
" Scenes of Conetact, unless somebody else has claimed the file.
autocmd BufNewFile,BufRead *.prm setfiletype conetact
autocmd FileType conetact setlocal commentstring=#\ %s
