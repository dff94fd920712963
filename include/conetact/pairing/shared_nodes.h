// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_shared_nodes_h
#define conetact_pairing_shared_nodes_h

#include "conetact/pairing/contact_nodes.h"

#include <map>
#include <utility>
#include <vector>

namespace conetact::pairing
{
  /**
   * Makes one of nodes that two contacts share at a seam, as where a face from
   * CAD is split: the same node of a body, against the same master, along
   * normals that differ by less than a sharp edge. Two rows for it would leave
   * open which of them carries what. It becomes what one contact with the faces
   * of both would have, with means over the areas of both, of friction
   * coefficients, too, and is a node of the first of them. Nodes come as their
   * pairings find them, and ContactNode::is_mean tells means of mortar from
   * edges that meet a face; it is that of whole contacts afterwards. Returns
   * how many of the nodes of each contact that meet something have become nodes
   * of contacts before it.
   */
  std::vector<unsigned int>
  unite_shared(const std::vector<Contact>                   &contacts,
               const std::vector<const bodies::Structure *> &structures,
               const unsigned int                            dim,
               std::vector<ContactNode>                     &nodes);

  /** Adds what another contact finds for the same node to what one finds. */
  void
  unite_places(ContactNode       &whole,
               const ContactNode &part,
               const unsigned int dim);

  /**
   * Which of all nodes those are that each contact of two bodies that slides
   * finds: nodes that were made one at the start stay so.
   */
  class SharedNodes
  {
  public:
    /** `nodes`: of all contacts at the start, those that are shared as one. */
    SharedNodes(const std::vector<Contact>                   &contacts,
                const std::vector<const bodies::Structure *> &structures,
                const std::vector<ContactNode>               &nodes);

    /** Numbers of the nodes of a contact, in the order in which it finds them,
     * with those that belong to other contacts. */
    const std::vector<std::size_t> &
    of(const unsigned int contact) const
    {
      return found[contact];
    }
    /** The contact to which a node of a contact belongs. */
    unsigned int
    owner(const unsigned int contact, const unsigned int node) const;

  private:
    std::vector<std::vector<std::size_t>> found; ///< of each contact
    /// of nodes of others: contact, node
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> owners;
  };
} // namespace conetact::pairing

#endif
