// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/frame.h"

#include "conetact/bodies/element_forces.h"
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
  } // namespace

  Frame::Frame(FrameModel frame)
    : model(std::move(frame))
    , turns(model.nodes.size(), false)
  {
    for (const FrameMember &member : model.members)
      {
        members.emplace_back(model, member);
        for (const unsigned int end : {0u, 1u})
          if (members.back().turns_with(end))
            turns[member.nodes[end]] = rotates = true;
      }
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
    return rotates ? (model.dim == 2 ? 3 : 6) : model.dim;
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

  unsigned int
  Frame::dof(const Member &member, const unsigned int k) const
  {
    const unsigned int c = k % 6;
    return n_components() * member.nodes()[k / 6] + (c < 3          ? c :
                                                     model.dim == 2 ? 2 :
                                                                      c);
  }

  void
  Frame::for_each_element(const ElementVisitor &visit) const
  {
    std::vector<unsigned int> dofs;
    Eigen::MatrixXd           matrix;
    for (const Member &member : members)
      {
        const auto           active = member.active_dofs(model.dim);
        const Member::Matrix k      = member.stiffness();
        const auto           n      = static_cast<Eigen::Index>(active.size());
        dofs.clear();
        matrix.resize(n, n);
        for (const unsigned int i : active)
          dofs.push_back(dof(member, i));
        for (Eigen::Index i = 0; i < n; ++i)
          for (Eigen::Index j = 0; j < n; ++j)
            matrix(i, j) = k(active[static_cast<std::size_t>(i)],
                             active[static_cast<std::size_t>(j)]);
        visit(dofs, matrix.data());
      }
  }

  void
  Frame::add_internal_forces(const Eigen::VectorXd &u, Eigen::VectorXd &f) const
  {
    AssertDimension(u.size(), f.size());
    Eigen::VectorXd local;
    for_each_element(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        if (rotates)
          multiply(dofs, matrix, u, local, f);
        else
          multiply_strained(dofs, matrix, model.dim, u, local, f);
      });
  }

  void
  Frame::assemble(const std::vector<MemberLoad> &loads,
                  Eigen::VectorXd               &f) const
  {
    for (std::size_t m = 0; m < members.size(); ++m)
      {
        const Member::Vector forces = members[m].forces(loads[m]);
        for (const unsigned int i : members[m].active_dofs(model.dim))
          f[dof(members[m], i)] += forces[i];
      }
  }

  Member::Vector
  Frame::displacements(const Member &member, const Eigen::VectorXd &u) const
  {
    Member::Vector all = Member::Vector::Zero();
    for (const unsigned int i : member.active_dofs(model.dim))
      all[i] = u[dof(member, i)];
    return all;
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
      motions.push_back({displacements(member, u), displacements(member, w)});
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
