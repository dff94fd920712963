// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_node_rules_h
#define conetact_contact_node_rules_h

#include "conetact/bodies/loads.h"
#include "conetact/model/bodies.h"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace conetact::contact
{
  /**
   * Turns the normals of pairs of bodies into the planes of symmetry on which
   * supports hold their nodes. Facets of a curved surface are askew to such a
   * plane by half the angle of a facet, the surface itself is not; normals
   * further off are left to be refused.
   */
  void
  align_with_supports(const model::Bodies               &bodies,
                      std::vector<pairing::ContactNode> &nodes);

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

  std::vector<Tensor<1, 3>>
  directions(const std::vector<HeldDirection> &held);

  /** Adds what v has beyond the span of orthonormal directions, if anything. */
  void
  add_direction(const Tensor<1, 3> &v, std::vector<Tensor<1, 3>> &orthonormal);

  /** Directions along which rigid supports hold nodes, as the supports give
   * them, by body and node. */
  using SupportedNodes =
    std::map<std::pair<unsigned int, unsigned int>, std::vector<Tensor<1, 3>>>;
  SupportedNodes
  supported_nodes(const model::Bodies &bodies);

  /** Whether v lies in the span of orthonormal directions, or across it. */
  bool
  is_spanned(const Tensor<1, 3>              &v,
             const std::vector<Tensor<1, 3>> &orthonormal);
  bool
  is_across(const Tensor<1, 3>              &v,
            const std::vector<Tensor<1, 3>> &orthonormal);

  /**
   * How the displacement of a node comes about where it is not just its own
   * unknowns: held directions are orthonormal, `free` spans the rest of space.
   * A hanging node has masters and nothing else.
   */
  struct NodeRule
  {
    unsigned int               body = 0, node = 0;
    std::vector<HeldDirection> held;
    /** Of a free obstacle that turns with a body: what is held, in space, where
     * directions are those in its frame. */
    std::vector<Tensor<1, 3>>                    axes;
    std::vector<std::pair<unsigned int, double>> masters;
    std::vector<Tensor<1, 3>>                    free;

    /** Rotations that supports prescribe, by index into the scene's lists. */
    struct HeldRotation
    {
      unsigned int component; ///< of the node's dofs
      std::size_t  support, rotation;
    };
    std::vector<HeldRotation> rotations;
    bool
    holds_rotation(const unsigned int component) const;
  };

  /**
   * Collects the rules of all nodes of all bodies from hanging nodes and rigid
   * supports.
   */
  class NodeRules
  {
  public:
    /**
     * Throws InputError where supports that hold a node in the same direction
     * prescribe different displacements at one of `times`.
     */
    NodeRules(const model::Bodies &bodies, const std::vector<double> &times);

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
    /** The same of a node, in the frame of its body. */
    double
    displacement(const NodeRule      &rule,
                 const HeldDirection &held,
                 const double         t) const;

    /** Axes of the scene that supports hold obstacles along, in the frames of
     * these as they stand now. Returns whether any has turned. */
    bool
    turn_with_frames();

    /** The rule of a node; null: it has none. */
    const NodeRule *
    find(const unsigned int body, const unsigned int node) const;

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
    void
    check_redundant(const std::vector<double> &times) const;

    const model::Bodies   &bodies;
    std::vector<NodeRule>  sorted;
    std::vector<Redundant> redundant;
  };
} // namespace conetact::contact

#endif
