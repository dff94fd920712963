// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_body_rows_h
#define conetact_contact_body_rows_h

#include "conetact/contact/condensed_bodies.h"
#include "conetact/contact/contact_points.h"

#include <Eigen/SparseCore>

namespace conetact::contact
{
  /** Contact points, also those that are bound, as rows H over the own unknowns
   * of all bodies. */
  class BodyRows
  {
  public:
    using Index    = Eigen::Index;
    using VectorXd = Eigen::VectorXd;
    using Matrix   = Eigen::SparseMatrix<double>;

    /** `coordinates` are those of the bodies without contacts. All must outlive
     * the object. */
    BodyRows(const model::Bodies   &bodies,
             const ContactPoints   &points,
             const Coordinates     &coordinates,
             const BodyCoordinates &own);

    const Matrix &
    matrix() const
    {
      return H;
    }
    /** Points are other ones. */
    void
    find_again();
    /** H u of displacements of all dofs, also of rigid bodies. */
    VectorXd
    moved(const VectorXd &u) const;
    /** W = H P H^T of condensed bodies. */
    Eigen::MatrixXd
    flexibility(const CondensedBodies &condensed) const;

  private:
    const model::Bodies   &bodies;
    const ContactPoints   &points;
    const Coordinates     &coordinates;
    const BodyCoordinates &own;
    Matrix                 H;
  };
} // namespace conetact::contact

#endif
