// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_sliding_h
#define conetact_pairing_sliding_h

#include "conetact/pairing/body_way.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/faces_on_obstacle.h"
#include "conetact/pairing/passages.h"
#include "conetact/pairing/shared_nodes.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace conetact::pairing
{
  /**
   * Finite sliding: contact nodes are found again where bodies and obstacles
   * are. A node whose displacement relative to its opponent is u_k finds the
   * gap g_k and the normal n there; near it
   * @f[ g(u) = g_k + n \cdot (u - u_k) = (g_k - n \cdot u_k) + n \cdot u : @f]
   * a contact as of undeformed bodies with another gap, another frame and
   * other masters, which is all that others see of it. Found again at the
   * solution, it is solved once more, until nothing changes (Newton's method
   * for the gap; normals and masters follow).
   */
  class SlidingContacts
  {
  public:
    /** Displacement of a node of a body [length]. */
    using Displacement = std::function<Tensor<1, 3>(const unsigned int body,
                                                    const unsigned int node)>;

    /**
     * `at_start`: all nodes of the contacts, where bodies are undeformed.
     * Contacts and structures must outlive the object.
     */
    SlidingContacts(const std::vector<Contact>                   &contacts,
                    const std::vector<const bodies::Structure *> &structures,
                    const std::vector<ContactNode>               &at_start,
                    const unsigned int                            dim);

    const Contact &
    contact(const unsigned int number) const
    {
      return contacts[number];
    }
    /** Whether no contact slides far. */
    bool
    empty() const;

    /** Contact nodes, or why they are not found, a sentence without its stop.
     */
    struct Found
    {
      std::vector<ContactNode> nodes;
      std::string              why_not = {};
    };
    /**
     * All contact nodes as they are at time t, in their order, from those that
     * were found last. Nodes that slide have the normal and the gap that they
     * find there; linearise() is still to come. Where `keep_faced`, means over
     * faces keep nodes that faced the master last somewhat longer (mortar.h):
     * for those that are at its rim, and found on either side of it in turn.
     */
    Found
    find(const std::vector<ContactNode> &last,
         const Displacement             &at,
         const double                    t,
         const bool                      keep_faced = false) const;
    /** The same of one node on an obstacle. */
    ContactNode
    find_on_obstacle(ContactNode         node,
                     const Displacement &at,
                     const double        t) const;
    /** A node of a pair that went into the other body. */
    struct PairPassage : Passage
    {
      unsigned int contact, body, node; ///< numbers, of whom the node is
      unsigned int other;               ///< body
      bool         is_slave;            ///< the node is on the slave's side
    };
    /** By which face of the other body a node of one came in: contact, body,
     * node. */
    using Entries = std::map<std::array<unsigned int, 3>, unsigned int>;
    /** Of all pairs that slide, on the ways of their bodies. `inside`: what is
     * in another body at the start, and then at the end. */
    std::vector<PairPassage>
    passages(const std::vector<BodyWay> &ways, Entries &inside) const;

    /** A node of a master that stands in the slave body. */
    struct DeepNode
    {
      unsigned int contact, node; ///< numbers
      double       depth;         ///< over the size of the slave's face
    };
    struct DepthOfMasters
    {
      std::optional<DeepNode> deep; ///< the first one that is too deep
      /// none is before bodies have moved so far to each other [length]
      double clearance;
    };
    /** Whether one is deeper than a part of a face. */
    DepthOfMasters
    master_in_slave(const Displacement &at, const double depth) const;

    /** Frames of these normals, gaps of the linearised contact. */
    void
    linearise(std::vector<ContactNode> &nodes) const;

  private:
    using Structures = std::vector<const bodies::Structure *>;

    DepthOfMasters
    master_in_slave(const unsigned int  contact,
                    const Displacement &at,
                    const double        depth) const;
    /** Returns why not, as what follows. */
    std::string
    find_pairs(const Displacement       &at,
               const bool                keep_faced,
               std::vector<ContactNode> &nodes) const;
    /** Adds what a contact finds for its nodes: those that it shares unite. */
    std::string
    find_pair(const unsigned int                       contact,
              const Structures                        &displaced,
              const bool                               keep_faced,
              const std::vector<ContactNode>          &nodes,
              std::vector<std::optional<ContactNode>> &found) const;

    const std::vector<Contact>             &contacts;
    const Structures                       &structures;
    std::vector<ContactNode>                start;
    SharedNodes                             shared;
    unsigned int                            dim;
    std::map<unsigned int, FacesOnObstacle> on_obstacles; ///< of contacts
  };

  /** What is wrong with contacts that were found before they were solved. */
  struct FoundChange
  {
    double gap   = 0; ///< in parts of a cell
    double force = 0; ///< in parts of the largest reaction
  };
  /**
   * The error of a node, from how it was found for the solution and how it is
   * found there. `u`: its relative displacement as it is found there, `gap`:
   * that of the solution, `share`: its part of the largest reaction, none: it
   * is open. Its actual gap is that found plus n . u. A closed node is off by
   * this gap (with a layer or Active: less that of the solution) over its
   * spacing, and by its share of forces times the turn of the normal or the
   * change of weights, the larger one. An open node is off by how deep it is
   * over its spacing, or by 1e-6 of what its gap misses: an error of open gaps
   * changes no force.
   */
  FoundChange
  change_of(const ContactNode  &solved,
            const ContactNode  &found,
            const Tensor<1, 3> &u,
            const double        gap,
            const double        share);
} // namespace conetact::pairing

#endif
