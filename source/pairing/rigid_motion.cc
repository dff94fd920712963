// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/rigid_motion.h"

#include "conetact/bodies/placement.h"

#include <Eigen/Geometry>

#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    Tensor<2, 3>
    rotation_by(const Tensor<1, 3> &turn)
    {
      return RigidMotion::turned({}, turn, {}).rotation;
    }
  } // namespace

  Tensor<1, 3>
  rotation_vector(const Tensor<2, 3> &rotation)
  {
    Eigen::Matrix3d matrix;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        matrix(i, j) = rotation[i][j];
    const Eigen::AngleAxisd turn(matrix);
    const Eigen::Vector3d   v = turn.angle() * turn.axis();
    return Tensor<1, 3>({v[0], v[1], v[2]});
  }

  RigidMotion
  RigidMotion::translated(const Tensor<1, 3> &d)
  {
    RigidMotion motion;
    motion.translation = d;
    return motion;
  }

  RigidMotion
  RigidMotion::turned(const Tensor<1, 3> &d,
                      const Tensor<1, 3> &turn,
                      const Point<3>     &c)
  {
    RigidMotion motion = translated(d);
    motion.centre      = c;
    // The length of a rotation vector is the angle [rad]; rotation_about()
    // takes degrees.
    if (const double angle = turn.norm(); angle > 0)
      motion.rotation = bodies::rotation_about(turn, angle * 180 / M_PI);
    return motion;
  }

  /* Where nothing has turned nothing is rounded. */
  Tensor<1, 3>
  RigidMotion::turn_to_space(const Tensor<1, 3> &own) const
  {
    return has_turned() ? rotation_vector(rotation * rotation_by(own)) : own;
  }

  Tensor<1, 3>
  RigidMotion::turn_to_own(const Tensor<1, 3> &turn) const
  {
    return has_turned() ?
             rotation_vector(transpose(rotation) * rotation_by(turn)) :
             turn;
  }
} // namespace conetact::pairing
