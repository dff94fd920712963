// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_retained_unknowns_h
#define conetact_contact_retained_unknowns_h

#include "conetact/contact/body_coordinates.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/rigid_motions.h"

#include <Eigen/SparseCore>

#include <vector>

namespace conetact::contact
{
  /** Which own unknowns bodies keep where contacts are rows H over them. */
  struct RetainedUnknowns
  {
    const model::Bodies               &bodies;
    const Coordinates                 &coordinates; ///< without contacts
    const RigidMotions                &motions;
    const BodyCoordinates             &own;
    const Eigen::SparseMatrix<double> &H;

    /** Marks them, of all own unknowns of a body. */
    void
    operator()(const unsigned int body, std::vector<bool> &kept) const;

  private:
    void
    keep_anchors(const unsigned int body, std::vector<bool> &kept) const;
  };
} // namespace conetact::contact

#endif
