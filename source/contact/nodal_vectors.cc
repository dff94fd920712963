// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/nodal_vectors.h"

#include <deal.II/base/exceptions.h>

namespace conetact::contact
{
  NodalVectors::NodalVectors(const model::Bodies &b)
    : bodies(b)
    , dof_offset(1, 0)
    , node_offset(1, 0)
  {
    for (const bodies::Structure *structure : bodies.structures)
      {
        dof_offset.push_back(dof_offset.back() + structure->n_dofs());
        node_offset.push_back(node_offset.back() + structure->n_nodes());
      }
  }



  Eigen::Index
  NodalVectors::dof(const unsigned int body, const unsigned int node) const
  {
    AssertIndexRange(body, bodies.structures.size());
    AssertIndexRange(node, bodies.structures[body]->n_nodes());
    return dof_offset[body] + node * static_cast<Eigen::Index>(
                                       bodies.structures[body]->n_components());
  }



  /* Bodies are few: they are walked through. */
  std::pair<unsigned int, unsigned int>
  NodalVectors::locate(const unsigned int node) const
  {
    unsigned int body = 0;
    while (node_offset[body + 1] <= node)
      ++body;
    return {body, node - node_offset[body]};
  }



  Tensor<1, 3>
  NodalVectors::at_node(const Eigen::VectorXd &u,
                        const unsigned int     body,
                        const unsigned int     node) const
  {
    AssertDimension(u.size(), n_dofs());
    AssertIndexRange(body, bodies.structures.size());
    Tensor<1, 3>       result;
    const Eigen::Index first = dof(body, node);
    for (unsigned int c = 0; c < bodies.dim; ++c)
      result[c] = u[first + c];
    return result;
  }



  /* Rotations among dofs of bodies stay as they are: a body that has some has a
     frame that does not turn (BodyFrames::may_turn). Of a free obstacle only
     the first node has some. */
  Eigen::VectorXd
  NodalVectors::map_nodes(Eigen::VectorXd &&x,
                          const NodeMap    &map,
                          const TurnMap    &map_turn) const
  {
    Assert(x.size() == n_dofs() || x.size() == 0,
           dealii::ExcMessage("Vectors are those of all dofs, or empty."));
    if (!bodies.frames.empty() && x.size() > 0)
      for (unsigned int body = 0; body < bodies.structures.size(); ++body)
        {
          for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
            {
              const Tensor<1, 3> v = map(body, i, at_node(x, body, i));
              for (unsigned int c = 0; c < bodies.dim; ++c)
                x[dof(body, i) + c] = v[c];
            }
          if (!bodies.is_free_obstacle(body))
            continue;
          auto turn =
            x.segment(dof(body, 0) + bodies.dim, bodies.dim == 2 ? 1 : 3);
          Tensor<1, 3> v;
          for (unsigned int c = 0; c < turn.size(); ++c)
            v[bodies.dim == 2 ? 2 : c] = turn[c];
          v = map_turn(body, v);
          for (unsigned int c = 0; c < turn.size(); ++c)
            turn[c] = v[bodies.dim == 2 ? 2 : c];
        }
    return std::move(x);
  }



  /* From frames to space: u = d + (Q - 1) (X - c) + Q w at each node. */
  Eigen::VectorXd
  NodalVectors::displacements(Eigen::VectorXd u) const
  {
    return map_nodes(
      std::move(u),
      [&](const unsigned int  body,
          const unsigned int  node,
          const Tensor<1, 3> &v) { return bodies.displacement(body, node, v); },
      [&](const unsigned int body, const Tensor<1, 3> &turn) {
        return bodies.frames[body].turn_to_space(turn);
      });
  }



  /* From space to frames, the reverse of displacements(). */
  Eigen::VectorXd
  NodalVectors::in_frames(Eigen::VectorXd u) const
  {
    return map_nodes(
      std::move(u),
      [&](const unsigned int  body,
          const unsigned int  node,
          const Tensor<1, 3> &v) { return bodies.in_frame(body, node, v); },
      [&](const unsigned int body, const Tensor<1, 3> &turn) {
        return bodies.frames[body].turn_to_own(turn);
      });
  }



  namespace
  {
    /** A map of directions, which is the same at all nodes of a body. */
    template <typename Map>
    auto
    at_all_nodes(const Map &map)
    {
      return [&map](const unsigned int body,
                    const unsigned int,
                    const Tensor<1, 3> &v) { return map(body, v); };
    }
  } // namespace

  Eigen::VectorXd
  NodalVectors::forces_in_space(Eigen::VectorXd f) const
  {
    const auto map = [&](const unsigned int body, const Tensor<1, 3> &v) {
      return bodies.in_space(body, v);
    };
    return map_nodes(std::move(f), at_all_nodes(map), map);
  }



  Eigen::VectorXd
  NodalVectors::forces_in_frames(Eigen::VectorXd f) const
  {
    const auto map = [&](const unsigned int body, const Tensor<1, 3> &v) {
      return bodies.in_frame(body, v);
    };
    return map_nodes(std::move(f), at_all_nodes(map), map);
  }



  /* Component c of e_k for translations, of e_k x (x - x_0) for rotations: x_0
     is the first node. */
  double
  NodalVectors::way_by_first(const unsigned int body,
                             const unsigned int node,
                             const unsigned int c,
                             const unsigned int k) const
  {
    const unsigned int dim = bodies.dim;
    if (c >= dim) // other nodes do not rotate
      return 0;
    if (k < dim)
      return c == k ? 1. : 0.;
    Tensor<1, 3> about;
    about[dim == 2 ? 2 : k - dim]       = 1;
    const bodies::Structure &body_there = *bodies.structures[body];
    return cross_product_3d(about,
                            body_there.position(node) -
                              body_there.position(0))[c];
  }



  /* Forces f_i of a rigid body have one resultant at its first node: sum f_i
     and sum (x_i - x_0) x f_i, the transpose of way_by_first(). */
  void
  NodalVectors::gather_rigid(const unsigned int body, Eigen::VectorXd &f) const
  {
    AssertDimension(f.size(), n_dofs());
    AssertIndexRange(body, bodies.structures.size());
    const bodies::Structure &structure = *bodies.structures[body];
    const unsigned int       dim       = bodies.dim;
    const Eigen::Index       first     = dof(body, 0);
    for (unsigned int i = 1; i < structure.n_nodes(); ++i)
      {
        const Tensor<1, 3> force = at_node(f, body, i);
        const Tensor<1, 3> moment =
          cross_product_3d(structure.position(i) - structure.position(0),
                           force);
        for (unsigned int c = 0; c < dim; ++c)
          f[first + c] += force[c];
        for (unsigned int c = dim; c < structure.n_components(); ++c)
          f[first + c] += moment[dim == 2 ? 2 : c - dim];
        f.segment(dof(body, i), dim).setZero();
      }
  }
} // namespace conetact::contact
