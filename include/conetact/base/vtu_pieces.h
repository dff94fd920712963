// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_vtu_pieces_h
#define conetact_base_vtu_pieces_h

#include "conetact/base/communicator.h"
#include "conetact/base/vtu_grid.h"

#include <filesystem>

namespace conetact
{
  /**
   * On the first of some processes: writes the pieces of a picture, one by each
   * of them, in a folder that is there for all. `files` and `cells`: those of
   * each piece. Returns a sentence if that failed for one of them.
   */
  std::string
  write_pieces(const std::filesystem::path                  &folder,
               const std::vector<std::string>               &files,
               const VtuGrid                                &grid,
               const std::vector<std::vector<unsigned int>> &cells,
               const double                                  time,
               const unsigned int                            increment,
               const Communicator                           &processes);

  /** On each of the others. */
  void
  write_own_piece(const Communicator &processes);
} // namespace conetact

#endif
