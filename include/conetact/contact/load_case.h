// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_load_case_h
#define conetact_contact_load_case_h

#include "conetact/contact/increment_laws.h"

#include <Eigen/Core>

#include <memory>

namespace conetact::contact
{
  /** A load case, seen by the contact unknowns. */
  struct LoadCase
  {
    Eigen::VectorXd prescribed; ///< deformation that supports give, all dofs;
                                ///< empty: none [length]
    bool
    deforms() const
    {
      return prescribed.size() > 0;
    }
    /** Its forces on the elastic unknowns [force]; of a large system f has
     * them. */
    Eigen::VectorXd b;
    /**
     * Load of a ContactProblem in total terms: f [force] in stiffness form, q
     * [length] and -b [force] in compliance form.
     */
    Eigen::VectorXd f;
    /** Elastic displacements, where nothing may touch [length]. */
    Eigen::VectorXd q;
    /** What ties and bilateral contacts see of it, as BoundUnknowns has it. */
    Eigen::VectorXd bound;
    /**
     * What moves all contact unknowns without strain: placements of bodies by
     * their supports less the motion of obstacles [length].
     */
    Eigen::VectorXd offset;
    Eigen::VectorXd placement; ///< amounts of RigidMotions
    /** Laws of contacts that have some of their own; else none. */
    std::shared_ptr<const IncrementLaws> laws;
  };
} // namespace conetact::contact

#endif
