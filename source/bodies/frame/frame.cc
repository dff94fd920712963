// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/frame.h"

#include "conetact/bodies/frame/diagrams.h"
#include "conetact/bodies/frame/graphics.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace conetact::bodies
{
  namespace
  {
    bool
    intersect(const BoundaryIds &a, const BoundaryIds &b)
    {
      return std::any_of(a.begin(), a.end(), [&](const unsigned int id) {
        return b.count(id) > 0;
      });
    }

    std::vector<Member>
    members_of(const FrameModel &model)
    {
      std::vector<Member> members;
      for (const FrameMember &member : model.members)
        members.emplace_back(model, member);
      return members;
    }

    /** Displacements, and rotations where some member bends. */
    unsigned int
    n_dofs_of_node(const unsigned int dim, const std::vector<Member> &members)
    {
      const bool rotate =
        std::any_of(members.begin(), members.end(), [](const Member &m) {
          return m.turns_with(0) || m.turns_with(1);
        });
      return rotate ? (dim == 2 ? 3 : 6) : dim;
    }
  } // namespace

  Frame::Frame(FrameModel frame)
    : model(std::move(frame))
    , members(members_of(model))
    , dofs_of_node(n_dofs_of_node(model.dim, members))
    , of_members(model, members, dofs_of_node)
    , turns(model.nodes.size(), false)
  {
    for (const Member &member : members)
      for (const unsigned int end : {0u, 1u})
        if (member.turns_with(end))
          turns[member.nodes()[end]] = true;
    for (const FrameNode &node : model.nodes)
      size =
        std::max(size, node.position.distance(model.nodes.front().position));
  }

  unsigned int
  Frame::n_nodes() const
  {
    return static_cast<unsigned int>(model.nodes.size());
  }

  unsigned int
  Frame::n_components() const
  {
    return dofs_of_node;
  }

  Point<3>
  Frame::position(const unsigned int node) const
  {
    AssertIndexRange(node, n_nodes());
    return model.nodes[node].position;
  }

  const std::vector<HangingNode> &
  Frame::hanging_nodes() const
  {
    static const std::vector<HangingNode> none;
    return none;
  }

  bool
  Frame::has_dof(const unsigned int node, const unsigned int component) const
  {
    AssertIndexRange(node, n_nodes());
    AssertIndexRange(component, n_components());
    return component < model.dim || turns[node];
  }

  std::string
  Frame::weakness(const unsigned int node) const
  {
    AssertIndexRange(node, n_nodes());
    Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
    for (const Member &member : members)
      if (member.nodes()[0] == node || member.nodes()[1] == node)
        {
          const Tensor<1, 3>    t = member.axis(0);
          const Eigen::Vector3d x(t[0], t[1], t[2]);
          if (member.bends())
            return {};
          directions += x * x.transpose();
        }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(directions);
    if (eigen.eigenvalues()[model.dim == 2 ? 1 : 0] > 1e-6)
      return {};
    return "All bars at node '" + model.nodes[node].name + "' lie in one " +
           (model.dim == 2 || eigen.eigenvalues()[1] < 1e-6 ? "line" :
                                                              "plane") +
           ": across it nothing holds the node. Give a member a Moment of "
           "inertia, brace the node, or support it.";
  }

  BoundaryIds
  Frame::boundary_ids() const
  {
    BoundaryIds ids;
    for (const FrameNode &node : model.nodes)
      ids.insert(node.ids.begin(), node.ids.end());
    for (const FrameMember &member : model.members)
      ids.insert(member.ids.begin(), member.ids.end());
    return ids;
  }

  bool
  Frame::carries(const std::size_t member, const BoundaryIds &ids) const
  {
    const FrameMember &m = model.members[member];
    const BoundaryIds &a = model.nodes[m.nodes[0]].ids;
    const BoundaryIds &b = model.nodes[m.nodes[1]].ids;
    return std::any_of(ids.begin(), ids.end(), [&](const unsigned int id) {
      return m.ids.count(id) > 0 || (a.count(id) > 0 && b.count(id) > 0);
    });
  }

  Tensor<1, 3>
  Frame::face_normal(const Member &member) const
  {
    return member.axis(model.dim == 2 ? 1 : 2);
  }

  Surface
  Frame::surface(const BoundaryIds &ids) const
  {
    Surface surface;
    surface.two_sided = true;
    std::vector<bool>         on_face(n_nodes(), false), found(n_nodes());
    std::vector<double>       areas[2];
    std::vector<Tensor<1, 3>> normals[2];
    for (const unsigned int k : {0u, 1u}) // of all members, of faces only
      {
        areas[k].resize(n_nodes(), 0.);
        normals[k].resize(n_nodes());
      }
    for (std::size_t m = 0; m < members.size(); ++m)
      {
        const bool face = carries(m, ids);
        if (face)
          surface.faces.push_back(
            {{members[m].nodes()[0], members[m].nodes()[1]},
             face_normal(members[m])});
        const double half =
          members[m].length() * members[m].section().width / 2;
        for (const unsigned int node : members[m].nodes())
          for (unsigned int k = 0; k < (face ? 2 : 1); ++k)
            {
              areas[k][node] += half;
              normals[k][node] += half * face_normal(members[m]);
            }
        for (const unsigned int node : members[m].nodes())
          on_face[node] = on_face[node] || face;
      }
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (on_face[i] || intersect(model.nodes[i].ids, ids))
        {
          const FrameNode   &own = model.nodes[i];
          const unsigned int k   = on_face[i];
          SurfaceNode node{i, own.position, areas[k][i], normals[k][i], {}};
          if (own.area > 0)
            {
              node.area   = own.area;
              node.normal = own.normal;
            }
          if (node.normal.norm() > 1e-12 * node.area)
            node.normal /= node.normal.norm();
          node.normals = {node.normal};
          surface.nodes.push_back(node);
        }
    return surface;
  }



  Tensor<1, 3>
  Frame::deflection_between_nodes(const Point<3> &point,
                                  const Actions  &actions) const
  {
    std::vector<MemberLoad> at(members.size());
    if (node_at(point) == n_nodes())
      add_point(point, Tensor<1, 3>(), at);
    for (std::size_t m = 0; m < members.size(); ++m)
      if (!at[m].points.empty())
        return member_deflection(members[m],
                                 member_loads(actions)[m],
                                 at[m].points[0].first);
    return {};
  }

  VtuGrid
  Frame::drawing(const Eigen::VectorXd &u,
                 const Eigen::VectorXd &w,
                 const Actions         &actions) const
  {
    std::vector<MemberMotion> motions;
    for (const Member &member : members)
      motions.push_back({of_members.displacements(member, u),
                         of_members.displacements(member, w)});
    return draw_frame(model, members, motions, member_loads(actions));
  }

  std::string
  Frame::description() const
  {
    const auto n_beams =
      std::count_if(members.begin(), members.end(), [](const Member &m) {
        return m.bends();
      });
    return std::to_string(n_beams) + " beams, " +
           std::to_string(static_cast<std::ptrdiff_t>(members.size()) -
                          n_beams) +
           " bars, " + std::to_string(n_nodes()) + " nodes";
  }
} // namespace conetact::bodies
