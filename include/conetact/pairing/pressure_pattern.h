// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_pressure_pattern_h
#define conetact_pairing_pressure_pattern_h

#include "conetact/bodies/structure.h"

#include <map>
#include <set>
#include <vector>

namespace conetact::pairing
{
  /**
   * What pressures of single nodes tell of their mesh: the pressure of bodies
   * goes up and down over many nodes, that of facets from one to the next.
   */
  class PressurePattern
  {
  public:
    using Pressures = std::map<unsigned int, double>; ///< by node; others: none

    PressurePattern(const bodies::Structure   &body,
                    const bodies::BoundaryIds &ids);

    /**
     * Nodes in pits: pressed clearly less than the two nodes before and behind
     * them on a line, which for nodes at the rim runs along it.
     */
    unsigned int
    n_pits(const Pressures &pressures) const;

    /**
     * Nodes that press and of which no neighbour does though all of them are
     * among `could_press`; within a smooth part of the surface, not at its rim.
     */
    std::vector<unsigned int>
    lonely(const Pressures              &pressures,
           const std::set<unsigned int> &could_press) const;

    /**
     * Whether no node that presses has neighbours that all press: what presses
     * is a point, or one or two rows of nodes.
     */
    bool
    is_thin(const Pressures &pressures) const;
    /** Whether faces beside each other turn, by less than edges do. */
    bool
    is_bent() const;

  private:
    struct Around
    {
      std::set<unsigned int> nodes;
      std::set<unsigned int> rim; ///< of nodes, over an edge of one face only
      unsigned int           n_faces = 0;
      Tensor<1, 3>           sum; ///< of the faces' unit normals
    };
    void
    add_edge(const unsigned int one, const unsigned int other);
    bool
    is_pit(const unsigned int node,
           const double       own,
           const Pressures   &pressures) const;
    bool
    is_inside(const Around &around) const;

    bool                             plane = false; ///< faces are segments
    std::map<unsigned int, Around>   neighbours;
    std::map<unsigned int, Point<3>> positions;
  };
} // namespace conetact::pairing

#endif
