// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_seen_node_h
#define conetact_solvers_seen_node_h

#include "conetact/solvers/linear_relation.h"

#include <algorithm>

namespace conetact::solvers
{
  /** Displacements, as the law sees them, and reactions of a point, whichever
   * is p. Reactions are p or d themselves, or a member: no copy may refer to
   * the member of another. */
  class Fields
  {
  public:
    Fields(const LinearRelation  &relation,
           const Eigen::VectorXd &p,
           const Eigen::VectorXd &d)
      : v(relation.displacements(p, d))
      , r(relation.has_bonds() ? bonded : relation.reactions(p, d))
    {
      if (relation.has_layers())
        relation.add_layers(relation.reactions(p, d), v);
      if (relation.has_bonds())
        bonded = relation.add_bonds(relation.reactions(p, d), v);
    }
    Fields(const Fields &) = delete;

  private:
    Eigen::VectorXd bonded;

  public:
    Eigen::VectorXd        v;
    const Eigen::VectorXd &r;
  };

  /** The limit of friction of node i at v, as the law sees it, pressed by s.
   */
  inline FrictionLimit
  limit_at(const LinearRelation &relation,
           const Eigen::Index    i,
           const double          s,
           const SmallVector    &v)
  {
    const Eigen::Index nt = v.size() - 1;
    return relation.limit(i, s, v.head(nt).norm(), std::max(v(nt), 0.));
  }

  /** A node of a point as the law sees it, and what stretches it to where its
   * limit of friction is a circle. */
  struct Seen
  {
    Seen(const LinearRelation &relation, const Eigen::Index i, const Fields &x)
      : v(x.v.segment(relation.system().first[i],
                      relation.system().n_tangents(i) + 1))
      , r(x.r.segment(relation.system().first[i], v.size()))
      , aspect(relation.aspect(i, r(v.size() - 1), slip(), gap()))
      , scale(aspect.scale(v.size()))
    {}

    double
    slip() const
    {
      return v.head(v.size() - 1).norm();
    }
    double
    gap() const
    {
      return std::max(v(v.size() - 1), 0.);
    }
    /** How the slip grows with v_t. */
    SmallVector
    along() const
    {
      const double length = slip();
      SmallVector  e      = v.head(v.size() - 1);
      return length > 0 ? SmallVector(e / length) :
                          SmallVector(SmallVector::Zero(e.size()));
    }
    SmallVector
    slips() const
    {
      return scale.cwiseProduct(v);
    }
    SmallVector
    forces() const
    {
      return r.cwiseQuotient(scale);
    }

    SmallVector v, r;
    Aspect      aspect;
    SmallVector scale; ///< of slips
  };
} // namespace conetact::solvers

#endif
