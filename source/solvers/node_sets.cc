// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/node_sets.h"

#include "conetact/solvers/linearized_law.h"
#include "conetact/solvers/seen_node.h"

#include <algorithm>
#include <cmath>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    std::size_t
    at(const Index i)
    {
      return static_cast<std::size_t>(i);
    }

    /** Its limit where its friction is followed to the slip that it leads to.
     */
    FrictionLimit
    held_limit(const LinearRelation &relation,
               const Index           i,
               const double          s,
               const Seen           &seen)
    {
      const Index nt = seen.v.size() - 1;
      return where_held(
        [&](const double slip) {
          return relation.limit(i, s, slip, seen.gap());
        },
        seen.slip(),
        (seen.r - seen.v).head(nt).norm());
    }

    /** Whether node i, pressed by s, has friction without slip: what has none
     * never sticks. */
    bool
    holds_at_rest(const LinearRelation &relation, const Index i, const double s)
    {
      return relation.has_cones() ||
             relation.limit(i, std::max(s, 0.), 0, 0).value > 0;
    }

    /** So much of a short slip that z_t is well outside of the limit. */
    double
    weight_of_slip(const Seen &seen, const double limit)
    {
      const Index nt = seen.v.size() - 1;
      return (seen.forces().head(nt).norm() + 2 * limit) /
             seen.slips().head(nt).norm();
    }

    /**
     * Slip as the last increment left it. Its size is not known if the
     * increment is new: then half of z_t is taken for slip.
     */
    NodeSet
    slip_of_state(const SmallVector &slip,
                  const SmallVector &reaction,
                  const double       limit)
    {
      NodeSet           set;
      const SmallVector z    = reaction - slip;
      const double      norm = z.norm();
      set.state              = NodeState::stick;
      set.direction          = SmallVector::Zero(slip.size());
      if (norm == 0)
        return set;
      set.state     = NodeState::slip;
      set.direction = z / norm;
      set.ratio     = .5;
      if (slip.norm() > 0)
        set.ratio = std::min(1., std::max(0., limit) / norm);
      return set;
    }

    /** Whether neither reactions nor motions move tangent k of node i at all,
     * and no layer gives way along it. */
    bool
    is_fixed(const LinearRelation &relation, const Index i, const Index k)
    {
      const Eigen::MatrixXd &W = relation.system().matrix;
      const Index            j = relation.system().first[i] + k;
      return !relation.stiffness() && W(j, j) == 0 && W.row(j).isZero(0) &&
             !(relation.has_layers() && relation.layer(i, 0, 0).shear > 0);
    }

    /**
     * What can neither deform nor move sticks with any reaction: it keeps the
     * one it has.
     */
    void
    keep_reactions_of_fixed(const LinearRelation &relation,
                            const Index           i,
                            NodeLaw              &law)
    {
      for (Index k = 0; k + 1 < law.h.size(); ++k)
        if (is_fixed(relation, i, k))
          {
            law.p.row(k).setZero();
            law.d.row(k).setZero();
            law.p(k, k) = 1;
            law.h(k)    = 0;
          }
    }

    /** A slip is given if it is so many times the rounding of the largest
     * displacement: 4e-11 of it. */
    constexpr double roundings_of_slip = 1e4;

    /** Whether node i has a slip that no reaction changes: it must slip. What
     * is `least` or less comes of how loads are reduced. */
    bool
    is_dragged(const LinearRelation &relation,
               const Index           i,
               const SmallVector    &v,
               const double          least)
    {
      for (Index k = 0; k + 1 < v.size(); ++k)
        if (std::abs(v(k)) > least && is_fixed(relation, i, k))
          return true;
      return false;
    }

    /** True of a node in space that slips along a known direction, whose
     * friction turns with the slip. */
    bool
    turns(const NodeSet &set)
    {
      return set.state == NodeState::slip && set.direction.size() == 2 &&
             set.direction != SmallVector::Zero(2);
    }
  } // namespace

  NodeSets
  sets_of_state(const LinearRelation &relation, const ContactState &state)
  {
    eigen_assert(state.node.empty() ||
                 state.node.size() == at(relation.system().n_nodes()));
    const ContactSystem &system = relation.system();
    NodeSets             sets(at(system.n_nodes()));
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        NodeSet    &set   = sets[at(i)];
        const Index first = system.first[i], nt = system.n_tangents(i);
        set.state = state.node.empty() ? NodeState::stick : state.node[at(i)];
        set.direction = SmallVector::Zero(nt);
        if (relation.is_joined(i))
          set.state = NodeState::stick;
        if (relation.is_apart(i))
          set.state = NodeState::open;
        if (set.state == NodeState::open || nt == 0 || relation.is_joined(i))
          continue;
        // Without friction what is closed slips; stuck it would take shear.
        if (is_frictionless(relation, i))
          set.state = NodeState::slip;
        else if (set.state == NodeState::slip)
          {
            const SmallVector slip = relation.step(i).along *
                                     state.v.segment(first, nt) /
                                     relation.unit_of_length(i);
            const SmallVector r =
              state.r.segment(first, nt + 1) / relation.unit_of_force(i);
            const SmallVector scale =
              relation.aspect(i, r(nt), slip.norm(), 0).scale(nt + 1).head(nt);
            set = slip_of_state(scale.cwiseProduct(slip),
                                r.head(nt).cwiseQuotient(scale),
                                relation.limit(i, r(nt), slip.norm(), 0).value);
          }
      }
    return sets;
  }

  /* A bond adds to z_n and gives friction a limit without pressure: a node with
     z_n <= 0 is lifted then, and sticks or slips all the same. */
  NodeSets
  sets_of_point(const LinearRelation &relation,
                const VectorXd       &p,
                const VectorXd       &d)
  {
    eigen_assert(p.size() == d.size());
    const ContactSystem &system = relation.system();
    const Fields         x(relation, p, d);
    const double least_slip = roundings_of_slip * largest(relation.rounding(p));
    NodeSets     sets(at(system.n_nodes()));
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index nt = system.n_tangents(i);
        const Seen  seen(relation, i, x);
        SmallVector z   = seen.forces() - seen.slips();
        NodeSet    &set = sets[at(i)];
        set.direction   = SmallVector::Zero(nt);
        if (relation.is_joined(i))
          set.state = NodeState::stick;
        if (relation.is_joined(i) || relation.is_apart(i) ||
            (!(z(nt) > 0) && !relation.is_bonded(i)))
          continue;
        const double limit =
          limit_at(relation, i, std::max(z(nt), 0.), seen.v).value;
        if (limit > 0 && z.head(nt).norm() <= limit &&
            is_dragged(
              relation, i, seen.v, least_slip * relation.step(i).along))
          {
            set.weight = weight_of_slip(seen, limit);
            z.head(nt) =
              seen.forces().head(nt) - set.weight * seen.slips().head(nt);
          }
        const double norm = z.head(nt).norm();
        set.is_lifted     = !(z(nt) > 0);
        if (set.is_lifted && !(limit > 0))
          continue;
        set.state = NodeState::stick;
        if (nt == 0 ||
            (norm <= limit && limit > 0 && holds_at_rest(relation, i, z(nt))))
          continue;
        set.state = NodeState::slip;
        if (limit > 0 && norm > 0)
          {
            set.direction = z.head(nt) / norm;
            set.ratio     = std::min(1., limit / norm);
          }
      }
    return sets;
  }

  /* The chain rule, from the inside out: law_of() is linear in stretched slips
     and forces, which see_stretched() turns into those of the ellipse,
     see_bond() into reactions without their bond, see_through() into
     displacements of the bodies without their layer. */
  std::vector<NodeLaw>
  linearized_laws(const LinearRelation &relation,
                  const NodeSets       &sets,
                  const VectorXd       &p,
                  const VectorXd       &d,
                  const bool            definite,
                  const bool            own_slopes)
  {
    eigen_assert(p.size() == d.size());
    const ContactSystem &system = relation.system();
    const Fields         x(relation, p, d);
    std::vector<NodeLaw> result(sets.size());
    result.reserve(sets.size() + at(system.n_motions));
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index        dim = system.n_tangents(i) + 1;
        const Seen         seen(relation, i, x);
        const SmallVector &v = seen.v, &r = seen.r;
        const double       zn = r(dim - 1) - v(dim - 1), slip = seen.slip();
        // States that are open or stick say what v and r are, stretched or not.
        const bool is_stretched = relation.has_ellipses() && turns(sets[at(i)]);
        const bool is_own       = own_slopes || relation.has_cones() ||
                            relation.has_ellipses() ||
                            sets[at(i)].state != NodeState::slip;
        const auto    limit = is_own ? limit_at(relation, i, zn, v) :
                                       held_limit(relation, i, zn, seen);
        LinearizedLaw law =
          law_of(sets[at(i)],
                 limit,
                 is_stretched ? seen.slips() : v,
                 is_stretched ? seen.forces() : r,
                 is_stretched ?
                   seen.along().cwiseQuotient(seen.scale.head(dim - 1)) :
                 slip > 0 || limit.by_slip <= 0 ?
                   seen.along() :
                   SmallVector(-sets[at(i)].direction),
                 definite);
        if (is_stretched)
          see_stretched(seen.aspect,
                        v,
                        r,
                        seen.along(),
                        limit.by_slip * sets[at(i)].direction,
                        law);
        if (relation.is_bonded(i))
          see_bond(relation.bond(i, slip, seen.gap()), v, law);
        if (const Step step = relation.step(i); relation.has_layers())
          see_through(relation.layer(i, r(dim - 1), slip / step.along),
                      step.of(dim),
                      v,
                      law);
        result[at(i)].p = relation.stiffness() ? law.A : law.B;
        result[at(i)].d = relation.stiffness() ? law.B : law.A;
        result[at(i)].h = law.h;
        if (sets[at(i)].state == NodeState::stick)
          keep_reactions_of_fixed(relation, i, result[at(i)]);
      }
    append_balance(relation, d, result);
    return result;
  }

  void
  set_exact_zeros(const LinearRelation &relation,
                  const NodeSets       &sets,
                  VectorXd             &p,
                  VectorXd             &d)
  {
    eigen_assert(p.size() == d.size());
    const ContactSystem &system = relation.system();
    VectorXd            &r      = relation.stiffness() ? d : p;
    const VectorXd       v =
      relation.has_bonds() ? Fields(relation, p, d).v : VectorXd();
    const auto stop = [&](const Index first, const Index size) {
      // v = p + o in stiffness form
      if (relation.stiffness())
        p.segment(first, size) = -relation.offset().segment(first, size);
      else
        d.segment(first, size).setZero();
    };
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const Index     first = system.first[i], nt = system.n_tangents(i);
        const NodeState node = sets[at(i)].state;
        if (node != NodeState::open && relation.has_layers() &&
            !relation.layer(i, r(first + nt), 0).is_none())
          continue; // Zero is v with its layer, not v itself.
        if (sets[at(i)].is_lifted ||
            (relation.is_bonded(i) && node == NodeState::open &&
             relation
                 .bond(i,
                       v.segment(first, nt).norm(),
                       std::max(v(first + nt), 0.))
                 .value != 0))
          continue; // Zero is r with its bond, not r itself.
        if (node == NodeState::open)
          r.segment(first, nt + 1).setZero();
        else
          stop(first + nt, 1);
        if (node == NodeState::stick)
          stop(first, nt);
        if (node == NodeState::slip && is_frictionless(relation, i))
          r.segment(first, nt).setZero();
      }
  }
} // namespace conetact::solvers
