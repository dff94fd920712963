// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_without_elements_h
#define conetact_bodies_without_elements_h

#include "conetact/bodies/structure.h"

#include <vector>

namespace conetact::bodies
{
  class NoElements : public Elements
  {
  public:
    using Elements::Elements;
    void
    for_each(const ElementVisitor &) const override
    {}
    void
    add_forces(const Eigen::VectorXd &, Eigen::VectorXd &) const override
    {}
  };

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
    const Elements &
    elements() const override
    {
      static const NoElements none(1);
      return none;
    }
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
    bool
    add(const Action &, Eigen::VectorXd &) const override
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
