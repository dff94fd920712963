// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_frame_model_h
#define conetact_bodies_frame_frame_model_h

#include "conetact/bodies/structure.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace conetact::bodies
{
  /**
   * Cross section of members. Without moments of inertia the member is a bar,
   * which carries axial force only; else an Euler-Bernoulli beam. Local axes:
   * x along the member, y = orientation x x, z = x x y (in 2D y to the left of
   * x, z out of the plane).
   */
  struct FrameSection
  {
    std::string  name;
    double       young_modulus = 0; ///< E [force/length^2]
    double       area          = 0; ///< A [length^2]
    double       inertia_y     = 0; ///< I_y, bending along z; 3D [length^4]
    double       inertia_z     = 0; ///< I_z, bending along y [length^4]
    double       torsion       = 0; ///< G J [force length^2]; 3D
    double       expansion     = 0; ///< alpha [1/K]
    double       width         = 1; ///< of the surface it offers [length]
    Tensor<1, 3> orientation;       ///< zero: chosen

    bool
    is_beam() const
    {
      return inertia_z > 0;
    }
  };

  struct FrameNode
  {
    std::string  name;
    Point<3>     position;
    BoundaryIds  ids;
    double       area = 0; ///< tributary; 0: from the members [length^2]
    Tensor<1, 3> normal;   ///< if `area` is given
    /** Ends of the member that it divides, nodes before it. */
    std::optional<std::array<unsigned int, 2>> between;
  };

  struct FrameMember
  {
    std::array<unsigned int, 2> nodes   = {};
    unsigned int                section = 0;
    std::array<bool, 2>         hinges  = {{false, false}};
    BoundaryIds                 ids; ///< besides those that both nodes have
  };

  /** A frame as plain data: checked, placed in the scene, tagged. */
  struct FrameModel
  {
    unsigned int              dim = 2;
    std::vector<FrameSection> sections;
    std::vector<FrameNode>    nodes;
    std::vector<FrameMember>  members;
  };
} // namespace conetact::bodies

#endif
