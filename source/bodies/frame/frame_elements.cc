// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/frame_elements.h"

#include "conetact/bodies/element_forces.h"

#include <deal.II/base/exceptions.h>

namespace conetact::bodies
{
  FrameElements::FrameElements(const FrameModel          &of,
                               const std::vector<Member> &all,
                               const unsigned int         n_components)
    : Elements(n_components)
    , model(of)
    , members(all)
  {}

  unsigned int
  FrameElements::dof(const Member &member, const unsigned int k) const
  {
    const unsigned int c = k % 6;
    return dofs_of_node * member.nodes()[k / 6] + (c < 3          ? c :
                                                   model.dim == 2 ? 2 :
                                                                    c);
  }

  void
  FrameElements::for_each(const ElementVisitor &visit) const
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
  FrameElements::add_forces(const Eigen::VectorXd &u, Eigen::VectorXd &f) const
  {
    AssertDimension(u.size(), f.size());
    Eigen::VectorXd local;
    for_each([&](const std::vector<unsigned int> &dofs, const double *matrix) {
      if (dofs_of_node > model.dim)
        multiply(dofs, matrix, u, local, f);
      else
        multiply_strained(dofs, matrix, model.dim, u, local, f);
    });
  }

  void
  FrameElements::assemble(const std::vector<MemberLoad> &loads,
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
  FrameElements::displacements(const Member          &member,
                               const Eigen::VectorXd &u) const
  {
    Member::Vector all = Member::Vector::Zero();
    for (const unsigned int i : member.active_dofs(model.dim))
      all[i] = u[dof(member, i)];
    return all;
  }
} // namespace conetact::bodies
