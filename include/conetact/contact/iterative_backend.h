// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_iterative_backend_h
#define conetact_contact_iterative_backend_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_backend.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/rigid_motions.h"

namespace conetact::contact
{
  /**
   * The elastic system with all its unknowns, for solvers of LargeSystem: what
   * is too large to be condensed. Loads are those of all unknowns, and so is
   * what is primal. Nodes that face a master have the displacement relative to
   * it as unknowns.
   */
  class IterativeBackend : public ElasticBackend
  {
  public:
    /** Arguments must outlive the object. */
    IterativeBackend(const ElasticSystem &elastic,
                     const NodeRules     &supports,
                     const ContactPoints &points,
                     const RigidMotions  &motions);

    /** Of a load on all unknowns against each of the motions that nothing
     * resists. */
    Eigen::VectorXd
    resultants(const Eigen::VectorXd &load) const;

    /**
     * Whether contact nodes have the axes and face the nodes that they had when
     * it was made: gaps alone may have changed since (finite sliding).
     */
    bool
    fits_contacts() const
    {
      return describe_contacts() == contacts;
    }
    /** Displacements of all dofs by unknowns, which may be those of contacts
     * that were there before. */
    Eigen::VectorXd
    displacements_of(const Eigen::VectorXd &values) const
    {
      return coordinates.expand(values);
    }
    /** The unknowns of such displacements. */
    Eigen::VectorXd
    values_of(const Eigen::VectorXd &u) const
    {
      return coordinates.values(u);
    }
    /** Amounts of the free motions in displacements by unknowns, least
     * squares. */
    Eigen::VectorXd
    motions_in(const Eigen::VectorXd &values) const;
    /** The unknowns of such amounts. */
    Eigen::VectorXd
    values_of_motions(const Eigen::VectorXd &a) const;
    /** Forces on all unknowns by which foundations resist them. */
    Eigen::VectorXd
    resistance(const Eigen::VectorXd &a) const;

    Eigen::MatrixXd
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const override;
    LoadCase
    reduce_unbalanced(const Eigen::VectorXd &unbalanced) const override;
    Eigen::VectorXd
    correction(const LoadCase        &change,
               const Eigen::VectorXd &primal) const override;
    void
    move_bound(const Eigen::VectorXd &offset, LoadCase &load) const override;
    BoundState
    bound_state(const LoadCase        &load,
                const Eigen::VectorXd &primal) const override;
    Eigen::VectorXd
    bound_stiffness() const override
    {
      return stiffness_of_bound;
    }

  protected:
    void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) override;
    LoadCase
    nothing() const override;
    Eigen::VectorXd
    reduce_forces(const Eigen::VectorXd &b) const override
    {
      return b;
    }

  private:
    /** Directions of contact nodes in the frames of both sides, and weights of
     * their masters: numbers one behind the other. */
    std::vector<double>
    describe_contacts() const;
    /** All unknowns of a load case and its primal. */
    Eigen::VectorXd
    unknowns(const LoadCase &load, const Eigen::VectorXd &primal) const;
    /** Displacements of all dofs by those of what is bound. */
    Eigen::VectorXd
    expand_bound(const Eigen::VectorXd &v) const;
    /** Forces on all dofs, as what is bound sees them. */
    Eigen::VectorXd
    restrict_bound(const Eigen::VectorXd &forces) const;
    /** From the diagonal of K, of all dofs. */
    void
    find_stiffness_of_bound(const Eigen::VectorXd &diagonal);
    /** Where nothing opposes a motion the shortest one is taken. */
    Eigen::VectorXd
    without_motion(const Eigen::VectorXd &w) const;

    const ElasticSystem      &elastic;
    const ContactPoints      &points;
    const RigidMotions       &motions;
    const Coordinates         coordinates;
    const Eigen::MatrixXd     nowhere; ///< motions that nothing resists
    const Eigen::Index        n_bound;
    const std::vector<double> contacts; ///< as they were when it was made
    Eigen::VectorXd           stiffness_of_bound;
  };
} // namespace conetact::contact

#endif
