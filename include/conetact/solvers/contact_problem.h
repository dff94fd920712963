// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_contact_problem_h
#define conetact_solvers_contact_problem_h

#include "conetact/solvers/nodal_laws.h"

#include <Eigen/Dense>

#include <memory>
#include <string>
#include <vector>

namespace conetact::solvers
{
  class LargeSystem;

  /**
   * One load increment of frictional contact as plain numbers, [K] (17) with
   * the signs of the errata corrected.
   *
   * The unknowns of contact node i are its tangential slips of this increment
   * and its **new** gap, @f$v_i = (\Delta u_t, g)@f$, and the **total** new
   * reaction on the body @f$r_i = (r_t, r_n)@f$, at the indices
   * `first[i], ..., first[i+1]-1` of all vectors: tangential ones (none, one
   * or two), then the normal one. They obey
   * @f[ r_n \ge 0,\quad g \ge 0,\quad r_n g = 0,\qquad
   *     |r_t| \le \mu r_n,\quad
   *     \Delta u_t \ne 0 \Rightarrow r_t = -\mu r_n \Delta u_t/|\Delta u_t| @f]
   * and one linear relation, in one of two forms:
   * - stiffness: @f$K u = r + f@f$ with @f$v = u + o@f$, K symmetric and
   *   positive semidefinite (singular for mechanisms), f in force units. The
   *   offset o is what moves the nodes without strain: gaps, rigid parts of
   *   the motion of supports and obstacles, less the slip so far;
   * - compliance: @f$v = W r + G a + q,\ C a - G^T r - b = 0@f$, W positive
   *   semidefinite (singular for rigid bodies and redundant contacts), q in
   *   length units. The columns of G are the rigid motions that supports leave
   *   free, a their amounts and the second equation the balance of forces on
   *   them, C the stiffness of foundations against them. Balance is an
   *   equation of its own: in a stiffness, rounding would carry it.
   *
   * Motions stand behind the contact unknowns, like nodes with one unknown
   * each whose "reaction" is a and whose "displacement", the imbalance, is
   * zero: matrix @f$\begin{pmatrix} W & G\\ -G^T & C\end{pmatrix}@f$, load
   * (q, -b), r and v of a ContactState (r, a) and (v, imbalance).
   *
   * Systems that are too large for a matrix of their contact unknowns stand in
   * the stiffness form, but with all their unknowns, of which those of contact
   * are the last: K is that of a LargeSystem, f and u are a process's own
   * numbers of it.
   *
   * Any consistent units will do; no solver may depend on their choice.
   */
  enum class Form
  {
    stiffness,
    compliance
  };

  /** What stays the same over all increments: matrix, layout, friction. */
  struct ContactSystem
  {
    Form            form = Form::stiffness;
    Eigen::MatrixXd matrix; ///< K [force/length] or W [length/force], n x n

    /** n_c + n_motions + 1 offsets, first[0] = 0. */
    std::vector<Eigen::Index> first = {0};
    Eigen::VectorXd           mu;            ///< n_c friction coefficients >= 0
    Eigen::Index              n_motions = 0; ///< compliance form only

    /**
     * Columns span the motions of the contact unknowns that no stiffness
     * resists (n x k), as far as whoever filled the system knows them: floating
     * bodies.
     */
    Eigen::MatrixXd null_space;

    /** What stands in place of the matrix, if anything. */
    std::shared_ptr<const LargeSystem> large;
    Eigen::VectorXd large_diagonal; ///< of its contact unknowns

    /** That of the matrix. */
    Eigen::VectorXd
    diagonal() const
    {
      return large ? large_diagonal : Eigen::VectorXd(matrix.diagonal());
    }

    Eigen::Index
    n_nodes() const
    {
      return static_cast<Eigen::Index>(first.size()) - 1 - n_motions;
    }
    /** Of nodes and motions. */
    Eigen::Index
    n_unknowns() const
    {
      return first.back();
    }
    Eigen::Index
    n_contact_unknowns() const
    {
      return n_unknowns() - n_motions;
    }
    /** Number of tangential unknowns of node i: 0, 1 or 2. */
    Eigen::Index
    n_tangents(const Eigen::Index i) const
    {
      return first[i + 1] - first[i] - 1;
    }
    /** Index of the normal unknown of node i. */
    Eigen::Index
    normal(const Eigen::Index i) const
    {
      return first[i + 1] - 1;
    }
  };

  /** The data of one increment. Its laws are those beyond the system's
   * coefficients. */
  struct ContactProblem : WithLaws
  {
    std::shared_ptr<const ContactSystem> system;

    Eigen::VectorXd load; ///< f [force], or q [length] and -b, n values
    Eigen::VectorXd gap;  ///< gap g >= 0 at the start of the increment [length]
    /** o of the stiffness form [length]; empty: zero. */
    Eigen::VectorXd offset;

    /**
     * Largest nodal force of the load history so far [force]: loads that have
     * almost vanished are judged against it, not against themselves. 0 if the
     * problem stands alone.
     */
    double reference_force = 0;
  };

  enum class NodeState : unsigned char
  {
    open,  ///< r_n = 0
    stick, ///< r_n > 0, slip = 0
    slip   ///< r_n > 0, slip != 0
  };

