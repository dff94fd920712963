// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_node_rules_h
#define conetact_contact_node_rules_h

#include "conetact/pairing/contact_nodes.h"
#include "conetact/structures/actions.h"
#include "conetact/structures/structure.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace conetact
{
  /** The bodies of a scene, what holds them and where they may touch. */
  struct Bodies
  {
    unsigned int                   dim = 2;
    std::vector<std::string>       names;
    std::vector<const Structure *> structures;
    std::vector<Support>           supports;
    std::vector<ContactNode>       contact_nodes;

    /** Bodies that nothing reaches and that are not solved; empty: none. */
    std::vector<bool> at_rest;
    bool
    is_at_rest(const std::size_t body) const
    {
      return body < at_rest.size() && at_rest[body];
    }
  };

  /**
   * Turns the normals of pairs of bodies into the planes of symmetry on which
   * supports hold their nodes. Facets of a curved surface are askew to such a
   * plane by half the angle of a facet, the surface itself is not; normals
   * further off are left to be refused.
   */
  void
  align_with_supports(Bodies &bodies);

  /**
   * Completes orthonormal directions to a basis of space. Axes come first,
   * so that rollers along the axes leave the other axes as they are.
   */
  std::vector<Tensor<1, 3>>
  complement(std::vector<Tensor<1, 3>> basis, const unsigned int dim);

  /** A direction along which supports prescribe a node's displacement. */
  struct HeldDirection
  {
    Tensor<1, 3> direction; ///< unit length
    /** displacement = sum of factor * displacement expression */
    struct Term
    {
      std::size_t support, expression;
      double      factor;
    };
    std::vector<Term> terms;
  };

  /**
   * How the displacement of a node comes about where it is not just its own
   * unknowns: held directions are orthonormal; the rest of space is spanned by
   * `free` (unknowns without a cone) and `contact` (those with one, the normal
   * last). A hanging node has masters and nothing else.
   */
  struct NodeRule
  {
    unsigned int                                 body = 0, node = 0;
    std::vector<HeldDirection>                   held;
    std::vector<std::pair<unsigned int, double>> masters;
    std::vector<Tensor<1, 3>>                    free;
    std::vector<Tensor<1, 3>>                    contact;
    std::vector<Tensor<1, 3>> dual; ///< dual[i].contact[j] = (i == j)
    const ContactNode        *contact_node = nullptr; ///< if `contact` is not
                                                      ///< empty
    double mu = 0; ///< of the cone in the coordinates `contact`

    /** Rotations that supports prescribe, by index into the scene's lists. */
    struct HeldRotation
    {
      unsigned int component; ///< of the node's dofs
      std::size_t  support, rotation;
    };
    std::vector<HeldRotation> rotations;
    bool
    holds_rotation(const unsigned int component) const;

    /**
     * Entry (c, d) of the projection on what no support holds: the part of a
     * master's motion that the node follows.
     */
    double
    left_free(const unsigned int c, const unsigned int d) const;
  };

  /**
   * Collects the rules of all nodes of all bodies from hanging nodes, rigid
   * supports and contact nodes.
   */
  class NodeRules
  {
  public:
    /**
     * Throws InputError where a contact node is held neither along its normal
     * nor in its tangent plane, or where supports that hold a node in the
     * same direction prescribe different displacements at one of `times`.
     * Without contacts, rules are those of the bodies by themselves.
     */
    NodeRules(const Bodies              &bodies,
              const std::vector<double> &times,
              const bool                 with_contacts = true);

    /** Sorted by body and node. */
    const std::vector<NodeRule> &
    rules() const
    {
      return sorted;
    }

    /** What supports prescribe for a rotation at time t [rad]. */
    double
    angle(const NodeRule::HeldRotation &held,
          const Point<3>               &p,
          const double                  t) const;

    /** What supports prescribe along a direction at time t [length]. */
    double
    displacement(const HeldDirection &held,
                 const Point<3>      &p,
                 const double         t) const;

    /** Number of contact nodes whose normal is held by a support. */
    unsigned int
    n_held_contact_nodes() const
    {
      return n_held;
    }

    /**
     * Whether friction acts along directions that supports hold: displacements
     * there are no unknowns, so that contact has no stiffness form.
     */
    bool
    has_prescribed_slip() const
    {
      return prescribed_slip;
    }

  private:
    /** A direction that is held already, with its own displacement. */
    struct Redundant
    {
      unsigned int  body, node;
      HeldDirection held;
    };

    void
    hold(NodeRule &rule, const HeldDirection &direction);
    void
    hold_rotation(NodeRule                     &rule,
                  const NodeRule::HeldRotation &held,
                  const std::vector<double>    &times) const;
    using RuleMap = std::map<std::pair<unsigned int, unsigned int>, NodeRule>;

    /** Whether a node with friction slides along what supports hold. */
    bool
    slides_along_supports(const RuleMap             &rules,
                          const NodeRule            &rule,
                          const ContactNode         &contact_node,
                          const std::vector<double> &times) const;
    void
    add_contact(NodeRule          &rule,
                const ContactNode &contact_node,
                const bool         slides);
    void
    check_redundant(const std::vector<double> &times) const;

    const Bodies          &bodies;
    std::vector<NodeRule>  sorted;
    std::vector<Redundant> redundant;
    unsigned int           n_held          = 0;
    bool                   prescribed_slip = false;
  };
} // namespace conetact

#endif
