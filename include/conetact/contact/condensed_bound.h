// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensed_bound_h
#define conetact_contact_condensed_bound_h

#include "conetact/contact/bound_contacts.h"
#include "conetact/contact/bound_unknowns.h"

namespace conetact::contact
{
  /** What is bound of condensed bodies: a load case has its part of the load,
   * from which it is computed once solvers have the rest. */
  class CondensedBound : public BoundContacts
  {
  public:
    /** Arguments must outlive the object. */
    CondensedBound(const ContactPoints &points, const RigidMotions &motions);

    /** From the relation (W G; -G^T C) of all rows and the bodies' own motions,
     * the one that solvers see. */
    Eigen::MatrixXd
    eliminate(Eigen::MatrixXd      all,
              const model::Bodies &bodies,
              const Coordinates   &coordinates);
    /** Splits a load of all rows and motions into those that solvers and what
     * is bound see. */
    void
    set_load(const Eigen::VectorXd &all, LoadCase &load) const;
    /** Reactions of all rows and all own motions. */
    Eigen::VectorXd
    all_of(const LoadCase &load, const Eigen::VectorXd &primal) const;

    void
    move(const Eigen::VectorXd &offset, LoadCase &load) const override;
    BoundState
    state(const LoadCase &load, const Eigen::VectorXd &primal) const override;
    Eigen::VectorXd
    stiffness() const override
    {
      return along_rows;
    }
    const RedundantRows *
    redundant_rows() const override
    {
      return &unknowns.redundant_rows();
    }

  private:
    const ContactPoints &points;
    const RigidMotions  &motions;
    BoundUnknowns        unknowns;
    Eigen::VectorXd      along_rows;
  };
} // namespace conetact::contact

#endif
