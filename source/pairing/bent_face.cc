// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/bent_face.h"

#include "conetact/pairing/nodal_shapes.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    using Local = std::array<double, 2>;

    /** How far beyond its edges a face is continued, in its own coordinates. */
    constexpr double beyond_edges = .05;

    /**
     * Place and derivatives of a bent face. Central differences over half a
     * unit to either side are exact for functions of second degree in each
     * coordinate.
     */
    struct BentFace
    {
      const FaceNet::Face &face;

      Tensor<1, 3>
      at(const double a, const double b) const
      {
        const std::size_t n = face.corners.size();
        const auto   N = nodal_shape_values(face.nodes.size(), n, {{a, b}});
        Tensor<1, 3> x;
        for (std::size_t i = 0; i < N.size(); ++i)
          x +=
            N[i] * Tensor<1, 3>(i < n ? face.corners[i] : face.middles[i - n]);
        return x;
      }
      Tensor<1, 3>
      slope(const Local &p, const double da, const double db) const
      {
        return at(p[0] + .5 * da, p[1] + .5 * db) -
               at(p[0] - .5 * da, p[1] - .5 * db);
      }
      Tensor<1, 3>
      curvature(const Local &p, const double da, const double db) const
      {
        return 4 * (at(p[0] + .5 * da, p[1] + .5 * db) - 2. * at(p[0], p[1]) +
                    at(p[0] - .5 * da, p[1] - .5 * db));
      }
      /** The derivative by both coordinates. */
      Tensor<1, 3>
      twist(const Local &p) const
      {
        return slope({{p[0] + .5, p[1]}}, 0, 1) -
               slope({{p[0] - .5, p[1]}}, 0, 1);
      }
      bool
      is_segment() const
      {
        return face.corners.size() == 2;
      }
    };

    /** Newton's step to where |x(a, b) - p|^2 / 2 has no slope: its slopes are
     * (x - p) . x_i, its second derivatives x_i . x_j + (x - p) . x_ij. */
    Eigen::Vector2d
    step_to_foot(const BentFace &bent, const Point<3> &p, const Local &at)
    {
      const Tensor<1, 3> miss = bent.at(at[0], at[1]) - Tensor<1, 3>(p);
      const Tensor<1, 3> a    = bent.slope(at, 1, 0);
      Eigen::Vector2d    slope(miss * a, 0);
      Eigen::Matrix2d    second = Eigen::Matrix2d::Identity();
      second(0, 0)              = a * a + miss * bent.curvature(at, 1, 0);
      if (!bent.is_segment())
        {
          const Tensor<1, 3> b = bent.slope(at, 0, 1);
          slope[1]             = miss * b;
          second(1, 1)         = b * b + miss * bent.curvature(at, 0, 1);
          second(0, 1) = second(1, 0) = a * b + miss * bent.twist(at);
        }
      return -(second.inverse() * slope);
    }

    bool
    is_on(const BentFace &bent, const Local &at)
    {
      const auto is_near = [](const double a) {
        return a >= -beyond_edges && a <= 1 + beyond_edges;
      };
      return is_near(at[0]) && (bent.is_segment() || is_near(at[1])) &&
             (bent.face.corners.size() != 3 || is_near(at[0] + at[1]));
    }

    Tensor<1, 3>
    normal_of(const BentFace &bent, const Local &at)
    {
      const Tensor<1, 3> a = bent.slope(at, 1, 0);
      const Tensor<1, 3> n = bent.is_segment() ?
                               Tensor<1, 3>({a[1], -a[0], 0.}) :
                               cross_product_3d(a, bent.slope(at, 0, 1));
      return (n * bent.face.outward < 0 ? -1 : 1) / n.norm() * n;
    }
  } // namespace

  std::optional<BentPoint>
  foot_on_bent(const FaceNet::Face &face, const Point<3> &p, const Local &near)
  {
    // Steps are in local coordinates: one of half a face leads to another foot,
    // or to none. Far from the origin rounding keeps steps above `found`: after
    // `most` of them a place is taken whose last step was next to nothing.
    constexpr double       found = 1e-14, nothing = 1e-9, far = .5;
    constexpr unsigned int most = 30;
    const BentFace         bent{face};
    Local                  at   = near;
    double                 size = 0;
    for (unsigned int i = 0; i < most; ++i)
      {
        const Eigen::Vector2d step = step_to_foot(bent, p, at);
        size                       = step.cwiseAbs().maxCoeff();
        if (!(size < far))
          return {};
        at = {{at[0] + step[0], at[1] + step[1]}};
        if (size < found)
          break;
      }
    // A foot beyond the edges is one of the neighbour, or of nothing: a little
    // beyond is allowed, so that two faces leave no slit between them.
    if (size > nothing || !is_on(bent, at))
      return {};
    return BentPoint{at, Point<3>(bent.at(at[0], at[1])), normal_of(bent, at)};
  }
} // namespace conetact::pairing
