// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_coordinates_h
#define conetact_contact_coordinates_h

#include "conetact/contact/contact_axes.h"
#include "conetact/contact/contact_points.h"
#include "conetact/contact/hierarchical_means.h"
#include "conetact/contact/linear_map.h"
#include "conetact/contact/nodal_vectors.h"
#include "conetact/contact/node_rules.h"

#include <Eigen/Core>

#include <deque>
#include <optional>
#include <vector>

namespace conetact::contact
{
  /**
   * The linear map @f$ u = C q + d(t) @f$ from the unknowns q of equilibrium
   * to the displacements u of all dofs of all bodies, body after body. It
   * eliminates supports (along any directions) and hanging nodes; d holds what
   * supports prescribe [length]. With contact points it turns their nodes into
   * their own frames, one at each node (ContactAxes): the unknowns that carry
   * cones come last then, point by point. They are relative to the masters that
   * a node faces, which must face no master themselves. Where they are means
   * over faces of second degree, the surface has the hierarchical basis
   * (hierarchical_means.h). Where they are bound (ties, bilateral contacts)
   * they follow what they face, without unknowns; along what supports hold,
   * they follow these. What opens a tie that a force tightens (Cut) is one
   * unknown for all of its nodes until it is locked. Unknowns of rotations are
   * what they move at the end of an arm. With contact points free obstacles
   * have the unknowns of their first node, which the others follow.
   */
  class Coordinates : public LinearMap, public NodalVectors
  {
  public:
    /** All arguments must outlive the object. */
    Coordinates(const model::Bodies &bodies,
                const NodeRules     &rules,
                const ContactPoints *points = nullptr,
                const double         arm    = 1);

    /** Of contacts, those that have the last unknowns. */
    const ContactAxes &
    contact_axes() const
    {
      return axes;
    }
    /** How the displacement of a node comes about; null: by its own unknowns.
     */
    const NodeRule *
    rule(const unsigned int body, const unsigned int node) const
    {
      return specials[number(body, node)].rule;
    }
    /** Where an unknown comes from. */
    struct Origin
    {
      unsigned int node        = 0; ///< its number
      bool         is_rotation = false;
    };
    std::vector<Origin>
    origins() const;

    /** A displacement of a bound node relative to what it faces. */
    struct BoundDirection
    {
      Eigen::Index dof;     ///< first one of the node
      Eigen::Index unknown; ///< among those of ContactPoints that are bound
      Tensor<1, 3> direction;
    };
    const std::vector<BoundDirection> &
    bound_directions() const
    {
      return all_bound_directions;
    }

    /** The unknowns of displacements u that no support hinders. */
    Eigen::VectorXd
    values(const Eigen::VectorXd &u) const;

    /** d(t). */
    Eigen::VectorXd
    prescribed(const double t) const;
    /** The part of displacements u along what supports hold, as d is one. */
    Eigen::VectorXd
    held_part(const Eigen::VectorXd &u) const;
    /**
     * Moves nodal forces of hanging nodes to their masters, and those on a
     * rigid body with their moments to its first node.
     */
    void
    unhang(Eigen::VectorXd &f) const;

    const NodeRules &
    rules() const
    {
      return node_rules;
    }

  private:
    /** What few nodes have. */
    struct SpecialNode
    {
      const NodeRule     *rule          = nullptr;
      const ContactPoint *point         = nullptr;
      Eigen::Index        first_contact = -1; ///< of its contact unknowns
    };
    class SpecialNodes
    {
    public:
      explicit SpecialNodes(const std::size_t n_nodes)
        : places(n_nodes, -1)
      {}
      const SpecialNode &
      operator[](const std::size_t node) const
      {
        static const SpecialNode nothing;
        const int                k = places[node];
        return k < 0 ? nothing : some[static_cast<std::size_t>(k)];
      }
      SpecialNode &
      make(const std::size_t node)
      {
        int &k = places[node];
        if (k < 0)
          {
            k = static_cast<int>(some.size());
            some.emplace_back();
          }
        return some[static_cast<std::size_t>(k)];
      }

    private:
      std::vector<int>         places; ///< of all nodes, or -1: most
      std::vector<SpecialNode> some;
    };
    /** What a node in the middle of corners has of its own; else null. */
    const HierarchicalMeans::Weights *
    corners(const unsigned int body, const unsigned int node) const
    {
      return means ? means->corners(body, node) : nullptr;
    }
    /** Displacement of a node beside that of its corners, if it has some. */
    Tensor<1, 3>
    own_displacement(const Eigen::VectorXd &u,
                     const unsigned int     body,
                     const unsigned int     node) const;
    /** Whether the nodes of a body have unknowns. */
    bool
    moves(const unsigned int body) const
    {
      return bodies.deforms(body) || opens[body] ||
             (points != nullptr && bodies.is_free_obstacle(body));
    }
    void
    take(const ContactPoint &point);
    void
    bind_middles(const ContactPoint &point, const BoundDirection &own);
    void
    bind(const ContactPoint &point);
    void
    number_unknowns();
    void
    number_node(const unsigned int body, const unsigned int node);
    void
    append_row(const unsigned int body,
               const unsigned int node,
               const unsigned int c,
               const double       factor);
    using Directions = std::vector<Tensor<1, 3>>;
    const Directions *
    free_directions(const std::size_t n) const;
    void
    append_own(const std::size_t n, const unsigned int c, const double factor);
    void
    append_others(const ContactPoint &point,
                  const unsigned int  c,
                  const double        factor);
    void
    append_slaves(const pairing::ContactNode &own, const Tensor<1, 3> &along);
    void
    append_free(const unsigned int body,
                const unsigned int node,
                const unsigned int c,
                const double       factor);
    void
    append_corners(const unsigned int body,
                   const unsigned int node,
                   const unsigned int c,
                   const double       factor);

    const NodeRules     &node_rules;
    const ContactPoints *points;
    const ContactAxes    axes;
    const double         arm;   ///< of rotations [length]
    std::vector<bool>    opens; ///< bodies of open cuts
    SpecialNodes         specials;
    /** With directions in the frames of bodies, dual ones in space; those that
     * are bound but for what is held. */
    std::deque<ContactPoint>         own_points;
    std::vector<BoundDirection>      all_bound_directions;
    std::optional<HierarchicalMeans> means; ///< if contacts are such means

    Eigen::Index n_free = 0;
    CountingList first_unknown; ///< of a node's free ones
    CountingList own_unknown;   ///< of each dof, or -1
  };
} // namespace conetact::contact

#endif
