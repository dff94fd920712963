// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_node_sets_h
#define conetact_solvers_node_sets_h

#include "conetact/solvers/newton_system.h"

#include <string>
#include <vector>

namespace conetact::solvers
{
  /**
   * What the nodes are taken for in a step of the active set method, read off
   * @f$z = r - v@f$ in the scaled variables of LinearRelation: open where
   * @f$z_n \le 0@f$, stick where @f$|z_t| \le \mu z_n@f$, else slip along z_t
   * with @f$r_t = \mu z_n z_t/|z_t|@f$ (Alart and Curnier, Comput. Methods
   * Appl. Mech. Engrg. 92 (1991) 353-375), and the law linearised there. Points
   * are (p, d) as in LinearRelation.
   */
  struct NodeSet
  {
    NodeState state = NodeState::open;
    /** Open, but friction that needs no pressure sticks or slips as said. */
    bool        is_lifted = false;
    SmallVector direction; ///< unit, of z_t; zero without friction
    double      ratio = 0; ///< mu z_n / |z_t|, at most 1
    /** Of the slip in z_t: more than 1 where a given slip would not show. */
    double weight = 1;
  };
  using NodeSets = std::vector<NodeSet>;

  /** From the states of the last increment; all stick if there are none. */
  NodeSets
  sets_of_state(const LinearRelation &relation, const ContactState &state);

  NodeSets
  sets_of_point(const LinearRelation  &relation,
                const Eigen::VectorXd &p,
                const Eigen::VectorXd &d);

  /** Laws of the motions: their imbalance is to vanish. */
  void
  append_balance(const LinearRelation  &relation,
                 const Eigen::VectorXd &d,
                 std::vector<NodeLaw>  &laws);

  /**
   * Laws of all nodes, then of all motions. `definite`: what turns slips far
   * from the solution leaves linear systems positive definite, but for the
   * coupling with normal forces, as iterations for them want it. Friction that
   * varies with the slip has the slopes of where_held(), or its `own_slopes`.
   */
  std::vector<NodeLaw>
  linearized_laws(const LinearRelation  &relation,
                  const NodeSets        &sets,
                  const Eigen::VectorXd &p,
                  const Eigen::VectorXd &d,
                  const bool             definite   = false,
                  const bool             own_slopes = false);

  /** Norm of r - P(z) and of the imbalance, over the scale of forces. */
  double
  law_residual(const LinearRelation  &relation,
               const Eigen::VectorXd &p,
               const Eigen::VectorXd &d);

  /**
   * How far friction is from pointing against the slips, over the largest
   * reaction of a node: law_residual() hardly sees the direction of short ones.
   * Slips that are `rounding` over that reaction have none.
   */
  double
  askew_friction(const LinearRelation  &relation,
                 const NodeSets        &sets,
                 const Eigen::VectorXd &p,
                 const Eigen::VectorXd &d,
                 const double           rounding);

  /** Writes the zeros of the sets into p and d: they hold but for round-off. */
  void
  set_exact_zeros(const LinearRelation &relation,
                  const NodeSets       &sets,
                  Eigen::VectorXd      &p,
                  Eigen::VectorXd      &d);

  /** The same with nodes that slip against friction stuck. */
  NodeSets
  without_slip(const LinearRelation &relation, NodeSets sets);

  /** The same with that one stuck which takes most friction of reactions r. */
  NodeSets
  with_strongest_stuck(const LinearRelation  &relation,
                       NodeSets               sets,
                       const Eigen::VectorXd &r);

  /** The same with that one stuck which first turns to slip along its friction
   * on the way from displacements `before` to `after`, if there is one. */
  NodeSets
  with_first_turned_stuck(const LinearRelation  &relation,
                          NodeSets               sets,
                          const Eigen::VectorXd &before,
                          const Eigen::VectorXd &after);

  /** Whether closed gaps, stuck slips and slips that turn resist all motions
   * that nothing else resists. */
  bool
  resist_motions(const ContactSystem &system, const NodeSets &sets);

  /** States, and signs of slip in 2D: what makes two steps the same. */
  std::string
  signature(const NodeSets &sets);
} // namespace conetact::solvers

#endif
