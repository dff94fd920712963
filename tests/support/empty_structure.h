// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_empty_structure_h
#define conetact_tests_empty_structure_h

#include "conetact/bodies/structure.h"

namespace conetact::test
{
  using namespace bodies;

  /** A body without elements: what a test needs of it is overridden. */
  class EmptyStructure : public Structure
  {
  public:
    const std::vector<HangingNode> &
    hanging_nodes() const override
    {
      return hanging;
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
    description() const override
    {
      return "nothing";
    }

    std::vector<HangingNode> hanging;
  };
} // namespace conetact::test

#endif
