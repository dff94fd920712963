// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_rate_lcp_h
#define conetact_load_path_rate_lcp_h

#include "conetact/load_path/path_scheme.h"

#include <vector>

namespace conetact::load_path
{
  /** What is undecided at a node. */
  struct CriticalNode
  {
    bool normal = false; ///< g = r_n = 0
    bool plus   = false; ///< may slip along +t or stick
    bool minus  = false; ///< may slip along -t or stick

    bool
    any() const
    {
      return normal || plus || minus;
    }
  };
  using CriticalNodes = std::vector<CriticalNode>;

  /** A gap or a slip whose rate is to be found. */
  struct RatePair
  {
    std::size_t  node;
    int          side;   ///< 0: gap, else slip along +t or -t
    Eigen::Index column; ///< of the unknown that may move
  };

  /**
   * The rates of critical nodes as a linear complementarity problem. From all
   * of them closed and stuck, z are the rates of gaps and slips that set in, x
   * those of normal reactions and reserves of friction; by superposition
   * @f[ x = M z + q\,p' , \qquad 0 \le z \perp x \ge 0 . @f]
   * Rigid motions are held softly, see PathSystem::held.
   */
  struct RateLcp
  {
    using Matrix = Eigen::MatrixXd;
    using Vector = Eigen::VectorXd;

    RateLcp(const PathSystem    &system,
            const Scheme        &scheme,
            const CriticalNodes &critical,
            const Vector        &load_rate);

    /**
     * Lemke's method from the covering vector. False: nothing follows from the
     * problem, or it has no solution on that way.
     */
    bool
    solve(Vector &z, Scheme &result) const;
    /** The scheme in which these pairs move: z may be positive, x is zero. */
    Scheme
    scheme(const std::vector<bool> &moves) const;

    /** Rates of displacements and reactions of all nodes. */
    Vector
    displacements(const Vector &z, const double p) const;
    Vector
    reactions(const Vector &z, const double p) const;

    std::vector<RatePair> pairs;
    Scheme                base;            ///< critical nodes closed and stuck
    bool                  regular = false; ///< else nothing follows from it

    Matrix          M;
    Vector          q, cover; ///< cover: tightens all contacts, for solve_lcp()
    Eigen::VectorXi rank;

  private:
    std::vector<Eigen::Index>
    close_and_stick(const PathSystem &system, const CriticalNodes &critical);
    void
    superpose(const PathSystem &system);
    Vector
    in_columns(const Vector &z) const;

    Matrix V, R; ///< rates where an unknown moves by 1
    Vector v, r; ///< rates of the loads
  };
} // namespace conetact::load_path

#endif
