// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_large_motions_h
#define conetact_contact_large_motions_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/rigid_motions.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace conetact::contact
{
  /** Rigid motions of all bodies together, in the unknowns. They open no tie.
   * The arguments must outlive them. */
  std::vector<std::function<Eigen::VectorXd()>>
  common_motions(const model::Bodies &bodies, const Coordinates &coordinates);

  /** Displacements of all dofs by the motions that nothing resists,
   * orthonormal. */
  Eigen::MatrixXd
  unresisted_fields(const RigidMotions &motions,
                    const Coordinates  &coordinates);

  /**
   * An unknown for each of these fields, which together they move far: held,
   * they keep bodies from moving so, and take no force as long as none drives
   * these.
   */
  std::vector<Eigen::Index>
  find_pins(const Eigen::MatrixXd &fields, const Coordinates &coordinates);
} // namespace conetact::contact

#endif
