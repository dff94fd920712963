// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Loads of class Frame: all of them become loads of its members or forces of
// its nodes.

#include "conetact/bodies/frame/frame.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace conetact::bodies
{
  namespace
  {
    /** How far off its axis, in lengths, a point may be by round-off. */
    constexpr double point_tolerance = 1e-6;

    /** Mean of the strain along the axis of a member. */
    double
    mean(const Member &member, const InitialStrainField &field)
    {
      static const dealii::QGauss<1> gauss(3);
      const Tensor<1, 3>             along = member.axis(0);
      double                         sum   = 0;
      for (unsigned int q = 0; q < gauss.size(); ++q)
        sum +=
          gauss.weight(q) * (along * (field(member.point(gauss.point(q)[0]))
                                        .of(member.section().expansion) *
                                      along));
      return sum;
    }
  } // namespace

  unsigned int
  Frame::node_at(const Point<3> &p) const
  {
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (position(i).distance(p) <= 1e-9 * size)
        return i;
    return n_nodes();
  }

  void
  Frame::add_point(const Point<3>          &p,
                   const Tensor<1, 3>      &force,
                   std::vector<MemberLoad> &loads) const
  {
    for (std::size_t m = 0; m < members.size(); ++m)
      {
        const Member &member = members[m];
        const double  place =
          (p - member.point(0)) * member.axis(0) / member.length();
        if (place > 0 && place < 1 &&
            member.point(place).distance(p) <=
              point_tolerance * member.length())
          {
            loads[m].points.emplace_back(place, force);
            return;
          }
      }
  }

  std::vector<MemberLoad>
  Frame::member_loads(const Actions &actions) const
  {
    using Kind = Action::Kind;
    std::vector<MemberLoad> loads(members.size());
    for (const Action &action : actions)
      for (std::size_t m = 0; m < members.size(); ++m)
        {
          const Member       &member  = members[m];
          const FrameSection &section = member.section();
          const Tensor<1, 3>  normal  = face_normal(member);
          const auto          add     = [&](const double factor) {
            loads[m].per_length.push_back(
              [factor, normal, force = action.force](const Point<3> &p) {
                return factor * force(p, normal);
              });
          };
          const auto &nodes = model.nodes;
          if (action.kind == Kind::body_force)
            add(section.area);
          else if (action.kind == Kind::line_load && carries(m, action.ids))
            add(1);
          else if (action.kind == Kind::traction && carries(m, action.ids) &&
                   !(nodes[member.nodes()[0]].area > 0))
            add(section.width);
          else if (action.kind == Kind::initial_strain)
            loads[m].initial_strain += mean(member, action.strain);
        }
    for (const Action &action : actions)
      if (action.kind == Kind::point_force &&
          node_at(action.point) == n_nodes())
        add_point(action.point,
                  action.force(action.point, Tensor<1, 3>()),
                  loads);
    return loads;
  }

  /* What acts between the nodes of members, and at nodes without a member that
     takes it. */
  bool
  Frame::add(const Action &action, Eigen::VectorXd &f) const
  {
    const std::vector<MemberLoad> loads = member_loads({action});
    of_members.assemble(loads, f);
    const auto add_to = [&](const unsigned int  node,
                            const Tensor<1, 3> &force) {
      for (unsigned int c = 0; c < model.dim; ++c)
        f[n_components() * node + c] += force[c];
    };
    if (action.kind == Action::Kind::point_force)
      {
        const unsigned int node = node_at(action.point);
        if (node < n_nodes())
          add_to(node, action.force(action.point, Tensor<1, 3>()));
        return node < n_nodes() ||
               std::any_of(loads.begin(), loads.end(), [](const auto &load) {
                 return !load.points.empty();
               });
      }
    if (action.kind != Action::Kind::traction)
      return action.kind != Action::Kind::line_load ||
             !surface(action.ids).faces.empty();
    const Surface     on = surface(action.ids);
    std::vector<bool> by_member(n_nodes(), false);
    for (const SurfaceFace &face : on.faces)
      for (const unsigned int node : face.nodes)
        by_member[node] = !(model.nodes[node].area > 0);
    for (const SurfaceNode &node : on.nodes)
      if (!by_member[node.node])
        add_to(node.node, node.area * action.force(node.position, node.normal));
    return true;
  }

  bool
  Frame::expands() const
  {
    return std::any_of(members.begin(), members.end(), [](const Member &m) {
      return m.section().expansion != 0;
    });
  }

  void
  Frame::visit_springs(const BoundaryIds        &ids,
                       const SurfaceTensorField &stiffness,
                       const ElementVisitor     &visit) const
  {
    const unsigned int        dim = model.dim;
    std::vector<unsigned int> dofs(dim);
    std::vector<double>       matrix(dim * dim);
    for (const SurfaceNode &node : surface(ids).nodes)
      {
        const Tensor<2, 3> k =
          node.area * stiffness(node.position, node.normal);
        for (unsigned int i = 0; i < dim; ++i)
          {
            dofs[i] = n_components() * node.node + i;
            for (unsigned int j = 0; j < dim; ++j)
              matrix[i * dim + j] = k[i][j];
          }
        visit(dofs, matrix.data());
      }
  }
} // namespace conetact::bodies