  /**
   * Solution of an increment. On entry to a solver it is the state at the
   * start of the increment, with v = (0, gap): a reaction to start from, and
   * (if `node` is not empty) the states of the last increment as a warm start.
   */
  struct ContactState
  {
    Eigen::VectorXd        v;    ///< (slip of the increment, new gap) [length]
    Eigen::VectorXd        r;    ///< total reaction on the body [force]
    std::vector<NodeState> node; ///< one a node; empty: cold start
    /**
     * u of the stiffness form [length], which v = u + o knows only to the
     * rounding of o; empty: v - o. Not used where there is no offset. Of large
     * systems: a process's own numbers.
     */
    Eigen::VectorXd u = {};
    /** On entry: u near the end of the increment, where that is known. Of large
     * systems only. */
    Eigen::VectorXd nearby = {};
  };

  /** Of node i at this reaction, with its bond, and slip and gap. */
  FrictionLimit
  friction_limit(const ContactProblem &problem,
                 const Eigen::Index    i,
                 const double          r_n,
                 const double          slip,
                 const double          gap = 0);

  /** What is mu of node i in a state: the limit of friction over r_n. */
  double
  friction_coefficient(const ContactProblem &problem,
                       const ContactState   &state,
                       const Eigen::Index    i);

  /**
   * Displacements of all contact unknowns as the law of contact sees them: with
   * what layers give way by.
   */
  Eigen::VectorXd
  seen_by_law(const ContactProblem  &problem,
              const Eigen::VectorXd &v,
              const Eigen::VectorXd &r);

  /** The same problem with the coefficients of a state, which do not vary;
   * layers join the compliance as far as they are linear. */
  ContactProblem
  with_coefficients_of(const ContactState   &state,
                       const ContactProblem &problem);

  /** u, whether the state has it or not. */
  Eigen::VectorXd
  elastic_part(const ContactProblem &problem, const ContactState &state);

  /** What a solver says of itself. No solver is believed: see
   * contact_residual(). */
  struct SolverReport
  {
    bool         converged = false;
    std::string  reason;             ///< why not, a sentence; empty on success
    std::string  solver;             ///< name of the method that succeeded
    unsigned int iterations     = 0; ///< linear solves
    unsigned int factorizations = 0; ///< of matrices of contact unknowns
    unsigned int krylov         = 0; ///< iterations in the linear solves
    unsigned int substeps       = 1; ///< parts the increment was cut into
    double       residual       = 0; ///< contact_residual() of the result
  };

  /** Counts the work of a part, too. */
  void
  add_work(SolverReport &total, const SolverReport &part);
  /** Why an iteration gives up: "residual stalled at 1.2e-07". */
  std::string
  stalled(const double residual);

  /** Largest magnitude of the entries, 0 without any. */
  double
  largest(const Eigen::VectorXd &x);

  /**
   * Rounding of a displacement over the sizes of the positions it is the
   * difference of: sums of a few terms.
   */
  constexpr double position_rounding = 16 * 2.2e-16;

  /**
   * Slips times stiffness over the reaction: the law holds with any factor, and
   * what is beyond this would only round reactions.
   */
  constexpr double longest_slip = 1e4;

  /** Entries of x as far as they exceed what is allowed, one for one. */
  Eigen::VectorXd
  without_rounding(const Eigen::VectorXd &x, const Eigen::VectorXd &allowed);

  /** The system's matrix times x. */
  Eigen::VectorXd
  multiply(const ContactSystem &system, const Eigen::VectorXd &x);

  /**
   * The measure of solvers, outside all of them and free of units: with
   * @f$\rho_i = tr K_{ii} / dim@f$ (compliance: dim / tr W_ii),
   * @f[ e = |r - P_C(r - \rho (\Delta u_t, g + \mu |\Delta u_t|))| /
   *         \max(|r|, |f|, f_{ref}) , @f]
   * or the residual of the linear relation over the same scale, whichever is
   * larger; in compliance form the balance b takes the place of f. P_C projects
   * on the friction cones. Only forces make the scale: displacements grow with
   * the error where nothing holds a body. Reactions do where no solution
   * exists: the error over the data alone (loads, and given displacements times
   * @f$\rho@f$) counts 1e-4 of itself at least. What is less than the rounding
   * of the positions that a displacement is the difference of is no error.
   */
  double
  contact_residual(const ContactProblem &problem, const ContactState &state);

  /** The two complementarity errors of [K] 5.3 (force x length units). */
  struct KannoErrors
  {
    double err1 = 0; ///< x.y / (1 + x.y)
    double err2 = 0; ///< x.(Mx+q) / (1 + x.y)
  };
  KannoErrors
  kanno_errors(const ContactProblem &problem, const ContactState &state);

  /**
   * States read off a converged solution: open where r_n = 0, slip where the
   * slip exceeds `tolerance` times the largest displacement, else stick.
   */
  std::vector<NodeState>
  classify(const ContactProblem &problem,
           const ContactState   &state,
           const double          tolerance = 1e-12);
} // namespace conetact::solvers

#endif
