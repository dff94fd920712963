// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_asked_load_h
#define conetact_bodies_asked_load_h

#include "conetact/bodies/loads.h"

#include <string>

namespace conetact::bodies
{
  /** Force, and moment about the origin. */
  struct Total
  {
    Tensor<1, 3> force, moment;
  };

  /**
   * What the entries of a load ask for at time t, for the log: the total of a
   * force, a moment or a bearing load, and how far the mesh is from carrying
   * it; of pressures and tractions the area, of body forces and centrifugal
   * loads the mass, which an engineer compares with the drawing. Empty for
   * others.
   */
  std::string
  what_is_asked(const Load      &load,
                const Structure &body,
                const double     t,
                const Total     &carried);
} // namespace conetact::bodies

#endif
