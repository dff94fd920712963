// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_displaced_h
#define conetact_bodies_displaced_h

#include "conetact/bodies/without_elements.h"

namespace conetact::bodies
{
  /**
   * The nodes and faces of a body where they are displaced to, X + u: positions
   * and the normals of surfaces. Areas are those of the body: strains are
   * small.
   */
  class Displaced : public WithoutElements
  {
  public:
    /** Of each node [length]. The body must outlive the object. */
    Displaced(const Structure &b, std::vector<Tensor<1, 3>> displacements)
      : body(b)
      , u(std::move(displacements))
    {}

    Point<3>
    position(const unsigned int node) const override
    {
      return body.position(node) + u[node];
    }
    Surface
    surface(const BoundaryIds &ids) const override;

    unsigned int
    n_nodes() const override
    {
      return body.n_nodes();
    }
    unsigned int
    n_components() const override
    {
      return body.n_components();
    }
    const std::vector<HangingNode> &
    hanging_nodes() const override
    {
      return body.hanging_nodes();
    }
    bool
    meets_at_corners() const override
    {
      return body.meets_at_corners();
    }
    bool
    is_axisymmetric() const override
    {
      return body.is_axisymmetric();
    }
    const std::map<std::string, BoundaryIds> &
    boundary_groups() const override
    {
      return body.boundary_groups();
    }
    BoundaryIds
    boundary_ids() const override
    {
      return body.boundary_ids();
    }
    std::string
    description() const override
    {
      return body.description();
    }

  private:
    const Structure          &body;
    std::vector<Tensor<1, 3>> u;
  };
} // namespace conetact::bodies

#endif
