// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_bound_contacts_h
#define conetact_contact_bound_contacts_h

#include "conetact/contact/load_case.h"
#include "conetact/contact/redundant_rows.h"

namespace conetact::contact
{
  /** Ties and bilateral contacts, which solvers do not see. */
  struct BoundState
  {
    Eigen::VectorXd r;      ///< their reactions [force]
    Eigen::VectorXd motion; ///< rigid motions that they resist, amounts of the
                            ///< bodies' own ones [length]
  };

  /** What an Elasticity has eliminated before solvers see it; this one:
   * nothing. */
  class BoundContacts
  {
  public:
    virtual ~BoundContacts() = default;

    /** What is bound has moved by `offset` without strain. */
    virtual void
    move(const Eigen::VectorXd & /*offset*/, LoadCase & /*load*/) const
    {}
    /** Under a load case and its primal. */
    virtual BoundState
    state(const LoadCase & /*load*/, const Eigen::VectorXd & /*primal*/) const
    {
      return {};
    }
    /** Stiffness along each unknown of what is bound [force/length]. */
    virtual Eigen::VectorXd
    stiffness() const
    {
      return {};
    }
    /** Its redundant rows, where they are known; null: they are not. */
    virtual const RedundantRows *
    redundant_rows() const
    {
      return nullptr;
    }
  };
} // namespace conetact::contact

#endif
