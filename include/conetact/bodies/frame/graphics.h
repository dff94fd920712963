// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_graphics_h
#define conetact_bodies_frame_graphics_h

#include "conetact/bodies/frame/members.h"

#include <filesystem>
#include <vector>

namespace conetact::bodies
{
  /** Of the twelve dofs of a member, with and without a rigid motion. */
  struct MemberMotion
  {
    Member::Vector displacement, deformation;
  };

  /**
   * The undeformed members as lines, beams in eight pieces each, with
   * `displacement` (3), `axial_force` (positive in tension), `axial_stress`
   * (over the area), and in the members' local axes `shear_force` and `moment`
   * in 2D, `shear_force_y`, `shear_force_z`, `torque`, `moment_y`, `moment_z`
   * in 3D: what the part beyond a cut exerts on the part before it. Points are
   * not shared by members. Forces are those of the deformation. `material_id`
   * is the number of the section, which count from 0.
   */
  VtuGrid
  draw_frame(const FrameModel                &model,
             const std::vector<Member>       &members,
             const std::vector<MemberMotion> &motions,
             const std::vector<MemberLoad>   &loads);
} // namespace conetact::bodies

#endif
