// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_face_tree_h
#define conetact_pairing_face_tree_h

#include "conetact/base/points.h"

#include <memory>
#include <vector>

namespace conetact::pairing
{
  /**
   * Balls around faces in a tree of boxes, so that what is near a point or a
   * line is found without looking at all faces. Lengths as in the coordinates.
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
    struct Boxes;
    /** Those that meet, of balls whose boxes come near the line from a to b. */
    template <class Meets>
    std::vector<std::size_t>
    find(const Point<3> &a,
         const Point<3> &b,
         const double    distance,
         const Meets    &meets) const;

    std::vector<Ball>            balls;
    std::shared_ptr<const Boxes> boxes; ///< around the balls
  };
} // namespace conetact::pairing

#endif
