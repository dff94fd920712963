// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_near_sides_h
#define conetact_pairing_near_sides_h

#include "conetact/pairing/contact_nodes.h"

#include <deal.II/base/bounding_box.h>

#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace conetact::pairing
{
  /** Faces of a body that oppose those of another body, or an obstacle. */
  struct NearSides
  {
    unsigned int                body = 0; ///< index
    bodies::BoundaryIds         ids;
    std::optional<unsigned int> obstacle;   ///< index; none: a master body
    unsigned int                master = 0; ///< index
    bodies::BoundaryIds         master_ids;
  };

  /** All that oppose each other, and the bodies that do not (yet). */
  struct NearPairs
  {
    std::vector<NearSides>                             sides;
    std::vector<std::pair<unsigned int, unsigned int>> apart;
  };

  /**
   * Finds which faces of bodies oppose each other nearby, and those that oppose
   * an obstacle. What it is made of must outlive it.
   */
  class NearSearch
  {
  public:
    /**
     * Faces are near up to this gap [length]; none: up to a quarter of the
     * edges of the finer side. The `law` tells which normals oppose each other,
     * and how deep bodies may start in each other.
     */
    NearSearch(const std::vector<const bodies::Structure *> &structures,
               const std::vector<Obstacle>                  &obstacles,
               const Contact                                &law,
               const std::optional<double>                   largest_gap);

    /** The slave is the continuum, then the finer one, then `one`. */
    std::optional<NearSides>
    between(const unsigned int one, const unsigned int other) const;
    /** None also of obstacles whose gaps are stated node by node. */
    std::optional<NearSides>
    on_obstacle(const unsigned int body, const unsigned int obstacle) const;

  private:
    using Box = dealii::BoundingBox<3>;
    /** The faces of one boundary id. */
    struct Patch
    {
      unsigned int    id;
      bodies::Surface surface;
      Box             box;
      double          edge = 0; ///< mean length; 0: it has no faces
    };
    struct Side
    {
      unsigned int        body;
      bodies::BoundaryIds ids;
      double              edge      = 0; ///< of its finest patch
      bool                two_sided = false;
    };
    static Patch
    patch_of(const bodies::Structure &body, const unsigned int id);
    static bool
    is_the_axis(const Patch &patch, const bodies::Structure &body);
    double
    edge_of(const unsigned int body, const bodies::BoundaryIds &ids) const;
    double
    gap_allowed(const double edge) const;
    Side
    side_near(const unsigned int body, const unsigned int other) const;
    std::optional<NearSides>
    sides_that_meet(Contact                    trial,
                    const bodies::BoundaryIds &slaves,
                    const bodies::BoundaryIds &masters,
                    const double               gap) const;
    bool
    meets_an_edge(const ContactNode &node) const;
    std::vector<ContactNode>
    nodes_on_others(const Contact &trial, const double gap) const;
    bool
    meet(const Contact &trial, const double gap) const;

    const std::vector<const bodies::Structure *> &structures;
    const std::vector<Obstacle>                  &obstacles;
    const Contact                                &law;
    std::optional<double>                         largest_gap;
    std::vector<std::vector<Patch>>               patches; ///< of each body
    std::vector<Box>                              boxes;   ///< around bodies
    std::vector<std::set<unsigned int>> sharp; ///< nodes where faces make edges
  };
} // namespace conetact::pairing

#endif
