// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_path_scheme_h
#define conetact_load_path_path_scheme_h

#include "conetact/solvers/contact_problem.h"

#include <vector>

namespace conetact::load_path
{
  /**
   * Working schemes of a 2D contact problem and the linear systems they stand
   * for. With the states of all nodes fixed, contact is linear,
   * @f[ K v = r + f, \quad
   *     r_n = 0 \text{ or } g = 0, \quad
   *     r_t = -s (\mu r_n + c) \text{ or } u_t = const , @f]
   * and only the gaps of open nodes and the tangential displacements of
   * slipping ones are unknown.
   */
  struct NodeScheme
  {
    bool closed = false; ///< g = 0, else r_n = 0
    int  slip   = 0;     ///< 0: u_t is held; s = +-1: r_t = -s (mu r_n + c)

    bool
    operator==(const NodeScheme &other) const
    {
      return closed == other.closed && slip == other.slip;
    }
  };
  using Scheme = std::vector<NodeScheme>;

  /**
   * The contact system without length and force: displacements are divided by
   * @f$1/\sqrt{c_i}@f$, forces by @f$\sqrt{c_i}@f$, c_i the mean diagonal entry
   * of K at node i. Both then have the unit of the root of an energy, and the
   * law of friction keeps its form.
   */
  struct PathSystem
  {
    using Index  = Eigen::Index;
    using Vector = Eigen::VectorXd;

    /** Throws std::invalid_argument for compliance form or two tangents. */
    PathSystem(const solvers::ContactSystem &system, const Vector &cohesion);

    Index
    n_nodes() const
    {
      return mu.size();
    }
    Index
    size() const
    {
      return scale.size();
    }
    /** r_t = 0 whatever happens: no friction, or open without cohesion. */
    bool
    is_free(const Index i, const bool closed) const
    {
      return cohesion(i) == 0 && (mu(i) == 0 || !closed);
    }

    std::vector<Index> normal, tangent; ///< indices; tangent -1: has none
    Vector             scale;           ///< v = scale * (scaled v)
    Vector             mu, cohesion;
    Eigen::MatrixXd    K;
    Eigen::MatrixXd    null_space; ///< of K, orthonormal

    /** K + shift * null_space * null_space^T: rigid motions held softly. */
    static constexpr double shift = 1e-9;
    Eigen::MatrixXd         held;
  };

  /** The LU factors of a scheme; K may be that with rigid motions held. */
  class SchemeFactor
  {
  public:
    using Index  = Eigen::Index;
    using Vector = Eigen::VectorXd;

    SchemeFactor() = default;
    SchemeFactor(const PathSystem &system,
                 const Scheme     &scheme,
                 const bool        held);

    /** False if the scheme is a mechanism, to round-off. */
    bool
    regular() const
    {
      return is_regular;
    }

    /**
     * Rates (v, r) for rates of the loads. Where the scheme is a mechanism that
     * these loads drive (or are in balance with) see is_driven().
     */
    void
    rates(const Vector &load_rate, Vector &v, Vector &r) const;

    /**
     * Do the loads drive a mechanism? Rates v are then those on the soft
     * springs of PathSystem::held; the mechanism is what they show.
     */
    bool
    is_driven(const Vector &load_rate, const Vector &v) const;

    /** The part of v that is a motion of the mechanism. */
    Vector
    motion(const Vector &v) const
    {
      return motions * (coordinates * v);
    }

    /**
     * Displacements and reactions of the scheme under the loads. v comes in
     * with the held values where they are held, and any estimate elsewhere.
     */
    void
    values(const Vector &load, Vector &v, Vector &r) const;

    /**
     * Displacements v that follow where the held unknowns `columns` move by 1,
     * and the reactions r; without loads.
     */
    void
    responses(const std::vector<Index> &columns,
              Eigen::MatrixXd          &v,
              Eigen::MatrixXd          &r) const;

  private:
    void
    collect_unknowns();
    void
    factorize();
    void
    find_motions();
    /** Imbalances of all unknowns in, corrections of v out. */
    void
    solve(const Eigen::MatrixXd &imbalance, Eigen::MatrixXd &v) const;
    /** Sets reactions that the scheme gives. */
    void
    clean(Eigen::MatrixXd &r, const bool with_cohesion) const;

    const PathSystem      *system = nullptr;
    const Eigen::MatrixXd *K      = nullptr;
    Scheme                 scheme;
    std::vector<Index>     unknown;
    std::vector<Index>     normal; ///< added with `weight`, or -1
    std::vector<double>    weight; ///< s mu
    Eigen::MatrixXd        factor;
    std::vector<int>       pivots;
    bool                   is_regular = false;
    Eigen::MatrixXd        motions;     ///< of a mechanism, held softly
    Eigen::MatrixXd        coordinates; ///< v -> its share of the motions
  };
} // namespace conetact::load_path

#endif
