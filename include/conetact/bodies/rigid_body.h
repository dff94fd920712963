// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_rigid_body_h
#define conetact_bodies_rigid_body_h

#include "conetact/bodies/without_elements.h"

#include <utility>
#include <vector>

namespace conetact::bodies
{
  /**
   * A body without elements that moves as a whole. Its first node is a
   * reference point that also rotates: forces and moments act there. The
   * others are points that contacts meet. It has no boundary and no drawing.
   * Where contacts slide, the points that they meet are means over nodes that
   * span the axes, which is exact for what moves as a whole.
   */
  class RigidBody : public WithoutElements
  {
  public:
    RigidBody(const unsigned int           dim,
              const Point<3>              &reference,
              const std::vector<Point<3>> &points,
              const bool                   axisymmetric = false);
    /** Adds the nodes that span the axes. */
    void
    span();
    /** The one along an axis. */
    unsigned int
    spanning_node(const unsigned int axis) const
    {
      return n_nodes() - dim + axis;
    }
    /** Weights of the reference point and of these nodes, whose mean p is. */
    std::vector<std::pair<unsigned int, double>>
    weights_of(const Point<3> &p) const;

    unsigned int
    n_nodes() const override
    {
      return static_cast<unsigned int>(positions.size());
    }
    unsigned int
    n_components() const override
    {
      return dim == 2 ? 3 : 6;
    }
    Point<3>
    position(const unsigned int node) const override
    {
      return positions[node];
    }
    bool
    is_axisymmetric() const override
    {
      return is_ring;
    }
    bool
    has_dof(const unsigned int node,
            const unsigned int component) const override
    {
      return node == 0 || component < dim;
    }
    std::string
    description() const override;

  private:
    unsigned int          dim;
    bool                  is_ring;
    std::vector<Point<3>> positions;
    std::size_t           n_points; ///< that contacts meet
  };
} // namespace conetact::bodies

#endif
