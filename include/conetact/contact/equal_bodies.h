// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_equal_bodies_h
#define conetact_contact_equal_bodies_h

#include "conetact/contact/body_coordinates.h"
#include "conetact/contact/elastic_system.h"

#include <vector>

namespace conetact::contact
{
  /** Whether two bodies have as many nodes: others cannot be equal. */
  bool
  may_have_equals(const model::Bodies &bodies);

  /**
   * Groups of two bodies or more that are equal, as copies that are moved:
   * they have the same matrix in their BodyCoordinates but for round-off, 1e-12
   * of the largest value, and so has each of their foundations. That is seen
   * from the forces of one displacement without any order: no matrix is
   * assembled.
   */
  std::vector<std::vector<unsigned int>>
  find_equal_bodies(const ElasticSystem &elastic, const BodyCoordinates &own);
} // namespace conetact::contact

#endif
