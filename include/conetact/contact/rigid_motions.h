// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_rigid_motions_h
#define conetact_contact_rigid_motions_h

#include "conetact/contact/coordinates.h"

#include <string>

namespace conetact
{
  /**
   * Small rigid motions of the bodies that no support resists, as seen by the
   * contact nodes: the null space of the condensed stiffness. Nothing of size
   * other than the number of contact unknowns and six a body is formed.
   */
  class RigidMotions
  {
  public:
    /**
     * Throws InputError if a body can move rigidly although all contact
     * unknowns stand still: nothing would hold it.
     */
    RigidMotions(const Bodies      &bodies,
                 const NodeRules   &rules,
                 const Coordinates &coordinates);

    /** Columns span the free motions in the contact unknowns. */
    const Eigen::MatrixXd &
    null_space() const
    {
      return contact_part;
    }

    /** A rigid motion of one body: u(x) = translation + rotation x (x - x0). */
    struct Motion
    {
      unsigned int body;
      Point<3>     centre;
      Tensor<1, 3> translation;
      Tensor<1, 3> rotation; ///< [1/length] of the translation's unit
      double       size;     ///< of the body [length]
    };
    /**
     * The body that moves most in a combination of the columns of
     * null_space(), and how.
     */
    Motion
    motion(const Eigen::VectorXd &combination) const;

  private:
    Motion
    largest(const Eigen::VectorXd &modes) const;

    const Bodies       &bodies;
    std::vector<Motion> frames;       ///< of each body, without motion
    Eigen::MatrixXd     free_modes;   ///< columns: modes of all bodies
    Eigen::MatrixXd     contact_part; ///< the same seen by the contacts
  };

  /** "along (1, 0, 0)", "about (0, 0, 1)", "along ... and about ...". */
  std::string
  describe(const RigidMotions::Motion &motion);
} // namespace conetact

#endif
