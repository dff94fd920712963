// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_body_way_h
#define conetact_pairing_body_way_h

#include "conetact/base/points.h"

#include <vector>

namespace conetact::pairing
{
  /**
   * Where the nodes of a body are while it goes from one place to another: it
   * turns about an axis that stands still, or moves along itself, and what it
   * deforms by grows evenly.
   */
  class BodyWay
  {
  public:
    /** Positions of its nodes at both ends [length], and how far it turns. */
    BodyWay(std::vector<Point<3>>        from,
            const std::vector<Point<3>> &to,
            const Tensor<2, 3>          &rotation);

    /** After a part of the way, from 0 to 1. */
    Point<3>
    at(const unsigned int node, const double part) const;

  private:
    std::vector<Point<3>>     start;
    std::vector<Tensor<1, 3>> strained; ///< by what it deforms, at the end
    Tensor<1, 3>              axis;     ///< unit; 0: it does not turn
    double                    angle = 0;
    Point<3>                  centre; ///< a point of the axis
    Tensor<1, 3>              along;  ///< translation
  };
} // namespace conetact::pairing

#endif
