// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_points_h
#define conetact_base_points_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace conetact
{
  // Places [length] and vectors of all rooms have three components; in the
  // plane z is 0.
  using dealii::Point;
  using dealii::Tensor;
} // namespace conetact

#endif
