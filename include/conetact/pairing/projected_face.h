// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_projected_face_h
#define conetact_pairing_projected_face_h

#include "conetact/base/points.h"
#include "conetact/pairing/clipping.h"
#include "conetact/pairing/face_net.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace conetact::pairing
{
  /** A plane with two axes in it; of bodies in 2D the first one is used. */
  struct ProjectionPlane
  {
    Point<3>                    origin;
    Tensor<1, 3>                normal; ///< unit
    std::array<Tensor<1, 3>, 2> axes;   ///< unit

    /** Through a point; in the plane z = 0 if it is a line. */
    ProjectionPlane(const Point<3>     &through,
                    const Tensor<1, 3> &unit_normal,
                    const bool          is_line);
    Point<2>
    project(const Point<3> &p) const;
    double
    height(const Point<3> &p) const;
    /** In space, of a vector in these axes. */
    Tensor<1, 3>
    in_space(const Eigen::Vector3d &v) const;
  };

  /**
   * A face as it is seen along the normal of a plane: a segment, a triangle or
   * a quadrilateral (corners in deal.II's order) with its linear or bilinear
   * shape functions. The quadrilateral may be warped, but has to look convex.
   */
  class ProjectedFace
  {
  public:
    ProjectedFace(const std::vector<Point<3>> &corners,
                  const ProjectionPlane       &plane);
    /** Where it may be bent, it is seen within the outline of its corners. */
    ProjectedFace(const FaceNet::Face &face, const ProjectionPlane &plane);

    const Polygon &
    outline() const
    {
      return around;
    }
    /** How far it is from a parallelogram, over its size; 0: shape functions
     * are polynomials in the plane. */
    double
    skewness() const
    {
      return skew;
    }
    std::size_t
    n_corners() const
    {
      return heights.size();
    }

    struct Seen
    {
      std::array<double, 2> local{{0, 0}}; ///< in the unit square or triangle
      Eigen::Vector4d       shape = Eigen::Vector4d::Zero(); ///< of the corners
      Point<2>              place;                           ///< in the plane
      double                height = 0; ///< above it [length]
      /** Area of the face over that of what is seen of it. */
      double stretch = 1;
      /** Unit, in axes of the plane and on its side; 0: it is not bent. */
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    };
    /** The point of the face that is seen at a point of the plane. One that is
     * bent has it beside that, with the local coordinates of its chords: so
     * the outline of these is all of it. */
    Seen
    at(const Point<2> &p) const;
    /** The point that is over one of the plane: of a face that is bent, a
     * little beyond its edges if need be. */
    Seen
    over(const Point<2> &p) const;

  private:
    std::array<double, 2>
    local(const Point<2> &p) const;
    struct BentPlace
    {
      Eigen::Vector3d             x      = Eigen::Vector3d::Zero();
      Eigen::Matrix<double, 3, 2> slopes = Eigen::Matrix<double, 3, 2>::Zero();
    };
    BentPlace
    bent_place(const std::array<double, 2> &at) const;
    std::array<double, 2>
    bent_local(const Point<2> &p, const std::array<double, 2> &near) const;
    Seen
    bent_at(const std::array<double, 2> &where) const;
    Seen
    flat_at(const std::array<double, 2> &where, const Point<2> &p) const;
    /** Rows: x, y and height differentiated by the local coordinates. */
    Eigen::Matrix<double, 3, 2>
    slopes(const std::array<double, 2> &at) const;

    std::vector<Point<2>> corners;
    std::vector<double>   heights;
    /** Of all nodes of one that may be bent: places in axes of the plane. */
    std::vector<Eigen::Vector3d> bent;
    Polygon                      around;
    double                       skew = 0;
  };

  /** Shape functions of all nodes of a face at a point of it that is seen. */
  Eigen::VectorXd
  nodal_shapes(const FaceNet::Face &face, const ProjectedFace::Seen &seen);
} // namespace conetact::pairing

#endif
