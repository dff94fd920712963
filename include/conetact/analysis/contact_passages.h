// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_contact_passages_h
#define conetact_analysis_contact_passages_h

#include "conetact/contact/contact_model.h"
#include "conetact/pairing/sliding.h"

#include <string>
#include <vector>

namespace conetact::analysis
{
  /** Bodies and their contacts where an increment begins. */
  struct ContactStart
  {
    Eigen::VectorXd                   u; ///< displacements of all dofs; or none
    double                            t = 0;
    std::vector<pairing::RigidMotion> frames; ///< of bodies
    std::vector<pairing::ContactNode> nodes;
    pairing::SlidingContacts::Entries inside; ///< nodes in other bodies
  };

  /** Whether both sides of a contact see each other at time t. */
  inline bool
  is_active(const pairing::Contact &contact, const double t)
  {
    return !contact.active || (*contact.active)(Point<3>(), t) != 0;
  }

  /** Looks at the way from the start of an increment to its end, on which
   * bodies and obstacles may pass through each other. */
  class ContactPassages
  {
  public:
    /** Both must outlive the object. */
    ContactPassages(const pairing::SlidingContacts &contacts,
                    const contact::ContactModel    &model);

    /**
     * Whether an obstacle or a body passes through another body on the way to
     * displacements u at time t, a sentence; empty: none does. Where the
     * increment may be cut, what may only have gone round an edge is doubted,
     * too. `inside` becomes what is in other bodies at the end.
     */
    std::string
    pass_through(const ContactStart                &start,
                 const Eigen::VectorXd             &u,
                 const double                       t,
                 const bool                         may_be_cut,
                 pairing::SlidingContacts::Entries &inside) const;
    /** The same of bodies: whether a node has passed the faces that it met. */
    std::string
    lose_masters(const ContactStart    &start,
                 const Eigen::VectorXd &u,
                 const double           t) const;

  private:
    using Ways = std::vector<pairing::BodyWay>;
    Ways
    ways_to(const ContactStart &start, const Eigen::VectorXd &u) const;
    std::string
    obstacle_passes(const Ways  &ways,
                    const double from,
                    const double to,
                    const bool   may_be_cut) const;
    std::string
    body_passes(const Ways                        &ways,
                const Eigen::VectorXd             &u,
                const double                       t,
                const bool                         may_be_cut,
                pairing::SlidingContacts::Entries &inside) const;

    const pairing::SlidingContacts &contacts;
    const contact::ContactModel    &model;
  };
} // namespace conetact::analysis

#endif
