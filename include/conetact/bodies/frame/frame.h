// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_frame_h
#define conetact_bodies_frame_frame_h

#include "conetact/bodies/frame/frame_model.h"
#include "conetact/bodies/frame/members.h"
#include "conetact/bodies/structure.h"

#include <vector>

namespace conetact::bodies
{
  /**
   * A body of straight bars and Euler-Bernoulli beams,
   * @f$K = \sum T^T k T@f$. Dofs of a node are its displacement and, if some
   * member bends, its rotation: theta_z in 2D, theta_x, theta_y, theta_z in 3D
   * [rad]. The rotation of nodes where only bars and hinges meet is no dof.
   */
  class Frame : public Structure
  {
  public:
    /** Of a checked model, see parse_frame(). */
    explicit Frame(FrameModel frame);
    Frame(const Frame &) = delete;
    Frame &
    operator=(const Frame &) = delete;

    unsigned int
    n_nodes() const override;
    unsigned int
    n_components() const override;
    Point<3>
    position(const unsigned int node) const override;
    const std::vector<HangingNode> &
    hanging_nodes() const override;
    bool
    has_dof(const unsigned int node,
            const unsigned int component) const override;
    bool
    may_be_mechanism() const override
    {
      return true;
    }
    std::string
    weakness(const unsigned int node) const override;

    void
    for_each_element(const ElementVisitor &visit) const override;
    void
    add_internal_forces(const Eigen::VectorXd &u,
                        Eigen::VectorXd       &f) const override;

    BoundaryIds
    boundary_ids() const override;
    /**
     * Nodes with one of the ids or of members with it; faces are the members.
     * The area of a node is half the length of its members among the faces, or
     * of all its members if it has none there, times their width; a generator
     * may give another. The normal is the mean of the members' local y in 2D
     * (to the left of the member) and local z in 3D.
     */
    Surface
    surface(const BoundaryIds &ids) const override;

    /**
     * On members with the ids (times their width, consistent with their
     * deflections) and at nodes without such a member (times their area).
     */
    void
    add_traction(const BoundaryIds  &ids,
                 const SurfaceField &traction,
                 Eigen::VectorXd    &f) const override;
    void
    add_body_force(const VectorField &force, Eigen::VectorXd &f) const override;
    /** At a node, or on a member, consistent with its deflection. */
    bool
    add_point_force(const Point<3>     &point,
                    const Tensor<1, 3> &force,
                    Eigen::VectorXd    &f) const override;
    bool
    add_line_load(const BoundaryIds  &ids,
                  const SurfaceField &load,
                  Eigen::VectorXd    &f) const override;
    /** Each member lengthens by the mean of the strain along it. */
    bool
    add_initial_strain(const InitialStrainField &strain,
                       Eigen::VectorXd          &f) const override;
    bool
    expands() const override;
    /** Springs at the nodes, by their areas. */
    void
    visit_springs(const BoundaryIds        &ids,
                  const SurfaceTensorField &stiffness,
                  const ElementVisitor     &visit) const override;

    VtuGrid
    drawing(const Eigen::VectorXd &u,
            const Eigen::VectorXd &w,
            const Actions         &actions) const override;
    std::string
    description() const override;

    /**
     * What actions add to the displacement of a point of a member whose nodes
     * stay; nothing elsewhere. What nodes do is in the shape functions.
     */
    Tensor<1, 3>
    deflection_between_nodes(const Point<3> &point,
                             const Actions  &actions) const;

    const std::vector<Member> &
    all_members() const
    {
      return members;
    }
    /** What actions exert between the nodes of each member. */
    std::vector<MemberLoad>
    member_loads(const Actions &actions) const;
    /** The twelve dofs of a member, zero where it has none. */
    Member::Vector
    displacements(const Member &member, const Eigen::VectorXd &u) const;

  private:
    bool
    carries(const std::size_t member, const BoundaryIds &ids) const;
    Tensor<1, 3>
    face_normal(const Member &member) const;
    unsigned int
    node_at(const Point<3> &p) const;
    void
    add_point(const Point<3>          &p,
              const Tensor<1, 3>      &force,
              std::vector<MemberLoad> &loads) const;
    /** The dof of entry `k` of the twelve dofs of a member. */
    unsigned int
    dof(const Member &member, const unsigned int k) const;
    void
    assemble(const std::vector<MemberLoad> &loads, Eigen::VectorXd &f) const;

    const FrameModel    model;
    std::vector<Member> members;
    bool                rotates = false; ///< some member bends
    std::vector<bool>   turns;           ///< whether a node's rotation is a dof
    double              size = 0;        ///< largest distance to the first node
  };
} // namespace conetact::bodies

#endif
