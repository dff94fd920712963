// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensed_bound.h"

#include <deal.II/base/exceptions.h>

#include <utility>

namespace conetact::contact
{
  using Eigen::Index;
  using Eigen::VectorXd;

  CondensedBound::CondensedBound(const ContactPoints &p, const RigidMotions &m)
    : points(p)
    , motions(m)
  {}

  /* 1 / W_ii is the stiffness along a row. Where supports hold both sides
     nothing gives way, and 1e-14 of the mean is its rounding: the stiffness is
     that of the mean then. */
  Eigen::MatrixXd
  CondensedBound::eliminate(Eigen::MatrixXd      all,
                            const model::Bodies &bodies,
                            const Coordinates   &coordinates)
  {
    const Index n_bound = points.n_bound_unknowns();
    if (n_bound == 0)
      return all;
    const VectorXd diagonal = all.diagonal().head(points.n_all_unknowns());
    const double   mean     = diagonal.mean();
    along_rows              = diagonal.tail(n_bound).unaryExpr(
      [mean](const double w) { return 1 / (w > 1e-14 * mean ? w : mean); });
    unknowns =
      BoundUnknowns(all,
                    points.n_unknowns(),
                    n_bound,
                    motions.free_of_own(),
                    motions.tied_of_own(),
                    motions.loose(),
                    find_redundant_rows(bodies, points, coordinates, motions));
    return unknowns.matrix();
  }

  /* Solvers see the load without what is bound, and what bound reactions do in
     answer to it is part of that. The bound part is kept, for they are computed
     from it in the end. */
  void
  CondensedBound::set_load(const Eigen::VectorXd &all, LoadCase &load) const
  {
    if (points.n_bound() == 0)
      {
        load.f = all;
        return;
      }
    load.bound = unknowns.bound_part(all);
    load.f     = unknowns.kept_part(all) + unknowns.effect(load.bound);
  }

  Eigen::VectorXd
  CondensedBound::all_of(const LoadCase &load, const VectorXd &primal) const
  {
    return points.n_bound() == 0 ? primal :
                                   unknowns.complete(primal, load.bound);
  }

  /* An offset of the rows of what is bound is a load like q_t: v_t = 0 holds
     with it. */
  void
  CondensedBound::move(const VectorXd &offset, LoadCase &load) const
  {
    if (points.n_bound() == 0)
      return;
    VectorXd change            = VectorXd::Zero(load.bound.size());
    change.head(offset.size()) = offset;
    load.bound += change;
    load.f += unknowns.effect(change);
  }

  BoundState
  CondensedBound::state(const LoadCase &load, const VectorXd &primal) const
  {
    AssertDimension(primal.size(), points.n_unknowns() + motions.n_free());
    if (points.n_bound() == 0)
      return {};
    const VectorXd x = unknowns.bound_of(primal, load.bound);
    const Index    n = points.n_bound_unknowns();
    return {x.head(n), motions.own() * x.tail(x.size() - n)};
  }
} // namespace conetact::contact
