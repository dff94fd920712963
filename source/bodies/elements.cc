// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/elements.h"

#include <algorithm>

namespace conetact::bodies
{
  namespace
  {
    bool
    has_some(const std::vector<unsigned int> &dofs,
             const unsigned int               n_components,
             const SomeNodes                 &nodes)
    {
      return std::any_of(dofs.begin(), dofs.end(), [&](const unsigned int dof) {
        return nodes[dof / n_components];
      });
    }
  } // namespace

  void
  Elements::for_each_at(const SomeNodes      &nodes,
                        const ElementVisitor &visit) const
  {
    for_each([&](const std::vector<unsigned int> &dofs, const double *matrix) {
      if (has_some(dofs, dofs_of_node, nodes))
        visit(dofs, matrix);
    });
  }

  void
  Elements::for_each_connection_at(const SomeNodes         &nodes,
                                   const ConnectionVisitor &visit) const
  {
    for_each_connection([&](const std::vector<unsigned int> &dofs) {
      if (has_some(dofs, dofs_of_node, nodes))
        visit(dofs);
    });
  }

  std::size_t
  Elements::add_forces_at(const SomeNodes & /*nodes*/,
                          const Eigen::VectorXd &u,
                          Eigen::VectorXd       &f) const
  {
    add_forces(u, f);
    std::size_t n = 0;
    for_each_connection([&n](const std::vector<unsigned int> &) { ++n; });
    return n;
  }
} // namespace conetact::bodies
