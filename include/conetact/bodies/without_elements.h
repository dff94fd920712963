// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_without_elements_h
#define conetact_bodies_without_elements_h

#include "conetact/bodies/structure.h"

#include <vector>

namespace conetact::bodies
{
  /** Nodes only: a body without elements, boundary, loads and drawing. */
  class WithoutElements : public Structure
  {
  public:
    const std::vector<HangingNode> &
    hanging_nodes() const override
    {
      static const std::vector<HangingNode> none;
      return none;
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
  };
} // namespace conetact::bodies

#endif
