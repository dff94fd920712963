// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_rigid_body_h
#define conetact_bodies_rigid_body_h

#include "conetact/bodies/without_elements.h"

namespace conetact::bodies
{
  /**
   * A body without elements that moves as a whole. Its first node is a
   * reference point that also rotates: forces and moments act there. The
   * others are points that contacts meet. It has no boundary and no drawing.
   */
  class RigidBody : public WithoutElements
  {
  public:
    RigidBody(const unsigned int           dim,
              const Point<3>              &reference,
              const std::vector<Point<3>> &points,
              const bool                   axisymmetric = false);

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
  };
} // namespace conetact::bodies

#endif
