// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_members_h
#define conetact_bodies_frame_members_h

#include "conetact/bodies/frame/frame_model.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace conetact::bodies
{
  /** What acts on a member between its nodes. */
  struct MemberLoad
  {
    std::vector<VectorField> per_length; ///< [force/length], global
    /** Place (0 to 1) and force [force], global. */
    std::vector<std::pair<double, Tensor<1, 3>>> points;
    double initial_strain = 0; ///< mean of that along its axis [-]
  };

  /**
   * Stiffness and nodal forces of a straight bar or Euler-Bernoulli beam. Its
   * twelve dofs are u_x, u_y, u_z, theta_x, theta_y, theta_z at the start and
   * the same at the end, rotations being those of the section about the axes;
   * in 2D those out of the plane are zero. A hinge passes no moment: the
   * rotations of that end are condensed,
   * @f$k - k_r k_r^T/k_{rr}@f$, and take no part; a beam with two hinges is a
   * bar. Loads are consistent with cubic deflections (those of bars, with
   * linear ones), which makes nodal displacements and end forces exact.
   */
  class Member
  {
  public:
    using Vector = Eigen::Matrix<double, 12, 1>;
    using Matrix = Eigen::Matrix<double, 12, 12>;

    Member(const FrameModel &model, const FrameMember &member);

    double
    length() const
    {
      return l;
    }
    const std::array<unsigned int, 2> &
    nodes() const
    {
      return ends;
    }
    const FrameSection &
    section() const
    {
      return *properties;
    }
    /** Neither a bar nor hinged at both ends. */
    bool
    bends() const
    {
      return bending;
    }
    /** Whether it turns with the node at that end. */
    bool
    turns_with(const unsigned int end) const
    {
      return bending && !hinges[end];
    }
    Point<3>
    point(const double place) const
    {
      return Point<3>((1 - place) * start + place * finish);
    }
    /** Local axis 0, 1 or 2 in global coordinates. */
    Tensor<1, 3>
    axis(const unsigned int i) const;

    /** Which of the twelve dofs the member has in `dim` dimensions. */
    std::vector<unsigned int>
    active_dofs(const unsigned int dim) const;

    /** In global directions, exactly symmetric. */
    Matrix
    stiffness() const;
    /** Nodal forces that stand for a load, in global directions. */
    Vector
    forces(const MemberLoad &load) const;

    /** A vector of twelve dofs in local directions. */
    Vector
    to_local(const Vector &global) const;
    /** Forces of the nodes on the member's ends, in local directions. */
    Vector
    end_forces(const Vector &u, const MemberLoad &load) const;

  private:
    using LocalForce = Eigen::Vector3d;
    Matrix
    full_stiffness() const;
    void
    condense(Matrix &k, Vector &f) const;
    Vector
    shape_forces(const double place, const LocalForce &force) const;
    Vector
    local_forces(const MemberLoad &load) const;

    std::array<unsigned int, 2> ends;
    std::array<bool, 2>         hinges;
    const FrameSection         *properties;
    bool                        bending;
    Point<3>                    start, finish;
    double                      l;
    Eigen::Matrix3d             axes; ///< rows: local axes
  };
} // namespace conetact::bodies

#endif
