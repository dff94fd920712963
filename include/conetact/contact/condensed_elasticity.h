// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensed_elasticity_h
#define conetact_contact_condensed_elasticity_h

#include "conetact/contact/condensed_bodies.h"
#include "conetact/contact/elasticity.h"

namespace conetact::contact
{
  /** What both forms of the contact problem of condensed bodies share. */
  class CondensedElasticity : public Elasticity
  {
  public:
    std::string
    description() const override
    {
      return "condensation by " + std::string(condenser.name) +
             ": order, factor and Schur complement";
    }
    double
    factor_bytes() const override
    {
      return condensed_bodies().factor_bytes();
    }
    unsigned int
    n_shared_bodies() const override
    {
      return condensed_bodies().n_shared();
    }
    condensed::SchurWork
    work() const override
    {
      return condensed_bodies().work();
    }
    std::vector<StiffnessDifference>
    compare(const condensed::Condenser &other) const override
    {
      return condensed_bodies().compare(condenser, other);
    }

  protected:
    explicit CondensedElasticity(const condensed::Condenser &by)
      : condenser(by)
    {}
    virtual const CondensedBodies &
    condensed_bodies() const = 0;

    const condensed::Condenser &condenser;
  };
} // namespace conetact::contact

#endif
