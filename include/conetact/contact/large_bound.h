// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_large_bound_h
#define conetact_contact_large_bound_h

#include "conetact/contact/bound_contacts.h"
#include "conetact/contact/large_unknowns.h"

namespace conetact::contact
{
  /** What is bound of a large system: it follows what it faces, and the part of
   * a load case has its forces and, behind them, its displacements. */
  class LargeBound : public BoundContacts
  {
  public:
    /** References must outlive the object. */
    LargeBound(const ElasticSystem &elastic,
               const ContactPoints &points,
               const LargeUnknowns &unknowns);

    void
    move(const Eigen::VectorXd &offset, LoadCase &load) const override;
    BoundState
    state(const LoadCase &load, const Eigen::VectorXd &primal) const override;
    Eigen::VectorXd
    stiffness() const override
    {
      return along_unknowns;
    }

    /** A load case of forces on all dofs. */
    LoadCase
    load_of(const Eigen::VectorXd &forces) const;
    /** What of the displacements of all dofs is not in the unknowns. */
    void
    add_displacements(const LoadCase &load, Eigen::VectorXd &u) const;

  private:
    /** Displacements of all dofs by those of what is bound. */
    Eigen::VectorXd
    expand(const Eigen::VectorXd &v) const;
    /** The transpose: forces along what is bound are the reactions that hold
     * it. */
    Eigen::VectorXd restrict(const Eigen::VectorXd &forces) const;

    const ElasticSystem &elastic;
    const LargeUnknowns &unknowns;
    const Eigen::Index   n; ///< of its unknowns
    /** What further contacts see of all dofs. */
    const Eigen::SparseMatrix<double, Eigen::RowMajor> rows_of_dofs;
    Eigen::VectorXd                                    along_unknowns;
  };
} // namespace conetact::contact

#endif
