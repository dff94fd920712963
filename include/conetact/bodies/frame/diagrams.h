// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_diagrams_h
#define conetact_bodies_frame_diagrams_h

#include "conetact/bodies/frame/members.h"

#include <vector>

namespace conetact::bodies
{
  /**
   * What a cut through a member shows: the force and moment that the part
   * beyond it exerts on the part before it, in local axes (axial force positive
   * in tension), and the displacement of the axis in global ones.
   */
  struct MemberSection
  {
    double          place = 0; ///< 0 at the start, 1 at the end
    Eigen::Vector3d force;     ///< (N, V_y, V_z) [force]
    Eigen::Vector3d moment;    ///< (torque, M_y, M_z) [force x length]
    Eigen::Vector3d displacement;
  };

  /**
   * Cuts at 0, 1/n, ..., 1. Forces follow from the end forces, which are those
   * of the deformation, and the loads between, @f$F' = -q@f$,
   * @f$M' = -e_x \times F@f$; displacements from @f$w_y'' = M_z/EI_z@f$,
   * @f$w_z'' = -M_y/EI_y@f$ and those of the ends.
   */
  std::vector<MemberSection>
  member_sections(const Member         &member,
                  const Member::Vector &displacement,
                  const Member::Vector &deformation,
                  const MemberLoad     &load,
                  const unsigned int    n);

  /**
   * What a load adds to the displacement at a place (0 to 1) while the ends
   * stay, in global axes: the exact integral of the same equations.
   */
  Tensor<1, 3>
  member_deflection(const Member     &member,
                    const MemberLoad &load,
                    const double      place);
} // namespace conetact::bodies

#endif
