// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_kinematics_h
#define conetact_pairing_kinematics_h

#include "conetact/pairing/contact_nodes.h"

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace conetact::pairing
{
  /** How far the sides of a contact may move along each other. */
  enum class Kinematics
  {
    automatic,      ///< small, until that is found to be wrong
    finite_sliding, ///< as far as they like: it is found again and again
    small           ///< gaps and normals are those of the undeformed bodies
  };

  /** What a contact is to have, and what it needs. */
  struct ContactKinematics
  {
    Kinematics asked = Kinematics::automatic;
    /** Why small kinematics is wrong for it, and why finite sliding is not for
     * it, parts of sentences; empty: it is right, it can be. */
    std::string why_finite, why_not_finite;
    /** Why its sides are no planes, a part of a sentence; empty: they are. */
    std::string why_not_plane;

    bool
    slides() const
    {
      return asked != Kinematics::small && !why_finite.empty() &&
             why_not_finite.empty();
    }
    /** Whether normals may turn: sides are curved, or something turns. */
    bool
    may_tilt() const
    {
      return !why_not_plane.empty() || !why_finite.empty();
    }
    /** Whether it is small by choice, and may be finite sliding. */
    bool
    may_slide() const
    {
      return asked == Kinematics::automatic && why_not_finite.empty();
    }
  };

  void
  declare_kinematics(dealii::ParameterHandler &prm);
  Kinematics
  read_kinematics(const dealii::ParameterHandler &prm);

  /** Why a contact by itself cannot slide far, a sentence without its full
   * stop; empty: it can. */
  std::string
  why_not_sliding(const Contact                                &contact,
                  const std::vector<const bodies::Structure *> &structures);
} // namespace conetact::pairing

#endif
