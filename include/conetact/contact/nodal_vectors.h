// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_nodal_vectors_h
#define conetact_contact_nodal_vectors_h

#include "conetact/contact/node_rules.h"

#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace conetact::contact
{
  /**
   * Vectors of all dofs of all bodies, body after body and node after node:
   * where a node has its own, and how they look in space, from which the frames
   * of bodies that turn differ.
   */
  class NodalVectors
  {
  public:
    /** The bodies must outlive the object. */
    explicit NodalVectors(const model::Bodies &bodies);

    Eigen::Index
    n_dofs() const
    {
      return dof_offset.back();
    }
    /** First dof of a body in u. */
    Eigen::Index
    offset(const std::size_t body) const
    {
      return dof_offset[body];
    }
    /** First dof of a node in u. */
    Eigen::Index
    dof(const unsigned int body, const unsigned int node) const;

    unsigned int
    n_nodes() const
    {
      return node_offset.back();
    }
    /** The number of a node among those of all bodies. */
    unsigned int
    number(const unsigned int body, const unsigned int node) const
    {
      return node_offset[body] + node;
    }
    /** Body and node of such a number. */
    std::pair<unsigned int, unsigned int>
    locate(const unsigned int node) const;

    /** The displacement of a node, from u of all dofs. */
    Tensor<1, 3>
    at_node(const Eigen::VectorXd &u,
            const unsigned int     body,
            const unsigned int     node) const;

    /** Displacements of all dofs in space, from those in the frames of bodies;
     * the inverse; and the same of forces. Empty vectors stay empty. */
    Eigen::VectorXd
    displacements(Eigen::VectorXd u) const;
    Eigen::VectorXd
    in_frames(Eigen::VectorXd u) const;
    Eigen::VectorXd
    forces_in_space(Eigen::VectorXd f) const;
    Eigen::VectorXd
    forces_in_frames(Eigen::VectorXd f) const;

  protected:
    /** The way of component c of a node of a rigid body by dof k of its first
     * node. */
    double
    way_by_first(const unsigned int body,
                 const unsigned int node,
                 const unsigned int c,
                 const unsigned int k) const;
    /** Moves nodal forces on a rigid body with their moments to its first
     * node. */
    void
    gather_rigid(const unsigned int body, Eigen::VectorXd &f) const;

    const model::Bodies &bodies;

  private:
    using NodeMap = std::function<Tensor<1, 3>(const unsigned int body,
                                               const unsigned int node,
                                               const Tensor<1, 3> &)>;
    using TurnMap = std::function<Tensor<1, 3>(const unsigned int body,
                                               const Tensor<1, 3> &)>;
    /** Without frames nothing happens. Rotations and moments of free obstacles
     * have a map of their own. */
    Eigen::VectorXd
    map_nodes(Eigen::VectorXd &&x,
              const NodeMap    &map,
              const TurnMap    &map_turn) const;

    std::vector<Eigen::Index> dof_offset;
    std::vector<unsigned int> node_offset;
  };
} // namespace conetact::contact

#endif
