// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/node_sets.h"
#include "conetact/solvers/seen_node.h"

#include <algorithm>
#include <cmath>

namespace conetact::solvers
{
  using Eigen::Index;
  using Eigen::VectorXd;

  namespace
  {
    /** v with a slip that is not much larger than r, or r would be rounded. */
    SmallVector
    near_reaction(SmallVector v, const SmallVector &r)
    {
      const Index  nt    = v.size() - 1;
      const double slip  = v.head(nt).norm();
      const double limit = longest_slip * r.norm();
      if (slip > limit && limit > 0)
        v.head(nt) *= limit / slip;
      return v;
    }
  } // namespace

  /* The square root of sum_i |r_i - P(r_i - v_i)|^2 + |imbalance|^2, over the
     scale of forces. In the scaled variables stiffness is about one, so that v
     counts as the force it would take. */
  double
  law_residual(const LinearRelation &relation,
               const VectorXd       &p,
               const VectorXd       &d)
  {
    eigen_assert(p.size() == d.size());
    const ContactSystem &system = relation.system();
    const Fields         x(relation, p, d);
    const Index          n       = system.n_contact_unknowns();
    double               sum     = x.v.tail(system.n_motions).squaredNorm();
    VectorXd             allowed = relation.rounding(p); // of v, not of step v
    for (Index i = 0; relation.has_layers() && i < system.n_nodes(); ++i)
      allowed.segment(system.first[i], system.n_tangents(i) + 1).array() *=
        relation.step(i).of(system.n_tangents(i) + 1).array();
    const VectorXd v = without_rounding(x.v.head(n), allowed);
    if (relation.stiffness())
      sum = 0;
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index       first = system.first[i], nt = system.n_tangents(i);
        const SmallVector r = x.r.segment(first, nt + 1);
        if (relation.is_apart(i))
          {
            sum += r.squaredNorm();
            continue;
          }
        if (relation.is_joined(i))
          {
            sum += v.segment(first, nt + 1).squaredNorm();
            continue;
          }
        const Seen        seen(relation, i, x);
        const SmallVector forces = seen.forces();
        SmallVector       z =
          forces -
          near_reaction(seen.scale.cwiseProduct(v.segment(first, nt + 1)),
                        forces);
        const double zn    = std::max(z(nt), 0.);
        const double limit = limit_at(relation, i, zn, seen.v).value;
        const double norm  = z.head(nt).norm();
        if (norm > limit)
          z.head(nt) *= limit / norm;
        // Not the nearest point of the cone, but r_t cut back to mu z_n, as the
        // sets have it. Either residual vanishes where the law holds.
        z(nt) = zn;
        sum += seen.scale.cwiseProduct(forces - z).squaredNorm();
      }
    return std::sqrt(sum) / relation.force_scale(p, d);
  }

  /* |r_t + limit v_t / |v_t||. For a slip askew by an angle law_residual() has
     about |v_t| times its sine, which is nothing where the slip is short. */
  double
  askew_friction(const LinearRelation &relation,
                 const NodeSets       &sets,
                 const VectorXd       &p,
                 const VectorXd       &d,
                 const double          rounding)
  {
    eigen_assert(p.size() == d.size());
    eigen_assert(rounding >= 0);
    const ContactSystem &system = relation.system();
    const Fields         x(relation, p, d);
    double               largest = 0, askew = 0;
    for (Index i = 0; i < system.n_nodes(); ++i)
      largest =
        std::max(largest,
                 x.r.segment(system.first[i], system.n_tangents(i) + 1).norm());
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (sets[static_cast<std::size_t>(i)].state == NodeState::slip)
        {
          const Index       nt = system.n_tangents(i);
          const Seen        seen(relation, i, x);
          const SmallVector slip = seen.slips().head(nt);
          const double limit = limit_at(relation, i, seen.r(nt), seen.v).value;
          if (seen.slip() > rounding * largest)
            askew = std::max(askew,
                             seen.scale.head(nt)
                               .cwiseProduct(seen.forces().head(nt) +
                                             limit / slip.norm() * slip)
                               .norm());
        }
    return largest > 0 ? askew / largest : 0.;
  }
} // namespace conetact::solvers
