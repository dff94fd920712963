// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_friction_ellipse_h
#define conetact_contact_friction_ellipse_h

#include "conetact/solvers/nodal_laws.h"

namespace conetact::contact
{
  /* Ellipses of friction by the limits along both axes, which are semi-axes:
     what does not press has the shape of what presses hardly. An axis without
     friction has very little of it beside the other one. */

  /** The geometric mean of both. */
  solvers::FrictionLimit
  mean(const solvers::FrictionLimit &one, const solvers::FrictionLimit &two);

  /** The limit along a direction between both axes, by its cosines. */
  solvers::FrictionLimit
  cut(const solvers::FrictionLimit &one,
      const solvers::FrictionLimit &two,
      const double                  cosine_1,
      const double                  cosine_2);

  /** The first one over the mean. */
  solvers::Aspect
  aspect_of(solvers::FrictionLimit one, solvers::FrictionLimit two);
} // namespace conetact::contact

#endif
