// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_displaced_h
#define conetact_bodies_displaced_h

#include "conetact/bodies/structure.h"

namespace conetact::bodies
{
  /**
   * A body whose nodes stand elsewhere, X + u: positions and the normals of
   * surfaces are those of the displaced nodes. All else is that of the body,
   * also areas: strains are small, and elasticity knows no displacement.
   */
  class Displaced : public Structure
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
    void
    for_each_element(const ElementVisitor &visit) const override
    {
      body.for_each_element(visit);
    }
    void
    for_each_connection(const ConnectionVisitor &visit) const override
    {
      body.for_each_connection(visit);
    }
    void
    add_internal_forces(const Eigen::VectorXd &displacement,
                        Eigen::VectorXd       &f) const override
    {
      body.add_internal_forces(displacement, f);
    }
    void
    add_traction(const BoundaryIds  &ids,
                 const SurfaceField &traction,
                 Eigen::VectorXd    &f) const override
    {
      body.add_traction(ids, traction, f);
    }
    void
    add_body_force(const VectorField &force, Eigen::VectorXd &f) const override
    {
      body.add_body_force(force, f);
    }
    bool
    add_point_force(const Point<3>     &point,
                    const Tensor<1, 3> &force,
                    Eigen::VectorXd    &f) const override
    {
      return body.add_point_force(point, force, f);
    }
    void
    visit_springs(const BoundaryIds        &ids,
                  const SurfaceTensorField &stiffness,
                  const ElementVisitor     &visit) const override
    {
      body.visit_springs(ids, stiffness, visit);
    }
    VtuGrid
    drawing(const Eigen::VectorXd &displacement,
            const Eigen::VectorXd &deformation,
            const Actions         &actions) const override
    {
      return body.drawing(displacement, deformation, actions);
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
