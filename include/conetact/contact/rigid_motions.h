// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_rigid_motions_h
#define conetact_contact_rigid_motions_h

#include "conetact/contact/node_rules.h"
#include "conetact/contact/rigid_modes.h"
#include "conetact/contact/rigid_ties.h"

#include <Eigen/Cholesky>

#include <utility>
#include <vector>

namespace conetact::contact
{
  /**
   * Rigid motions of the bodies, held and free: displacements are kept as
   * @f$u = R a + w@f$, a rigid motion R a of each body and a deformation w,
   * since K R = 0 holds exactly only where nobody computes it. What supports
   * prescribe gives each body its placement; motions that no rigid support
   * resists are its free motions, unknowns with a balance of their own.
   * Amounts are lengths: rotations move the rim of a body by about 1.
   *
   * Bodies that are tied (ContactPoints) are placed together, and are free to
   * move together only. By itself each of them has its own motions: those of
   * them that the others resist are the tied ones.
   */
  class RigidMotions : public RigidModes
  {
  public:
    /**
     * Throws InputError where a body that no contact can reach is not held.
     * What is given must outlive the object.
     */
    RigidMotions(const model::Bodies &bodies,
                 const NodeRules     &rules,
                 const ContactPoints &points);

    /** A cut was locked: fewer motions are free. */
    void
    find_again(const ContactPoints &points);

    /**
     * How forces resist turns, in modes of all bodies (geometric_stiffness());
     * empty: not at all. Motions are those that it leaves after find_again().
     */
    void
    set_geometric(Eigen::MatrixXd of_modes)
    {
      geometric = std::move(of_modes);
    }
    bool
    has_geometric() const
    {
      return geometric.size() > 0;
    }
    /** By what forces it resists the free motions in amounts of all modes. */
    Eigen::VectorXd
    geometric_forces(const Amounts &amounts) const
    {
      return free_modes.transpose() * (geometric * amounts);
    }
    /** The stiffness that own motions have by it: ties take no part. */
    Eigen::MatrixXd
    geometric_of_own() const
    {
      return free_parts * (free_modes.transpose() * geometric * free_modes) *
             free_parts.transpose();
    }

    /** Contacts were found again: what they see of free motions. */
    void
    see_contacts(const ContactPoints &points);

    /**
     * Rigid motions nearest to what supports prescribe at time t, the smallest
     * of them where they leave some open.
     */
    Amounts
    placement(const double t) const;
    /** The amounts of all modes from those of the free motions. */
    Amounts
    of_free(const Eigen::VectorXd &a) const
    {
      return free_modes * a;
    }
    /** Amounts of the free motions in displacements of all dofs, least squares
     * over all nodes. */
    Eigen::VectorXd
    free_in(const Eigen::VectorXd &u) const
    {
      return free_factors.solve(free_modes.transpose() * products(u));
    }
    /**
     * Products of the free motions with each other: those of their fields; of a
     * free obstacle, whose nodes are as many as meet it, those of its amounts.
     */
    const Eigen::MatrixXd &
    products_of_free() const
    {
      return free_products;
    }
    Eigen::Index
    n_free() const
    {
      return free_modes.cols();
    }
    /** The body of each free motion, of tied bodies the first. */
    const std::vector<unsigned int> &
    body_of_free() const
    {
      return free_body;
    }
    /** The first of the bodies that a body is tied with. */
    unsigned int
    first_tied(const unsigned int body) const
    {
      return ties.first_of(body);
    }
    /** Free motions of each body as if it were not tied. */
    const Eigen::MatrixXd &
    own() const
    {
      return own_modes;
    }
    /** The body of each of them. */
    const std::vector<unsigned int> &
    body_of_own() const
    {
      return own_body;
    }
    /** The free motions as combinations of own ones; orthonormal. */
    const Eigen::MatrixXd &
    free_of_own() const
    {
      return free_parts;
    }
    /** The rest of the own ones, which ties resist; orthonormal. */
    const Eigen::MatrixXd &
    tied_of_own() const
    {
      return tied_parts;
    }
    /** Columns: free motions in the modes of all bodies. */
    const Eigen::MatrixXd &
    free() const
    {
      return free_modes;
    }
    /** G: the free motions as contact unknowns see them. */
    const Eigen::MatrixXd &
    seen() const
    {
      return seen_by_contacts;
    }
    /** Numbers of the free motions that no foundation resists either. */
    const std::vector<Eigen::Index> &
    loose() const
    {
      return loose_motions;
    }
    /** The same as a selection of columns. */
    const Eigen::MatrixXd &
    unresisted() const
    {
      return without_springs;
    }
    /** Loose motions as the contact unknowns see them; zero where by rounding
     * only. */
    Eigen::MatrixXd
    null_space() const;
    /**
     * Combinations of free motions that neither foundations nor contacts with
     * all their unknowns resist; orthonormal columns.
     */
    Eigen::MatrixXd
    unseen() const;

  private:
    using Index = Eigen::Index;

    void
    find_held_and_free();
    void
    tie(const ContactPoints &points);
    void
    find_tied(const std::vector<unsigned int> &assembly);
    void
    find_resisted();
    void
    multiply_free();

    const NodeRules          &rules;
    Eigen::MatrixXd           geometric; ///< of all modes, or empty
    Eigen::MatrixXd           held; ///< sum of row^T row over held directions
    Eigen::MatrixXd           held_inverse; ///< pseudo-inverse of it
    Eigen::MatrixXd           own_modes, free_modes;
    std::vector<unsigned int> own_body, free_body;
    Eigen::MatrixXd           free_parts, tied_parts;
    Eigen::MatrixXd           free_products;
    Eigen::LDLT<Eigen::MatrixXd> free_factors; ///< of these
    RigidTies                    ties;
    std::vector<Eigen::Index>    loose_motions;
    Eigen::MatrixXd              without_springs; ///< selects these
    Eigen::MatrixXd              seen_by_contacts;
  };
} // namespace conetact::contact

#endif
