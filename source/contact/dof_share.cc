// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/dof_share.h"

#include "conetact/base/team.h"

namespace conetact::contact
{
  namespace
  {
    /**
     * Whether rows of a node need no other nodes: those that hang, points of
     * rigid bodies and frames take sums over nodes that other processes may
     * have.
     */
    bool
    stand_alone(const model::Bodies &bodies, const Coordinates &plain)
    {
      const auto &rules = plain.rules().rules();
      return bodies.frames.empty() &&
             bodies.n_elastic() == bodies.structures.size() &&
             std::all_of(rules.begin(), rules.end(), [](const NodeRule &rule) {
               return rule.masters.empty();
             });
    }
  } // namespace



  DofShare::DofShare(const model::Bodies &b, const Coordinates &plain)
    : bodies(b)
    , coordinates(plain)
    , processes(stand_alone(b, plain) ? team() : Communicator())
  {
    const auto dof_of = [&](const unsigned int n) {
      if (n == coordinates.n_nodes())
        return coordinates.n_dofs();
      const auto [body, node] = coordinates.locate(n);
      return coordinates.dof(body, node);
    };
    const auto [begin, end] = share_of(coordinates.n_nodes(), processes);
    first_node              = static_cast<unsigned int>(begin);
    last_node               = static_cast<unsigned int>(end);
    first                   = dof_of(first_node);
    last                    = dof_of(last_node);
  }



  SomeNodesOfBodies
  DofShare::nodes() const
  {
    SomeNodesOfBodies nodes;
    unsigned int      n = 0;
    for (const bodies::Structure *structure : bodies.structures)
      {
        bodies::SomeNodes of_body(structure->n_nodes());
        for (unsigned int i = 0; i < structure->n_nodes(); ++i, ++n)
          of_body[i] = n >= first_node && n < last_node;
        nodes.push_back(std::move(of_body));
      }
    return nodes;
  }



  /* A column for each process: all of them add up and compare in the order of
     ranks, so that results are the same to the last bit. */
  Eigen::MatrixXd
  DofShare::columns(const Array &own) const
  {
    const Array all = processes.gather_all(own);
    return Eigen::Map<const Eigen::MatrixXd>(all.data(),
                                             own.size(),
                                             processes.size());
  }



  DofShare::Array
  DofShare::sum(const Array &own) const
  {
    const Eigen::MatrixXd all    = columns(own);
    Array                 result = Array::Zero(own.size());
    for (Index p = 0; p < all.cols(); ++p)
      result += all.col(p);
    return result;
  }



  DofShare::Array
  DofShare::largest(const Array &own) const
  {
    return own.size() == 0 ? own : Array(columns(own).rowwise().maxCoeff());
  }
} // namespace conetact::contact
