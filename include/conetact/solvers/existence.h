// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_existence_h
#define conetact_solvers_existence_h

#include "conetact/solvers/contact_problem.h"
#include "conetact/solvers/reach.h"

#include <Eigen/Dense>

#include <functional>
#include <optional>
#include <vector>

namespace conetact::solvers
{
  /** What a body does that nothing holds. */
  enum class Motion
  {
    none,      ///< the load can be held, as far as this check can tell
    lifts_off, ///< all contacts of what moves open
    slides,    ///< the contacts that stay touching move by one translation
    /// all contacts stay touching and slip in different directions, or the
    /// motion of the proof opens them alike
    turns,
    tips ///< rotation about contacts that stay, the others open
  };

  /** Result of ExistenceCheck. */
  struct Existence
  {
    bool admissible = true;

    /** @f$\min_r |R^T (r + f)|@f$ [force], R orthonormal. */
    double distance = 0;

    /**
     * The proof, if not admissible: v = R w, largest entry 1, with K v = 0,
     * @f$v_n \ge \mu |v_t|@f$ and @f$f \cdot v > 0@f$. Of all such motions it
     * is the one that sets in first on the way from the start to the load.
     */
    Eigen::VectorXd           w, v;
    Motion                    motion = Motion::none;
    std::vector<Eigen::Index> moving; ///< nodes of the bodies that move
    std::vector<Eigen::Index> tight;  ///< moving nodes that slide: v_n = mu
                                      ///< |v_t|, or little more at all of them

    /** Largest s in [0, 1] with f_start + s (f - f_start) admissible. */
    double fraction = 1;

    /**
     * The least common factor of all friction coefficients (and the largest
     * coefficient then) with which the load is admissible. No value where no
     * friction helps. Without any friction as it is, the coefficient is the
     * one of all nodes.
     */
    std::optional<double> friction_factor, friction_needed;
  };

  /**
   * Whether reactions in the friction cones C can balance a load on the null
   * space R of K (floating bodies, mechanisms): with R orthonormal,
   * @f[ z = R^T (r + f), \quad |z| \to \min \text{ over } r \in C . @f]
   * If the minimum is not zero, v = R z is a proof that no equilibrium exists:
   * K v = 0, @f$v_n \ge \mu |v_t|@f$ and @f$f \cdot v = |z|^2 > 0@f$; the load
   * drives a motion that no reaction resists. The check is necessary, not
   * sufficient: Coulomb friction is not associated and the proof dilates; it is
   * exact where all contact normals are equal. It refuses only with a proof in
   * hand. Works with forces in any unit.
   */
  class ExistenceCheck
  {
  public:
    /** Columns t1, [t2,] n of a contact node in global coordinates. */
    using Frame = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>;

    /**
     * Takes the null space from system.null_space (any basis; nothing to do
     * without one). The frames only serve to tell a
     * translation from a rotation; without them they are taken as all equal.
     */
    explicit ExistenceCheck(std::shared_ptr<const ContactSystem> system,
                            std::vector<Frame>                   frames = {});

    /**
     * `load` and `start` are f at the end and at the start of the increment
     * (start: any f with the same rigid resultants, e.g. minus the reactions
     * in equilibrium there; zero if nothing has happened yet).
     * `reference_force` is that of ContactProblem: what is less than 1e-12 of
     * it is round-off. With `gap`, one of each node at the start, the friction
     * that would be needed is that of the nodes that touch as they stand, if
     * these can hold the load.
     */
    Existence
    check(const Eigen::VectorXd &load,
          const Eigen::VectorXd &start,
          const double           reference_force = 0,
          const Eigen::VectorXd &gap             = {}) const;

    /** What the nodes bear where these are their reactions. */
    using HoldingAt = std::function<Holding(const Eigen::VectorXd &r)>;
    /** The same by the coefficients of a system. */
    static Holding
    holding_of_cones(const ContactSystem &system, const Eigen::VectorXd &r);

    /**
     * The same of a load that reactions in the cones could balance but those
     * of the contact law do not: `last` are the reactions under the largest
     * part of the load that was solved. With what they allow, the rest
     * of the load drives a motion at once where the limit is near; its
     * fraction is that part. Admissible: something else has failed.
     */
    Existence
    limit_state(const Eigen::VectorXd &load,
                const Eigen::VectorXd &start,
                const Eigen::VectorXd &last,
                const HoldingAt       &holding) const;

    /**
     * Whether so much `more` of the increment's load than `last` bears cannot
     * be balanced with what reactions allow, though normal reactions go on to
     * change as they have since the start, whose reactions are minus `start`.
     * Where that is little, it is a limit; unlike limit_state() it holds where
     * normal reactions grow with the load.
     */
    bool
    is_limit(const Eigen::VectorXd &load,
             const Eigen::VectorXd &start,
             const Eigen::VectorXd &last,
             const HoldingAt       &holding,
             const double           more) const;

    /** The orthonormal basis R in use, n x k. */
    const Eigen::MatrixXd &
    basis() const
    {
      return R;
    }

  private:
    Reach
    reach(const Eigen::VectorXd &c, const Eigen::VectorXd &mu) const;
    bool
    proves(const Eigen::VectorXd &w, const Eigen::VectorXd &c) const;
    Eigen::VectorXd
    sharpen(const Eigen::VectorXd &z) const;
    double
    limit(const Eigen::VectorXd &from,
          const Eigen::VectorXd &to,
          Eigen::VectorXd       &w) const;
    void
    find_needed_friction(const Eigen::MatrixXd &motions,
                         const Eigen::VectorXd &c,
                         Existence             &result) const;
    Eigen::MatrixXd
    motions_of_touching(const Eigen::VectorXd &gap) const;
    Eigen::VectorXd
    even_pressure(const double force) const;
    void
    name_motion(Existence &result) const;
    /** Moving nodes that lift by no more than their friction and `little` of
     * their slip. */
    std::vector<Eigen::Index>
    tight_nodes(const Existence &result, const double little) const;
    bool
    stays_flat(const Existence &result) const;
    std::vector<Eigen::Index>
    moving_nodes(const Eigen::VectorXd &v) const;
    bool
    is_mostly_translation(const Eigen::VectorXd           &v,
                          const std::vector<Eigen::Index> &nodes) const;
    bool
    is_translation(const Eigen::VectorXd           &v,
                   const std::vector<Eigen::Index> &nodes) const;

    std::shared_ptr<const ContactSystem> system;
    std::vector<Frame>                   frames;
    Eigen::MatrixXd                      R;
  };
} // namespace conetact::solvers

#endif
