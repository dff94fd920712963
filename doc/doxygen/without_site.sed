# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Doxygen does not read the pages of doc/site: links to them become their words.
s#\[([^]]*)\]\((doc/)?site/[^)]*\)#\1#g
