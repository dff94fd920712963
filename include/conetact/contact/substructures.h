// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_substructures_h
#define conetact_contact_substructures_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/substructure_solver.h"

namespace conetact
{
  /** Places of unknowns; empty: as they are. */
  using Places = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic>;

  /**
   * The elastic system in the unknowns of `coordinates`, put in their places,
   * the last `n_schur` of them to be condensed: divided where bodies equal
   * others and that takes fewer operations, else as a whole. Equal bodies have
   * the same matrix, that is mesh, material and supports; they may be moved,
   * turned and in contact with each other. Bodies without an equal are one
   * part.
   */
  Substructures
  make_substructures(const ElasticSystem &elastic,
                     const Coordinates   &coordinates,
                     const Places        &place,
                     const Eigen::Index   n_schur);
} // namespace conetact

#endif
