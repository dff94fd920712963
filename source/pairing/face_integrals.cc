// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/face_integrals.h"

#include "conetact/pairing/corner_parts.h"
#include "conetact/pairing/dual_functions.h"
#include "conetact/pairing/nodal_shapes.h"

#include <algorithm>

namespace conetact::pairing
{
  namespace
  {
    using Eigen::Index;

    /**
     * The radius r at a point of a face of a body that goes round an axis:
     * areas there are integrals of r ds, without the factor 2 pi, which
     * thickness_of() gives.
     */
    double
    radius(const FaceNet::Face &face, const Eigen::Vector4d &shape)
    {
      double r = 0;
      for (std::size_t v = 0; v < face.corners.size(); ++v)
        r += shape[static_cast<Index>(v)] * face.corners[v][0];
      return r;
    }

    /**
     * Shape functions of skew faces are series in their skewness s, with
     * polynomials of degree k + 2 at s^k: at these bounds what is cut off is
     * below 1e-10. Products of two functions of second degree have up to degree
     * 8 even on parallelograms, where level 0 is exact to degree 5 only: they
     * need one level more.
     */
    unsigned int
    level_for(const double skewness, const bool second_degree)
    {
      const unsigned int level = skewness < 3e-4 ? 0 :
                                 skewness < .05  ? 1 :
                                 skewness < .4   ? 2 :
                                                   3;
      return level + second_degree;
    }

    Eigen::RowVector3d
    in_space(const ProjectionPlane &plane, const Eigen::RowVector3d &v)
    {
      const Tensor<1, 3> there = plane.in_space(v.transpose());
      return {there[0], there[1], there[2]};
    }

    bool
    is_of_second_degree(const FaceNet::Face &face)
    {
      return face.nodes.size() > face.corners.size();
    }
  } // namespace

  ProjectionPlane
  plane_of(const FaceNet::Face &face)
  {
    return {face.centre, face.outward, face.corners.size() == 2};
  }

  /* `stretch` is dA on the slave over dA in the plane. */
  FaceIntegrals
  integrate(const FaceNet::Face                  &face,
            const std::vector<FacingParts::Part> &parts,
            const std::vector<FaceNet::Face>     &master,
            const bool                            axisymmetric)
  {
    const ProjectionPlane plane = plane_of(face);
    const ProjectedFace   own(face, plane);
    const auto            n     = static_cast<Index>(face.nodes.size());
    const double          whole = measure(own.outline());
    FaceIntegrals         sums{linear_functions(face),
                       Eigen::MatrixXd::Zero(n, n),
                       Eigen::VectorXd::Zero(n),
                       {},
                       Eigen::MatrixX3d::Zero(n, 3),
                       Eigen::MatrixX3d::Zero(n, 3),
                       {}};
    for (const auto &part : parts)
      {
        // One set of points for both sides: so forces and a constant
        // pressure pass without loss whatever the rule.
        const FaceNet::Face &other = master[part.face];
        const unsigned int   level =
          level_for(std::max(own.skewness(), part.projected.skewness()),
                    is_of_second_degree(face) || is_of_second_degree(other));
        sums.size = std::max(sums.size, other.size);
        sums.part += measure(part.where) / whole;
        for (const PlanePoint &q : gauss_points(part.where, level))
          {
            const auto            here = own.at(q.position);
            const Eigen::VectorXd N    = nodal_shapes(face, here);
            const double around = axisymmetric ? radius(face, here.shape) : 1;
            const Eigen::VectorXd weighted =
              q.weight * here.stretch * around * N;
            sums.areas += weighted;
            sums.mass += weighted * N.transpose();
            const auto            opposite = part.projected.over(here.place);
            const Eigen::VectorXd there    = nodal_shapes(other, opposite);
            sums.slave_normals += weighted * here.normal.transpose();
            // Normals of what is seen are on the side of the plane's
            // normal, which looks out of the slave: those out of the master
            // are opposite.
            sums.master_normals -= weighted * opposite.normal.transpose();
            sums.lowest = std::min(sums.lowest, opposite.height - here.height);
            for (std::size_t l = 0; l < other.nodes.size(); ++l)
              sums.masters.try_emplace(other.nodes[l], Eigen::VectorXd::Zero(n))
                .first->second += there[static_cast<Index>(l)] * weighted;
          }
      }
    for (Eigen::MatrixX3d *const of_side :
         {&sums.slave_normals, &sums.master_normals})
      for (Index j = 0; j < n; ++j)
        of_side->row(j) = in_space(plane, of_side->row(j));
    return sums;
  }
} // namespace conetact::pairing
