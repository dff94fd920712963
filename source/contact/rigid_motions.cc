// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/rigid_motions.h"

#include "conetact/base/errors.h"
#include "conetact/contact/null_and_range.h"
#include "conetact/contact/unseen_motions.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /**
     * Amounts that move no node, such as the spin of a straight bar, are no
     * motions: the null space of sum_i R_i^T R_i over the nodes i, where a
     * rotation that a node has as a dof counts 1.
     */
    Eigen::MatrixXd
    moving_nothing(const model::Bodies &bodies,
                   const RigidModes    &motions,
                   const unsigned int   body)
    {
      const bodies::Structure &structure = *bodies.structures[body];
      const Eigen::Index       n         = bodies.dim == 2 ? 3 : 6;
      if (!structure.may_be_mechanism()) // nor is it a bar
        return {n, 0};
      Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(n, n);
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        {
          Eigen::MatrixXd modes(3, n);
          for (unsigned int d = 0; d < 3; ++d)
            {
              Tensor<1, 3> along;
              along[d]     = 1;
              modes.row(d) = motions.row(body, structure.position(i), along);
            }
          moved += modes.transpose() * modes;
          for (unsigned int c = bodies.dim; c < structure.n_components(); ++c)
            if (structure.has_dof(i, c))
              moved(c, c) += 1;
        }
      return split(moved).null;
    }

    /* The sum of (e . R)^T (e . R) over all held directions e: its null space
       are the motions that no support resists. Rotations count in lengths, so
       that its eigenvalues compare. */
    Eigen::MatrixXd
    squares_of_supports(const model::Bodies &bodies,
                        const NodeRules     &rules,
                        const RigidModes    &modes,
                        const Eigen::Index   n_one)
    {
      const Eigen::Index n   = modes.none().size();
      Eigen::MatrixXd    sum = Eigen::MatrixXd::Zero(n, n);
      for (const NodeRule &rule : rules.rules())
        {
          const Eigen::Index first = rule.body * n_one;
          for (const HeldDirection &h : rule.held)
            {
              const Eigen::RowVectorXd e =
                modes.row(rule.body,
                          bodies.structures[rule.body]->position(rule.node),
                          h.direction);
              sum.block(first, first, n_one, n_one) += e.transpose() * e;
            }
          for (const NodeRule::HeldRotation &h : rule.rotations)
            // An amount of 1 moves the rim by 1, and counts as much as a
            // translation.
            sum(first + h.component, first + h.component) += 1;
        }
      return sum;
    }

    Eigen::RowVectorXd
    row_of(const model::Cut &cut, const RigidModes &modes)
    {
      return modes.row(cut.body, modes.centre(cut.body), cut.axis);
    }

    /** A cut that is locked is held along its axis, as if by a support. */
    void
    add_squares_of_cuts(const model::Bodies &bodies,
                        const RigidModes    &modes,
                        Eigen::MatrixXd     &sum)
    {
      for (const model::Cut &cut : bodies.cuts)
        if (cut.opening)
          {
            const Eigen::RowVectorXd e     = row_of(cut, modes);
            const Eigen::Index       first = cut.body * e.size();
            sum.block(first, first, e.size(), e.size()) += e.transpose() * e;
          }
    }

    /** Amounts of cuts that are locked, and of nothing else. */
    RigidModes::Amounts
    locked(const model::Bodies &bodies, const RigidModes &modes)
    {
      RigidModes::Amounts amounts = modes.none();
      for (const model::Cut &cut : bodies.cuts)
        if (cut.opening)
          {
            const Eigen::RowVectorXd e = row_of(cut, modes);
            amounts.segment(cut.body * e.size(), e.size()) =
              *cut.opening * e.transpose();
          }
      return amounts;
    }

    /** Bodies that something may reach besides what they are tied to; tied
     * bodies are asked as one, by the first of them. */
    std::vector<bool>
    reached_bodies(const model::Bodies &bodies, const RigidMotions &motions)
    {
      std::vector<bool> reached(bodies.structures.size(), false);
      for (const pairing::ContactNode &node : bodies.contact_nodes)
        {
          const unsigned int one = motions.first_tied(node.body);
          const unsigned int other =
            node.masters.empty() ? one : motions.first_tied(node.master);
          if (!node.is_tied() || node.masters.empty() || other != one)
            reached[one] = reached[other] = true;
        }
      return reached;
    }

    /** Tells whether ties join a body to others. */
    bool
    is_tied(const unsigned int   body,
            const model::Bodies &bodies,
            const RigidMotions  &motions)
    {
      for (unsigned int b = 0; b < bodies.structures.size(); ++b)
        if (b != body && motions.first_tied(b) == motions.first_tied(body))
          return true;
      return false;
    }

    void
    refuse_loose_bodies(const model::Bodies &bodies,
                        const RigidMotions  &motions)
    {
      const std::vector<bool> reached = reached_bodies(bodies, motions);
      const Eigen::MatrixXd   loose   = motions.free() * motions.unresisted();
      for (Eigen::Index j = 0; j < loose.cols(); ++j)
        if (const RigidModes::Motion m = motions.largest(loose.col(j));
            !reached[motions.first_tied(m.body)])
          throw InputError(
            "Nothing holds " + bodies.called(m.body) + " against moving " +
            describe(m) +
            (is_tied(m.body, bodies, motions) ?
               ": neither it nor what it is tied to has a support or a node "
               "that faces anything else in a Contact. " :
               ": no support, and no node of it faces anything in a Contact. ") +
            (bodies.is_rigid(m.body) ? "Let it be less Free" :
                                       "Add a Support") +
            ", or a Contact; check Boundary ids, Reach and the bodies' "
            "places.");
    }
  } // namespace



  RigidMotions::RigidMotions(const model::Bodies &b,
                             const NodeRules     &r,
                             const ContactPoints &points)
    : RigidModes(b)
    , rules(r)
  {
    find_again(points);
    refuse_loose_bodies(bodies, *this);
  }



  /* Cuts that are locked hold what was free, and all that follows from it
     changes. */
  void
  RigidMotions::find_again(const ContactPoints &points)
  {
    find_held_and_free();
    tie(points);
    find_resisted();
    multiply_free();
    see_contacts(points);
  }



  /* The block H = sum (e . R)^T (e . R) of each body in `held`: its null space
     are the own motions, its pseudo-inverse gives placements. Modes that strain
     a body of revolution, or move nothing, count as held: they are neither. */
  void
  RigidMotions::find_held_and_free()
  {
    const auto  n_bodies = static_cast<Index>(frames.size());
    const Index n        = n_one * n_bodies;
    held                 = squares_of_supports(bodies, rules, *this, n_one);
    for (Index body = 0; body < n_bodies; ++body)
      for (unsigned int k = 0; k < n_one; ++k)
        if (strains(static_cast<unsigned int>(body), k)) // is never moved
          held(body * n_one + k, body * n_one + k) = 1;
    add_squares_of_cuts(bodies, *this, held);
    for (Index body = 0; body < n_bodies; ++body)
      {
        // A spin that moves nothing counts as held, or it would be a motion
        // that no contact sees.
        const Eigen::MatrixXd none =
          moving_nothing(bodies, *this, static_cast<unsigned int>(body));
        held.block(body * n_one, body * n_one, n_one, n_one) +=
          none * none.transpose();
      }
    held_inverse.setZero(n, n);
    own_modes = Eigen::MatrixXd(n, 0);
    own_body.clear();
    for (Index body = 0; body < n_bodies; ++body)
      {
        const Index first = body * n_one;
        // Rank is a matter of each body alone.
        const NullAndRange parts =
          split(held.block(first, first, n_one, n_one));
        held_inverse.block(first, first, n_one, n_one) = parts.pseudo_inverse;
        const Index k                                  = own_modes.cols();
        own_modes.conservativeResize(n, k + parts.null.cols());
        own_modes.rightCols(parts.null.cols()).setZero();
        own_modes.block(first, k, n_one, parts.null.cols()) = parts.null;
        own_body.insert(own_body.end(),
                        static_cast<std::size_t>(parts.null.cols()),
                        static_cast<unsigned int>(body));
      }
  }



  /* All own motions are free, as they are, where nothing is tied. */
  void
  RigidMotions::tie(const ContactPoints &points)
  {
    ties          = RigidTies(bodies, *this, points);
    const Index k = own_modes.cols();
    if (ties.empty())
      {
        free_modes = own_modes;
        free_body  = own_body;
        free_parts = Eigen::MatrixXd::Identity(k, k);
        tied_parts = Eigen::MatrixXd(k, 0);
        return;
      }
    free_body.clear();
    free_parts = tied_parts = Eigen::MatrixXd(k, 0);
    for (const auto &assembly : ties.assemblies())
      find_tied(assembly);
    free_modes = own_modes * free_parts;
  }



  /* Placements fit supports and ties: with the squares T = sum t^T t of ties t
     the pseudo-inverse is that of H + T. Of own motions R_o the null space of
     R_o^T T R_o is free, the range is what ties resist. Locked cuts are none of
     these modes: their amounts are given. */
  void
  RigidMotions::find_tied(const std::vector<unsigned int> &assembly)
  {
    std::vector<Index> modes, own;
    const auto         is_locked = [&](const unsigned int body) {
      return std::any_of(bodies.cuts.begin(),
                         bodies.cuts.end(),
                         [&](const model::Cut &cut) {
                           return cut.opening && cut.body == body;
                         });
    };
    for (const unsigned int body : assembly)
      for (Index k = 0; k < n_one && !is_locked(body); ++k)
        modes.push_back(body * n_one + k);
    for (Index j = 0; j < own_modes.cols(); ++j)
      if (first_tied(own_body[static_cast<std::size_t>(j)]) == assembly.front())
        own.push_back(j);
    const Eigen::MatrixXd gram = ties.squares(assembly.front(), modes);
    // One block of all tied bodies takes the place of theirs: what is
    // prescribed to one of them places the others, too.
    held_inverse(modes, modes) =
      split(Eigen::MatrixXd(held(modes, modes)) + gram).pseudo_inverse;
    const Eigen::MatrixXd R     = own_modes(modes, own);
    const NullAndRange    parts = split(R.transpose() * gram * R);
    const auto append = [&](Eigen::MatrixXd &to, const Eigen::MatrixXd &what) {
      to.conservativeResize(own_modes.cols(), to.cols() + what.cols());
      to.rightCols(what.cols()).setZero();
      to(own, Eigen::lastN(what.cols())) = what;
    };
    append(free_parts, parts.null);
    append(tied_parts, parts.range);
    free_body.insert(free_body.end(),
                     static_cast<std::size_t>(parts.null.cols()),
                     assembly.front());
  }



  /* Free motions are turned so that foundations resist some and do not see the
     others. These are told apart once for all: later on what a foundation does
     not see would be rounding. Only whether, not how strongly, matters here:
     stiffnesses are left out, or soft springs would be taken for none. */
  void
  RigidMotions::find_resisted()
  {
    Eigen::MatrixXd springs = Eigen::MatrixXd::Zero(held.rows(), held.cols());
    if (geometric.size() > 0)
      springs += geometric / geometric.cwiseAbs().maxCoeff();
    for (const bodies::Support &support : bodies.supports)
      if (support.stiffness)
        for (const bodies::SurfaceNode &node : support.surface.nodes)
          if ((*support.stiffness)(node.position) > 0)
            for (const bodies::Support::Held &along :
                 support.directions_at(node))
              {
                const Eigen::RowVectorXd r =
                  row(support.body, node.position, along.direction);
                const Index first = support.body * n_one;
                springs.block(first, first, n_one, n_one) += r.transpose() * r;
              }
    const Index     k      = free_modes.cols();
    Eigen::MatrixXd turned = Eigen::MatrixXd::Identity(k, k);
    loose_motions.clear();
    for (Index begin = 0, n = 0; begin < k; begin += n)
      {
        const auto body = free_body.begin() + begin;
        n               = std::find_if(body,
                         free_body.end(),
                         [&](const unsigned int b) { return b != *body; }) -
            body;
        const Eigen::MatrixXd one   = free_modes.middleCols(begin, n);
        const NullAndRange    parts = split(one.transpose() * springs * one);
        const Index           none  = parts.null.cols();
        // Where all are loose, or none is, motions stay as they are: a turn
        // would only round them.
        if (none > 0 && none < n)
          turned.block(begin, begin, n, n) << parts.null, parts.range;
        for (Index j = 0; j < none; ++j)
          loose_motions.push_back(begin + j);
      }
    free_modes *= turned;
    if (ties.empty())
      own_modes = free_modes;
    else
      free_parts *= turned;
    without_springs =
      Eigen::MatrixXd::Identity(k, k)(Eigen::all, loose_motions);
  }



  /* R^T L R over all nodes and dofs, of one mode of all bodies at a time:
     bodies do not see each other. Least squares (free_in) want this of all of
     them; the products of a rigid body, whose nodes are as many as meet it,
     would weigh by chance and are 1. */
  void
  RigidMotions::multiply_free()
  {
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(held.rows(), held.cols());
    for (std::size_t body = 0; body < frames.size(); ++body)
      if (const Index first = static_cast<Index>(body) * n_one;
          free_modes.cols() > 0)
        gram.block(first, first, n_one, n_one) =
          squares(static_cast<unsigned int>(body));
    // free_in() fits motions to the displacements of all nodes by least
    // squares: here a rigid body counts by its own nodes.
    free_factors.compute(free_modes.transpose() * gram * free_modes);
    for (std::size_t body = 0; body < frames.size(); ++body)
      if (const Index first = static_cast<Index>(body) * n_one;
          bodies.is_rigid(body))
        gram.block(first, first, n_one, n_one).setIdentity();
    free_products = free_modes.transpose() * gram * free_modes;
  }



  /* G = H R, with masters as the other side. */
  void
  RigidMotions::see_contacts(const ContactPoints &points)
  {
    seen_by_contacts.setZero(points.n_unknowns(), free_modes.cols());
    Index i = 0;
    for (const ContactPoint &point : points)
      for (const Tensor<1, 3> &dual : point.dual)
        {
          const pairing::ContactNode &node = *point.node;
          pairing::for_each_side(node,
                                 [&](const unsigned int body,
                                     const unsigned int node_number,
                                     const double       weight) {
                                   seen_by_contacts.row(i) +=
                                     row(body,
                                         bodies.structures[body]->position(
                                           node_number),
                                         bodies.in_frame(body, weight * dual)) *
                                     free_modes.middleRows(body * n_one, n_one);
                                 });
          ++i;
        }
    forget_unseen(seen_by_contacts);
  }



  Eigen::MatrixXd
  RigidMotions::null_space() const
  {
    // Bodies that do not meet have no entries in common.
    const Eigen::SparseMatrix<double> loose  = without_springs.sparseView();
    Eigen::MatrixXd                   result = seen_by_contacts * loose;
    forget_unseen(result);
    return result;
  }



  Eigen::MatrixXd
  RigidMotions::unseen() const
  {
    Eigen::MatrixXd G = seen_by_contacts * without_springs;
    return G.rows() == 0 ? without_springs : without_springs * forget_unseen(G);
  }



  /* (H + T) a = sum (e . R)^T d_e + sum t^T d_t, least squares: a rigid motion
     fits what supports and ties prescribe only if they move as one. What is
     left is deformation. Where a solution is open it is the smallest. */
  RigidMotions::Amounts
  RigidMotions::placement(const double t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    Amounts amounts = locked(bodies, *this);
    // One step of refinement takes out the rounding of long sums.
    for (unsigned int pass = 0; pass < 2; ++pass)
      {
        Amounts right = Amounts::Zero(held.rows());
        for (const NodeRule &rule : rules.rules())
          {
            const Index    first = rule.body * n_one;
            const Point<3> p =
              bodies.structures[rule.body]->position(rule.node);
            for (const HeldDirection &h : rule.held)
              {
                const Eigen::RowVectorXd e = row(rule.body, p, h.direction);
                right.segment(first, n_one) +=
                  (rules.displacement(rule, h, t) -
                   e.dot(amounts.segment(first, n_one))) *
                  e.transpose();
              }
            for (const NodeRule::HeldRotation &h : rule.rotations)
              right[first + h.component] +=
                rules.angle(h, p, t) * frames[rule.body].size -
                amounts[first + h.component];
          }
        ties.add_missing(t, amounts, right);
        // A locked cut does not give way to the others.
        for (const model::Cut &cut : bodies.cuts)
          if (cut.opening)
            right.segment(cut.body * n_one, n_one).setZero();
        amounts += held_inverse * right;
      }
    return amounts;
  }
} // namespace conetact::contact
