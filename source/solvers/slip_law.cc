// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The laws of nodes, linearised.

#include "conetact/solvers/linearized_law.h"
#include "conetact/solvers/node_sets.h"

#include <algorithm>
#include <cmath>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;

    /**
     * The part of the slip law's derivative that turns with z_t. Exact would
     * be ratio (1 - e e^T), and that is what this tends to. Far from the
     * solution the reaction itself, cut back to the cone, takes the place of
     * one e: without this, a node that has to slip the other way spoils the
     * step (Hueber, Stadler, Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572-596).
     * Across e there is no more of it than leaves 1 - T positive definite, if
     * that is asked for.
     */
    SmallMatrix
    turning_part(const NodeSet     &set,
                 const double       limit,
                 const SmallVector &reaction,
                 const bool         definite)
    {
      const SmallVector &e = set.direction;
      const Index        n = e.size();
      if (n < 2)
        return SmallMatrix::Zero(n, n);
      const double norm   = reaction.norm();
      const double size   = limit > norm ? norm / limit : 1.;
      SmallVector  r      = SmallVector::Zero(n);
      double       cosine = 0;
      if (norm > 0)
        {
          r      = reaction * (size / norm);
          cosine = e.dot(reaction) / norm;
        }
      if (definite)
        {
          const double along  = std::max(cosine, 0.) * size;
          SmallVector  across = r - cosine * size * e;
          const double rest   = 1 - set.ratio;
          const double most   = std::sqrt(rest * (rest + set.ratio * along));
          const double much   = set.ratio * across.norm();
          if (much > most)
            across *= most / much;
          r      = along * e + across;
          cosine = 0;
        }
      const double damping = cosine < 0 ? 1 / (1 - cosine * size) : 1.;
      return set.ratio *
             (SmallMatrix::Identity(n, n) - damping * r * e.transpose());
    }

    /** A gap below 0, which limits and bonds have the values of 0 for: a step
     * goes on along their slopes from there, as if they fell below 0, too. */
    double
    overlap(const SmallVector &v)
    {
      return std::min(v(v.size() - 1), 0.);
    }
  } // namespace

  FrictionLimit
  where_held(const std::function<FrictionLimit(double)> &limit_at,
             const double                                slip,
             const double                                reach)
  {
    constexpr double       gentle = .5, steepest = .8, near = 1e-10;
    constexpr unsigned int most  = 40;
    FrictionLimit          limit = limit_at(slip);
    if (limit.by_slip == 0)
      return limit;
    const bool falls = limit.by_slip < 0;
    double     held = slip, low = 0, high = reach;
    for (unsigned int i = 0; i < most; ++i)
      {
        const double lacks = reach - held - limit.value;
        // It goes on only where friction falls, and never back.
        if (std::abs(lacks) <= near * reach || (falls && !(lacks > 0)))
          break;
        (lacks > 0 ? low : high) = held;
        held += limit.by_slip > -gentle ? lacks / (1 + limit.by_slip) : lacks;
        if (!falls && !(held > low && held < high))
          held = .5 * (low + high);
        limit = limit_at(held);
      }
    if (limit.by_slip < -steepest)
      limit.by_slip = 0;
    limit.value += limit.by_slip * (slip - held);
    return limit;
  }

  LinearizedLaw
  law_of(const NodeSet       &set,
         const FrictionLimit &limit,
         const SmallVector   &v,
         const SmallVector   &r,
         const SmallVector   &along,
         const bool           definite)
  {
    const Index       nt   = v.size() - 1;
    const SmallMatrix zero = SmallMatrix::Zero(nt + 1, nt + 1);
    const SmallMatrix one  = SmallMatrix::Identity(nt + 1, nt + 1);
    if (set.state == NodeState::open)
      return {zero, one, -r};
    // Closed, and stuck as long as nothing else is said.
    LinearizedLaw law{one, zero, -v};
    if (set.is_lifted)
      {
        law.A(nt, nt) = 0;
        law.B(nt, nt) = 1;
        law.h(nt)     = -r(nt);
      }
    if (set.state == NodeState::stick || nt == 0)
      return law;

    // r_t = limit(z_n, |v_t|) e, with all of it linearised
    const double      zn = r(nt) - v(nt);
    const SmallMatrix T  = turning_part(set, limit.value, r.head(nt), definite);
    // With dz = dr - dv, A takes what belongs to dv and B the rest.
    law.A.topLeftCorner(nt, nt) = set.weight * T;
    law.B.topLeftCorner(nt, nt) = SmallMatrix::Identity(nt, nt) - T;
    law.A.topRightCorner(nt, 1) = limit.by_force * set.direction;
    law.B.topRightCorner(nt, 1) = -law.A.topRightCorner(nt, 1);
    if (limit.by_slip != 0)
      law.A.topLeftCorner(nt, nt) -=
        limit.by_slip * set.direction * along.transpose();
    law.A.topRightCorner(nt, 1) -= limit.by_gap * set.direction;
    // A first guess of the states may not go with z: then the law is asked
    // for at the end of the step.
    if (zn > 0 || set.is_lifted)
      law.h.head(nt) =
        (limit.value + limit.by_gap * overlap(v)) * set.direction - r.head(nt);
    else
      law.h.head(nt) = -(law.A.topRows(nt) * v + law.B.topRows(nt) * r);
    return law;
  }

  /* The law is one of v' = S v and r' = r / S with S = diag(a, 1/a, 1), where a
     changes with both: dv' = S dv + S' v da, dr' = dr / S - S' r / S^2 da. */
  void
  see_stretched(const Aspect      &aspect,
                const SmallVector &v,
                const SmallVector &r,
                const SmallVector &along,
                const SmallVector &by_slip,
                LinearizedLaw     &law)
  {
    const Index  nt = v.size() - 1;
    const double a  = aspect.value;
    eigen_assert(a > 0);
    eigen_assert(along.size() == nt);
    if (nt < 2)
      return;
    // how the law changes with a
    SmallVector by_aspect = SmallVector::Zero(nt + 1);
    by_aspect += law.A.col(0) * v(0) - law.A.col(1) * (v(1) / (a * a)) -
                 law.B.col(0) * (r(0) / (a * a)) + law.B.col(1) * r(1);
    // friction goes with the slip itself, which does not change with a
    by_aspect.head(nt) += by_slip * ((along(0) * v(0) - along(1) * v(1)) / a);
    const SmallVector scale = aspect.scale(nt + 1);
    law.A                   = (law.A * scale.asDiagonal()).eval();
    law.B = (law.B * scale.cwiseInverse().asDiagonal()).eval();
    law.A.leftCols(nt) += aspect.by_slip * by_aspect * along.transpose();
    law.A.col(nt) += aspect.by_gap * by_aspect;
    law.h -= aspect.by_gap * overlap(v) * by_aspect;
    law.B.col(nt) += aspect.by_force * by_aspect;
  }

  /* r = seen - b(|v_t|, g): d seen = dr + b_slip e.dv_t + b_gap dg in the
     normal component, and B takes that to the columns of v. An overlap has the
     pull of a closed gap: without its share in h, the steep line along which
     what has opened closes would hold nodes in the overlap. */
  void
  see_bond(const Bond &bond, const SmallVector &v, LinearizedLaw &law)
  {
    const Index  nt   = v.size() - 1;
    const double slip = v.head(nt).norm();
    if (slip > 0)
      law.A.leftCols(nt) +=
        bond.by_slip / slip * law.B.col(nt) * v.head(nt).transpose();
    law.A.col(nt) += bond.by_gap * law.B.col(nt);
    law.h -= bond.by_gap * overlap(v) * law.B.col(nt);
  }

  /* T and C are the derivatives of see(): slips change by C_t dr_t, the gap by
     by_force dr_n and by by_slip along the slip as it is seen, so with shear,
     too. A law with `step` is one of v' = diag(step) v. */
  void
  see_through(const Layer       &layer,
              const SmallVector &step,
              const SmallVector &seen,
              LinearizedLaw     &law)
  {
    const Index  nt   = seen.size() - 1;
    const double slip = seen.head(nt).norm();
    SmallMatrix  T    = SmallMatrix::Identity(nt + 1, nt + 1);
    SmallMatrix  C    = layer.shear * T;
    if (slip > 0)
      T.bottomLeftCorner(1, nt) =
        layer.by_slip / slip * seen.head(nt).transpose();
    C.bottomLeftCorner(1, nt) = layer.shear * T.bottomLeftCorner(1, nt);
    C(nt, nt)                 = layer.by_force;
    law.A                     = (law.A * step.asDiagonal()).eval();
    law.B += law.A * C;
    law.A = (law.A * T).eval();
  }

  void
  append_balance(const LinearRelation  &relation,
                 const Eigen::VectorXd &d,
                 std::vector<NodeLaw>  &laws)
  {
    eigen_assert(d.size() == relation.system().n_unknowns());
    eigen_assert(laws.size() ==
                 static_cast<std::size_t>(relation.system().n_nodes()));
    const SmallMatrix one = SmallMatrix::Ones(1, 1);
    for (Index j = 0; j < relation.system().n_motions; ++j)
      laws.push_back(
        {SmallMatrix::Zero(1, 1),
         one,
         -d.segment(relation.system().n_contact_unknowns() + j, 1)});
  }
} // namespace conetact::solvers
