// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_rigid_motions_h
#define conetact_contact_rigid_motions_h

#include "conetact/contact/coordinates.h"

#include <Eigen/Cholesky>

#include <map>
#include <string>
#include <vector>

namespace conetact::contact
{
  /**
   * Small rigid motions of the bodies, in closed form: displacements are kept
   * as @f$u = R a + w@f$, a rigid motion R a of each body and a deformation w,
   * since K R = 0 holds exactly only where nobody computes it. What supports
   * prescribe gives each body its placement; motions that no rigid support
   * resists are its free motions, unknowns with a balance of their own.
   * Amounts are lengths: rotations move the rim of a body by about 1.
   *
   * Bodies that are tied (ContactPoints) are placed together, and are free to
   * move together only. By itself each of them has its own motions: those of
   * them that the others resist are the tied ones.
   */
  class RigidMotions
  {
  public:
    /**
     * Throws InputError where a body that no contact can reach is not held.
     * What is given must outlive the object.
     */
    RigidMotions(const Bodies        &bodies,
                 const NodeRules     &rules,
                 const ContactPoints &points,
                 const Coordinates   &coordinates);

    /** A cut was locked: fewer motions are free. */
    void
    find_again(const ContactPoints &points);

    /** Contacts were found again: what they see of free motions. */
    void
    see_contacts(const ContactPoints &points);

    /** Amounts of all modes of all bodies, 3 a body in 2D, 6 in 3D. */
    using Amounts = Eigen::VectorXd;

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
    /** Amounts of no motion. */
    Amounts
    none() const
    {
      return Amounts::Zero(held.rows());
    }
    /** Displacements of all dofs of all bodies. */
    Eigen::VectorXd
    field(const Amounts &amounts) const;
    /** R^T f: forces on all dofs against all modes. */
    Amounts
    resultants(const Eigen::VectorXd &forces) const;
    /** Amounts of the free motions in displacements of all dofs, least squares
     * over all nodes. */
    Eigen::VectorXd
    free_in(const Eigen::VectorXd &u) const
    {
      return free_factors.solve(free_modes.transpose() * resultants(u));
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
    /** Displacement at a node of a body. */
    Tensor<1, 3>
    at(const Amounts     &amounts,
       const unsigned int body,
       const unsigned int node) const;
    /** A rigid motion of one body: u(x) = translation + rotation x (x - x0). */
    struct Motion
    {
      unsigned int body;
      bool         axisymmetric; ///< moves along y only
      Point<3>     centre;
      Tensor<1, 3> translation;
      Tensor<1, 3> rotation; ///< [1/length] of the translation's unit
      double       size;     ///< of the body [length]
    };
    /** What amounts do to a body. */
    Motion
    of_body(const Amounts &amounts, const unsigned int body) const;
    /** The axis about which the motion turns a body, times the angle [rad]. */
    Tensor<1, 3>
    turn(const Amounts &amounts, const unsigned int body) const
    {
      return of_body(amounts, body).rotation;
    }
    /** How far that is [rad]. */
    double
    rotation(const Amounts &amounts, const unsigned int body) const
    {
      return turn(amounts, body).norm();
    }
    /** Distance of a body's nodes from its centre, at most [length]. */
    double
    size(const unsigned int body) const
    {
      return frames[body].size;
    }

    /** That of the largest body. */
    double
    largest_size() const;

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
      return tied_with[body];
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
    /** Those as the contact unknowns see them; zero where by rounding only. */
    Eigen::MatrixXd
    null_space() const;
    /**
     * Combinations of free motions that neither foundations nor contacts with
     * all their unknowns resist; orthonormal columns.
     */
    Eigen::MatrixXd
    unseen() const;

    /**
     * The body that moves most in a combination of the columns of
     * null_space(), and how.
     */
    Motion
    motion(const Eigen::VectorXd &combination) const;
    /** The same of a combination of the free motions. */
    Motion
    motion_of_free(const Eigen::VectorXd &a) const
    {
      return largest(free_modes * a);
    }

  private:
    using Index = Eigen::Index;

    Motion
    largest(const Amounts &amounts) const;
    void
    find_held_and_free();
    void
    hold_locked();
    /** Of cuts that are locked, and of nothing else. */
    Amounts
    locked() const;
    void
    tie(const ContactPoints &points);
    void
    find_assemblies();
    void
    find_tied(const std::vector<unsigned int> &assembly);
    void
    find_resisted();
    void
    multiply_free();
    void
    refuse_loose_bodies() const;
    /** direction . R at p, the modes of a body. */
    Eigen::RowVectorXd
    row(const unsigned int  body,
        const Point<3>     &p,
        const Tensor<1, 3> &direction) const;
    /** An equation that binds a node to its opponent. */
    struct Tie
    {
      const pairing::ContactNode                *node;
      Tensor<1, 3>                               direction;
      std::map<unsigned int, Eigen::RowVectorXd> rows; ///< of bodies' modes
    };
    Tie
    make_tie(const pairing::ContactNode &node,
             const Tensor<1, 3>         &direction) const;
    /** Displacement relative to the opponent, along its direction. */
    double
    relative(const Tie &tied, const Amounts &amounts) const;
    void
    add(const double factor, const Tie &tied, Amounts &sum) const;

    const Bodies             &bodies;
    const NodeRules          &rules;
    std::vector<Motion>       frames; ///< of each body, without motion
    std::vector<Index>        offset; ///< first dof of each body
    Index                     n_one;  ///< modes of a body
    Eigen::MatrixXd           held;   ///< sum of row^T row over held directions
    Eigen::MatrixXd           held_inverse; ///< pseudo-inverse of it
    Eigen::MatrixXd           own_modes, free_modes;
    std::vector<unsigned int> own_body, free_body;
    Eigen::MatrixXd           free_parts, tied_parts;
    Eigen::MatrixXd           free_products;
    Eigen::LDLT<Eigen::MatrixXd> free_factors; ///< of these
    std::vector<unsigned int>    tied_with;
    std::vector<Tie>             ties;
    std::vector<Eigen::Index>    loose_motions;
    Eigen::MatrixXd              without_springs; ///< selects these
    Eigen::MatrixXd              seen_by_contacts;
  };

  /** "along (1, 0, 0)", "about (0, 0, 1)", "along ... and about ...". */
  std::string
  describe(const RigidMotions::Motion &motion);
} // namespace conetact::contact

#endif
