// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_linearized_law_h
#define conetact_solvers_linearized_law_h

#include "conetact/solvers/nodal_laws.h"

#include <functional>

namespace conetact::solvers
{
  struct NodeSet;

  /** @f$A\,\delta v + B\,\delta r = h@f$ of one node, in the scaled variables
   * of LinearRelation. */
  struct LinearizedLaw
  {
    SmallMatrix A, B;
    SmallVector h;
  };

  /**
   * The tangent of a limit of friction at the slip where a node that nothing
   * else holds would come to rest, in scaled variables: held + limit(held) =
   * reach. Where friction changes with the slip faster than bodies resist, the
   * tangent at the present slip leads the wrong way, or next to nowhere.
   * Neighbours give way, too, so that a node resists by less than its own
   * stiffness, 1: a tangent that falls nearly as steeply counts as a friction
   * that does not fall.
   */
  FrictionLimit
  where_held(const std::function<FrictionLimit(double)> &limit_at,
             const double                                slip,
             const double                                reach);

  /** Of a node whose limit of friction is a circle; `along` is how its slip
   * grows with v_t. `definite` as in linearized_laws(). */
  LinearizedLaw
  law_of(const NodeSet       &set,
         const FrictionLimit &limit,
         const SmallVector   &v,
         const SmallVector   &r,
         const SmallVector   &along,
         const bool           definite);

  /** A law of stretched reactions and slips as one of (v, r), which are not;
   * `along` is how the slip grows with v_t, `by_slip` how friction does with
   * the slip. */
  void
  see_stretched(const Aspect      &aspect,
                const SmallVector &v,
                const SmallVector &r,
                const SmallVector &along,
                const SmallVector &by_slip,
                LinearizedLaw     &law);

  /** A law of r + bond as one of r itself. */
  void
  see_bond(const Bond &bond, const SmallVector &v, LinearizedLaw &law);

  /** A law of what is seen as one of v itself: dv' = diag(step) (T dv + C dr).
   */
  void
  see_through(const Layer       &layer,
              const SmallVector &step,
              const SmallVector &seen,
              LinearizedLaw     &law);
} // namespace conetact::solvers

#endif
