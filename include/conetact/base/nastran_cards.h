// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_nastran_cards_h
#define conetact_base_nastran_cards_h

#include <string>

namespace conetact
{
  /**
   * Bulk data of Nastran with its cards of cells (CTRIA3, CHEXA, ...) in free
   * fields, eight on a line, each line marked by '+' where another one follows.
   * Gmsh reads these whole, but of others it leaves out lines that follow
   * without a mark, and those beyond the third. All else stays as it is. Throws
   * FileFault where a cell has a number of nodes that none of its kind has.
   */
  std::string
  with_whole_cards(const std::string &deck);
} // namespace conetact

#endif
