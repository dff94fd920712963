// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_pieces_h
#define conetact_contact_pieces_h

#include "conetact/bodies/structure.h"
#include "conetact/contact/rigid_motions.h"

#include <vector>

namespace conetact::contact
{
  /** Of each node the part of its body that it is in, which no element joins to
   * others; numbers count from 0. */
  std::vector<unsigned int>
  pieces(const bodies::Structure &structure);

  /** How many such parts there are. */
  unsigned int
  n_pieces(const bodies::Structure &structure);

  /**
   * Throws InputError where a body is of several pieces and one of them could
   * move by itself, although nothing but contacts is in its way: a flexibility
   * has the motions of whole bodies only. Frames, whose members may hang
   * together by nothing but joints, are left to be judged by their stiffness.
   */
  void
  refuse_loose_pieces(const model::Bodies &bodies,
                      const NodeRules     &rules,
                      const RigidMotions  &motions);
} // namespace conetact::contact

#endif
