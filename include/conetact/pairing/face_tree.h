// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_face_tree_h
#define conetact_pairing_face_tree_h

#include "conetact/base/points.h"

#include <functional>
#include <vector>

namespace conetact::pairing
{
  /**
   * A tree of balls around faces, so that what is near a point or a line is
   * found without looking at all faces. Lengths as in the coordinates.
   */
  class FaceTree
  {
  public:
    struct Ball
    {
      Point<3> centre;
      double   radius = 0;
    };
    FaceTree() = default;
    explicit FaceTree(const std::vector<Ball> &balls);

    /** Numbers of the balls that meet the ball, sorted. */
    std::vector<std::size_t>
    near(const Ball &ball) const;

    /**
     * Numbers of the balls that meet the tube around the line through the
     * centre of a ball, up to `reach` before and behind it, sorted.
     */
    std::vector<std::size_t>
    along(const Ball         &ball,
          const Tensor<1, 3> &unit_direction,
          const double        reach) const;

  private:
    struct Branch
    {
      Ball        ball;
      std::size_t begin, end;          ///< in `order`
      std::size_t left = 0, right = 0; ///< 0: a leaf
    };
    std::size_t
    grow(const std::size_t begin, const std::size_t end);
    Ball
    around(const std::size_t begin, const std::size_t end) const;
    std::vector<std::size_t>
    find(const std::function<bool(const Ball &)> &may_meet) const;

    std::vector<Ball>        balls;
    std::vector<std::size_t> order;
    std::vector<Branch>      branches;
  };
} // namespace conetact::pairing

#endif
