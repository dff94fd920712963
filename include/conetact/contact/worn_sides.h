// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_worn_sides_h
#define conetact_contact_worn_sides_h

#include "conetact/pairing/contact_nodes.h"

#include <Eigen/Core>

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace conetact::contact
{
  /**
   * Surfaces of master bodies that wear: their depth is a field over their own
   * nodes, @f$\sum_j d_j N_j@f$, which stays where it is when others slide over
   * it. A volume that is lost at a contact node goes to the nodes that it faces
   * by its weights, @f$d_j \mathrel{+}= w_j V / \int N_j@f$, so that
   * @f$\sum_j d_j \int N_j@f$ is the whole volume; what a contact node sees of
   * the field is @f$\sum_j w_j d_j@f$. Contacts that share boundary ids of a
   * master share its field.
   */
  class WornSides
  {
  public:
    WornSides(const std::vector<pairing::Contact>          &contacts,
              const std::vector<const bodies::Structure *> &structures);

    /** Of all surfaces. */
    Eigen::Index
    n_nodes() const
    {
      return static_cast<Eigen::Index>(nodes.size());
    }
    /** A node of a master, and the integral of its function [length^2]. */
    struct Node
    {
      unsigned int body, node;
      double       area;
    };
    const Node &
    operator[](const Eigen::Index i) const
    {
      return nodes[static_cast<std::size_t>(i)];
    }

    /** Whether what wears off the other side of a contact is part of a field;
     * else it stays with the nodes of the slave, as of an obstacle. */
    bool
    keeps(const unsigned int contact) const
    {
      return contact < wearing.size() && wearing[contact];
    }
    /** The depth that a contact node faces, of those of all nodes [length]. */
    double
    faced(const pairing::ContactNode &node,
          const Eigen::VectorXd      &depths) const;
    /** That of one node of the master of a contact; 0 where it has none. */
    double
    depth(const unsigned int     contact,
          const unsigned int     master,
          const Eigen::VectorXd &depths) const;
    /** A volume that is lost where a contact node stands [length^3]. */
    void
    take(const pairing::ContactNode &node,
         const double                volume,
         Eigen::VectorXd            &depths) const;

  private:
    using Numbers = std::map<unsigned int, Eigen::Index>;
    /** Numbers the nodes of a surface. */
    std::shared_ptr<const Numbers>
    add_surface(const unsigned int         body,
                const bodies::Structure   &structure,
                const bodies::BoundaryIds &ids);
    /** Numbers and weights of the master's nodes that a contact node faces. */
    std::vector<std::pair<Eigen::Index, double>>
    on_surface(const pairing::ContactNode &node) const;
    const Numbers *
    numbers_of(const unsigned int contact) const
    {
      return contact < sides.size() ? sides[contact].get() : nullptr;
    }

    std::vector<Node> nodes;
    /** Of each contact: the numbers of its master's nodes, or none. */
    std::vector<std::shared_ptr<const Numbers>> sides;
    std::vector<bool>                           wearing; ///< contacts
  };
} // namespace conetact::contact

#endif
