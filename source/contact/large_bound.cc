// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/large_bound.h"

#include "conetact/contact/large_nodes.h"

#include <deal.II/base/exceptions.h>

namespace conetact::contact
{
  using Eigen::VectorXd;

  LargeBound::LargeBound(const ElasticSystem &e,
                         const ContactPoints &points,
                         const LargeUnknowns &u)
    : elastic(e)
    , unknowns(u)
    , n(points.n_bound_unknowns())
    , rows_of_dofs(rows_of_further(e.bodies, u.coordinates, points))
  {
    if (n == 0)
      return;
    const VectorXd diagonal =
      diagonal_of(elastic, unknowns.coordinates.n_dofs());
    // Of what supports hold, any of the size of the others.
    along_unknowns.setConstant(n, diagonal.mean());
    for (const auto &bound : unknowns.coordinates.bound_directions())
      {
        double sum = 0;
        for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
          sum +=
            diagonal[bound.dof + c] * bound.direction[c] * bound.direction[c];
        along_unknowns[bound.unknown] = sum;
      }
  }

  VectorXd
  LargeBound::expand(const VectorXd &v) const
  {
    AssertDimension(v.size(), n);
    VectorXd u = VectorXd::Zero(unknowns.coordinates.n_dofs());
    for (const auto &bound : unknowns.coordinates.bound_directions())
      for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
        u[bound.dof + c] += v[bound.unknown] * bound.direction[c];
    return u;
  }

  VectorXd LargeBound::restrict(const VectorXd &forces) const
  {
    AssertDimension(forces.size(), unknowns.coordinates.n_dofs());
    VectorXd r = VectorXd::Zero(n);
    for (const auto &bound : unknowns.coordinates.bound_directions())
      for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
        r[bound.unknown] += forces[bound.dof + c] * bound.direction[c];
    return r;
  }

  LoadCase
  LargeBound::load_of(const VectorXd &forces) const
  {
    LoadCase load;
    load.f             = unknowns.restrict(forces);
    load.bound         = VectorXd::Zero(2 * n);
    load.bound.head(n) = restrict(forces);
    return load;
  }

  void
  LargeBound::add_displacements(const LoadCase &load, VectorXd &u) const
  {
    if (n > 0)
      u += expand(load.bound.tail(n));
  }

  /* What is bound stays where it is: it moves the other way against its
     body. */
  void
  LargeBound::move(const VectorXd &offset, LoadCase &load) const
  {
    AssertDimension(load.bound.size(), 2 * n);
    if (offset.isZero(0))
      return;
    const VectorXd forces = elastic.internal_forces(expand(offset));
    load.f += unknowns.restrict(forces);
    load.bound.head(n) += restrict(forces);
    load.bound.tail(n) -= offset;
    if (!unknowns.further)
      return;
    // where a bound node meets something else, too
    const VectorXd seen = rows_of_dofs * expand(offset);
    const auto     further =
      unknowns.further->unknowns_of(unknowns.further->further);
    for (std::size_t k = 0; k < further.size(); ++k)
      load.offset[further[k]] -= seen[static_cast<Eigen::Index>(k)];
  }

  BoundState
  LargeBound::state(const LoadCase &load, const VectorXd &primal) const
  {
    if (n == 0)
      return {};
    VectorXd f =
      elastic.internal_forces(unknowns.displacements(load.f, primal));
    if (unknowns.further)
      f -= rows_of_dofs.transpose() * unknowns.further->reactions(primal);
    return {restrict(f) - load.bound.head(n), {}};
  }
} // namespace conetact::contact
