// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_rigid_body_h
#define conetact_bodies_rigid_body_h

#include "conetact/bodies/structure.h"

namespace conetact::bodies
{
  /**
   * A body without elements that moves as a whole. Its first node is a
   * reference point that also rotates: forces and moments act there. The
   * others are points that contacts meet. It has no boundary and no drawing.
   */
  class RigidBody : public Structure
  {
  public:
    RigidBody(const unsigned int           dim,
              const Point<3>              &reference,
              const std::vector<Point<3>> &points);

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
    const std::vector<HangingNode> &
    hanging_nodes() const override;
    bool
    has_dof(const unsigned int node,
            const unsigned int component) const override
    {
      return node == 0 || component < dim;
    }
    void
    for_each_element(const ElementVisitor &) const override
    {}
    void
    add_internal_forces(const Eigen::VectorXd &,
                        Eigen::VectorXd &) const override
    {}
    BoundaryIds
    boundary_ids() const override
    {
      return {};
    }
    Surface
    surface(const BoundaryIds &) const override
    {
      return {};
    }
    void
    add_traction(const BoundaryIds &,
                 const SurfaceField &,
                 Eigen::VectorXd &) const override
    {}
    void
    add_body_force(const VectorField &, Eigen::VectorXd &) const override
    {}
    bool
    add_point_force(const Point<3> &,
                    const Tensor<1, 3> &,
                    Eigen::VectorXd &) const override
    {
      return false;
    }
    void
    visit_springs(const BoundaryIds &,
                  const SurfaceTensorField &,
                  const ElementVisitor &) const override
    {}
    VtuGrid
    drawing(const Eigen::VectorXd &,
            const Eigen::VectorXd &,
            const Actions &) const override
    {
      return {};
    }
    std::string
    description() const override;

  private:
    unsigned int          dim;
    std::vector<Point<3>> positions;
  };
} // namespace conetact::bodies

#endif
