// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_spread_force_h
#define conetact_bodies_spread_force_h

#include "conetact/bodies/structure.h"

#include <functional>
#include <string>

namespace conetact::bodies
{
  /** Of a point of a face and its outward unit normal. */
  using FaceFunction =
    std::function<double(const Point<3> &, const Tensor<1, 3> &)>;

  /** Of a function over faces of a continuum, as tractions are integrated. */
  double
  integral(const Structure    &body,
           const BoundaryIds  &ids,
           const FaceFunction &function);
  double
  area_of(const Structure &body, const BoundaryIds &ids);
  /** The sum over all nodes of forces along y, which bodies of revolution have
   * as well. */
  double
  sum_along_y(const Structure &body, const Eigen::VectorXd &forces);

  /**
   * A force and a moment of given size on boundary ids, as a traction that is
   * linear in space: @f$F/A + \omega \times (x - c)@f$ with the centroid c of
   * the faces and @f$J \omega@f$ the moment about it. It stiffens nothing.
   */
  class SpreadForce
  {
  public:
    /** Throws InputError where the ids have no area; `in` is what the sentence
     * begins with. */
    SpreadForce(const Structure   &body,
                const BoundaryIds &ids,
                const std::string &in);

    /** At x, of a force and its moment about the centroid. */
    Tensor<1, 3>
    traction(const Point<3>     &x,
             const Tensor<1, 3> &force,
             const Tensor<1, 3> &moment) const;

    /**
     * The same force as a pressure c_+ on faces whose inward normal has the
     * cosine c with it, as a pin presses on its half of a bore; what that
     * lacks, where the faces are no half of a circle, is spread evenly. It goes
     * through the axis of the bore. Throws InputError where no face looks that
     * way, and where those that do are plane and the force is not along their
     * normal.
     */
    SurfaceField
    bearing(const Tensor<1, 3> &force) const;

    const Point<3> &
    centroid() const
    {
      return centre;
    }

  private:
    void
    refuse_across_plane(
      const Tensor<1, 3>                                &force,
      const std::function<double(const Tensor<1, 3> &)> &pressed) const;
    /** The moment of a field about the axis of a bore; 0 where faces are none.
     */
    Tensor<1, 3>
    turning(const SurfaceField &field) const;

    const Structure &body; ///< which outlives it
    BoundaryIds      ids;
    std::string      where; ///< what errors begin with
    double           area = 0;
    Point<3>         centre;
    Tensor<2, 3>     inertia; ///< inverse of J
  };
} // namespace conetact::bodies

#endif
