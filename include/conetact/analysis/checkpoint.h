// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_checkpoint_h
#define conetact_analysis_checkpoint_h

#include "conetact/base/archive.h"
#include "conetact/contact/contact_model.h"

#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * Throws InputError where what a checkpoint holds is not of this model: sizes
   * of what is restored in whatever size it has, and numbers that choose from a
   * table. `supports`: names of the scene's.
   */
  void
  check_checkpoint(const Archive                  &archive,
                   const contact::ContactModel    &model,
                   const std::vector<std::string> &supports);

  /** How many rows its run has written to reactions.csv. */
  std::size_t
  reaction_rows_of(const Archive &archive);
  void
  put_reaction_rows(Archive &archive, const std::size_t n_rows);
} // namespace conetact::analysis

#endif
