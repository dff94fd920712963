// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_frame_h
#define conetact_bodies_frame_frame_h

#include "conetact/bodies/frame/frame_elements.h"
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

    const FrameElements &
    elements() const override
    {
      return of_members;
    }

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
     * Tractions on members with the ids (times their width, consistent with
     * their deflections) and at nodes without such a member (times their area).
     * Point forces at a node, or on a member. By initial strains each member
     * lengthens by their mean along it.
     */
    bool
    add(const Action &action, Eigen::VectorXd &f) const override;
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

    const FrameModel          model;
    const std::vector<Member> members;
    const unsigned int        dofs_of_node;
    const FrameElements       of_members;
    std::vector<bool>         turns;    ///< whether a node's rotation is a dof
    double                    size = 0; ///< largest distance to the first node
  };
} // namespace conetact::bodies

#endif
