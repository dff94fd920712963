// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_steps_h
#define conetact_pairing_steps_h

#include "conetact/pairing/facing_parts.h"

#include <vector>

namespace conetact::pairing
{
  /** What each face of a slave sees. */
  using SeenParts = std::vector<std::vector<FacingParts::Part>>;

  /**
   * Takes away parts of a master that are a step behind what is seen beside
   * them, such as the overhang beside a foot: faces that are further off than
   * others and that no faces in sight join to these. A mean over both would be
   * none of either, and where its function changes its sign even below both.
   */
  void
  leave_out_steps(const std::vector<FaceNet::Face> &slave,
                  const std::vector<FaceNet::Face> &master,
                  SeenParts                        &seen);
} // namespace conetact::pairing

#endif
