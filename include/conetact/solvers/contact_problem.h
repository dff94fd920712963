// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_contact_problem_h
#define conetact_solvers_contact_problem_h

#include <Eigen/Dense>

#include <memory>
#include <string>
#include <vector>

namespace conetact
{
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
   * - stiffness: @f$K v = r + f@f$, K symmetric and positive semidefinite
   *   (singular for floating bodies), f in force units;
   * - compliance: @f$v = W r + q@f$, W symmetric and positive semidefinite
   *   (singular for rigid bodies and redundant contacts), q in length units.
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

    std::vector<Eigen::Index> first = {0}; ///< n_c + 1 offsets, first[0] = 0
    Eigen::VectorXd           mu;          ///< n_c friction coefficients >= 0

    /**
     * Columns span the null space of K (n x k), as far as whoever filled the
     * system knows it: floating bodies. Ignored in compliance form.
     */
    Eigen::MatrixXd null_space;

    Eigen::Index
    n_nodes() const
    {
      return static_cast<Eigen::Index>(first.size()) - 1;
    }
    Eigen::Index
    n_unknowns() const
    {
      return first.back();
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

  /** The data of one increment. */
  struct ContactProblem
  {
    std::shared_ptr<const ContactSystem> system;

    Eigen::VectorXd load; ///< f [force] or q [length], n values
    Eigen::VectorXd gap;  ///< gap g >= 0 at the start of the increment [length]

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
  };

  /** What a solver says of itself. No solver is believed: see residual(). */
  struct SolverReport
  {
    bool         converged = false;
    std::string  reason;             ///< why not, a sentence; empty on success
    std::string  solver;             ///< name of the method that succeeded
    unsigned int iterations     = 0; ///< linear solves
    unsigned int factorizations = 0; ///< of matrices of contact unknowns
    unsigned int substeps       = 1; ///< parts the increment was cut into
    double       residual       = 0; ///< contact_residual() of the result
  };

  /** Largest magnitude of the entries, 0 without any. */
  double
  largest(const Eigen::VectorXd &x);

  /**
   * The measure of every result, outside all solvers and free of units: with
   * @f$\rho = tr K / n@f$ (compliance: n / tr W),
   * @f[ e = |r - P_C(r - \rho (\Delta u_t, g + \mu |\Delta u_t|))| /
   *         \max(|r|, \rho |v|, \rho |g_0|, f_{ref}) , @f]
   * or the residual of the linear relation over the same scale, whichever is
   * larger. P_C projects on the friction cones. Zero for the zero solution of
   * a problem without load. Where v or r run away along a null space, as they
   * do if there is no solution, they would hide any error behind their size:
   * 1e-4 of the error over the data (load, gaps, f_ref) is a lower bound.
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
} // namespace conetact

#endif
