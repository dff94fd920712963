// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_skin_h
#define conetact_output_skin_h

#include "conetact/base/vtu_grid.h"
#include "conetact/bodies/structure.h"
#include "conetact/output/output.h"

namespace conetact::output
{
  /** A node in the middle of corners of a face, of which contacts stand at the
   * corners alone. */
  struct SkinMiddle
  {
    bodies::HangingNode       between;
    std::vector<unsigned int> corners; ///< all of the face
  };

  /** The surface of a body as cells; points are its nodes there. */
  struct Skin
  {
    VtuGrid                   grid;  ///< with `boundary_id`, without fields
    std::vector<unsigned int> nodes; ///< their numbers in the body
    std::vector<SkinMiddle>   middles;
  };

  Skin
  make_skin(const bodies::Structure &body);

  /** Displacement of a node of a drawn body; 0 where it is not known. */
  Tensor<1, 3>
  displacement_of(const RunDescription         &run,
                  const model::IncrementRecord &record,
                  const unsigned int            body,
                  const unsigned int            node);

  /**
   * A skin with the fields of its points: `displacement` [length],
   * `contact_pressure` and the vector `contact_traction` [stress], `gap`, the
   * vector `slip` of the increment [length] and `state`: -1 where nothing may
   * touch (its gap is not a number), 0 open, 1 stick, 2 slip. A node in several
   * contacts has the sum of their tractions, the largest pressure with its
   * state and slip, and the least gap. Where contacts stand at the corners of
   * faces, nodes in the middle have what is between those of their edge, and
   * the state of the one that is pressed most.
   */
  VtuGrid
  draw_skin(const Skin                   &skin,
            const RunDescription         &run,
            const model::IncrementRecord &record,
            const unsigned int            body);

  /**
   * Gives the same fields, where there are contacts, to the points of a drawn
   * body. They are no numbers where nothing may touch, `state` is -1 there.
   */
  void
  add_contact(const Skin                   &skin,
              const RunDescription         &run,
              const model::IncrementRecord &record,
              const unsigned int            body,
              VtuGrid                      &grid);

  /**
   * Contact nodes at their undeformed places, with the vectors `reaction`
   * [force], `traction` (reaction over tributary area, [stress]), `slip` (of
   * the increment), `u` (total, relative to the other side), `normal` and
   * `displacement` [length] in global coordinates, and the scalars `gap`,
   * `state` (0 open, 1 stick, 2 slip), `contact` (its place in the list of
   * contacts) and `pressure`.
   */
  VtuGrid
  draw_contact_nodes(const RunDescription         &run,
                     const model::IncrementRecord &record);
} // namespace conetact::output

#endif
