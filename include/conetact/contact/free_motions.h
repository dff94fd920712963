// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_free_motions_h
#define conetact_contact_free_motions_h

#include "conetact/contact/condensed_bodies.h"
#include "conetact/contact/rigid_motions.h"

#include <Eigen/SparseCore>

namespace conetact::contact
{
  /**
   * Motions that bodies have by themselves, and the foundations that resist
   * them: R in own unknowns, forces K_s R, and what these deform, Y = -P K_s R
   * (CondensedCompliance).
   */
  class FreeMotions
  {
  public:
    using Index    = Eigen::Index;
    using VectorXd = Eigen::VectorXd;
    using MatrixXd = Eigen::MatrixXd;

    /** References must outlive the object; R and K_s R are known then. */
    FreeMotions(const ElasticSystem   &elastic,
                const RigidMotions    &motions,
                const BodyCoordinates &own);

    /** Motions are other ones. */
    void
    find();
    /** Bodies answer foundations: Y. */
    void
    respond(const CondensedBodies &bodies);

    /** R of a body, columns. */
    const MatrixXd &
    of_body(const unsigned int body) const
    {
      return all[body].R;
    }
    /** First motion of rigid bodies, which have no own unknowns. */
    Index
    first_rigid() const
    {
      return n_of_elastic;
    }
    /** Adds G = H (R + Y) and C of elastic bodies to (W G; -G^T C), of which
     * motions have the last rows. */
    void
    add_to(const Eigen::SparseMatrix<double> &H, MatrixXd &relation) const;
    /** -(R + Y)^T f: forces on own unknowns against the motions, and what they
     * deform against foundations. */
    VectorXd
    imbalance(const VectorXd &forces) const;
    /** The same of forces on all dofs, of rigid bodies. */
    VectorXd
    rigid_imbalance(const VectorXd &forces) const;
    /** Sums of magnitudes of the terms of an imbalance. */
    VectorXd
    size_of_terms(const VectorXd &forces) const;
    /** R^T f of elastic bodies. */
    VectorXd
    resultants(const VectorXd &forces) const;
    /** Forces on own unknowns by which foundations resist amounts. */
    VectorXd
    resistance(const VectorXd &amounts) const;

  private:
    struct OfBody
    {
      Index    first = 0; ///< among all motions
      MatrixXd R, spring_forces, Y;
    };
    /** A value for each motion of elastic bodies, by their forces. */
    template <typename Value>
    VectorXd
    against(const VectorXd &forces, const Value &value) const;

    const ElasticSystem   &elastic;
    const RigidMotions    &motions;
    const BodyCoordinates &own;
    std::vector<OfBody>    all; ///< of each body
    Index                  n_of_elastic = 0;
  };

  /**
   * Amounts of all modes in R a + w: `amounts` and what w moves bodies by that
   * supports leave free, by least squares over the nodes of each. Solvers part
   * a displacement into motions and deformations as suits them; this does not
   * depend on how.
   */
  RigidMotions::Amounts
  motions_with(const RigidMotions    &motions,
               RigidMotions::Amounts  amounts,
               const Eigen::VectorXd &w);
} // namespace conetact::contact

#endif
