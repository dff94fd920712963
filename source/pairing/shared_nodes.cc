// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/shared_nodes.h"

#include "conetact/pairing/node_weights.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace conetact::pairing
{
  namespace
  {
    /** Tells whether contacts have no face in common: what two contacts bind
     * both is held twice, as was asked for. */
    bool
    have_other_faces(const Contact &one, const Contact &two)
    {
      return std::none_of(one.ids.begin(), one.ids.end(), [&](const auto id) {
        return std::find(two.ids.begin(), two.ids.end(), id) != two.ids.end();
      });
    }

    /**
     * Tells whether nodes of two contacts may be one: the same bodies meet by
     * the same rules along gaps that geometry gives. What is prescribed may
     * differ on both sides of a seam.
     */
    bool
    may_be_one(const Contact &one, const Contact &two)
    {
      return one.obstacle == nullptr && two.obstacle == nullptr &&
             one.body == two.body && one.master == two.master &&
             one.kind == two.kind && !one.spring &&
             one.pairing == two.pairing && one.slides == two.slides &&
             !one.gap && !two.gap && !one.preload && !two.preload &&
             have_other_faces(one, two);
    }

    bool
    are_one(const ContactNode          &first,
            const ContactNode          &second,
            const std::vector<Contact> &contacts)
    {
      const Contact &one = contacts[first.contact];
      const Contact &two = contacts[second.contact];
      return may_be_one(one, two) &&
             first.n * second.n >
               std::cos(std::min(one.sharp_edge, two.sharp_edge));
    }

    /** The first of all nodes that are the same, for each node: itself, if no
     * other is. */
    std::vector<std::size_t>
    firsts(const std::vector<Contact>     &contacts,
           const std::vector<ContactNode> &nodes)
    {
      std::multimap<std::pair<unsigned int, unsigned int>, std::size_t> known;
      std::vector<std::size_t>                                          first;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        {
          const auto key = std::make_pair(nodes[i].body, nodes[i].node);
          const auto [begin, end] = known.equal_range(key);
          const auto same = std::find_if(begin, end, [&](const auto &other) {
            return are_one(nodes[other.second], nodes[i], contacts);
          });
          first.push_back(same != end ? same->second : i);
          if (same == end)
            known.emplace(key, i);
        }
      return first;
    }

    /**
     * The rank of what a contact has found: one contact with all faces would
     * not look for an edge at a node that faces see (2 before 1), and would not
     * leave a node free that meets the master (1 before 0).
     */
    unsigned int
    rank(const ContactNode &node)
    {
      return node.meets_nothing() ? 0 : node.is_mean ? 2 : 1;
    }
  } // namespace

  void
  unite_places(ContactNode       &whole,
               const ContactNode &part,
               const unsigned int dim)
  {
    AssertDimension(whole.body, part.body);
    AssertDimension(whole.node, part.node);
    // The whole is a times the one and b times the other, in proportion to
    // areas; what has the higher rank counts alone.
    constexpr unsigned int mean_over_faces = 2;
    const unsigned int     of_whole = rank(whole), of_part = rank(part);
    const double           area = whole.area + part.area;
    const double a = of_whole != of_part ? (of_whole > of_part ? 1 : 0) :
                     area > 0            ? whole.area / area :
                                           .5;
    const double b = 1 - a;
    whole.masters  = mean_of(whole.masters, a, part.masters, b);
    if (!whole.slaves.empty() || !part.slaves.empty())
      whole.slaves = mean_of(own_side(whole), a, own_side(part), b);
    whole.gap = a * whole.gap + b * part.gap;
    // The area of means is what they cover, that of a part that faces nothing
    // is none. Single nodes have all the area of their faces.
    whole.area                = std::max(of_whole, of_part) == mean_over_faces ?
                                  (a > 0 ? whole.area : 0) + (b > 0 ? part.area : 0) :
                                  area;
    whole.is_mean             = whole.is_mean || part.is_mean;
    const Tensor<1, 3> normal = a * whole.n + b * part.n;
    set_frame(whole, normal / normal.norm(), dim);
  }

  namespace
  {
    void
    unite(ContactNode &whole, const ContactNode &part, const unsigned int dim)
    {
      const double area = whole.area + part.area;
      const double a    = area > 0 ? whole.area / area : .5;
      // Coefficients are means over both areas. Where either contact has a law
      // its coefficient is a stand-in, and laws have no mean: those of the
      // first contact hold on the area of both.
      if (!whole.friction && !part.friction)
        {
          whole.mu_1 = a * whole.mu_1 + (1 - a) * part.mu_1;
          whole.mu_2 = a * whole.mu_2 + (1 - a) * part.mu_2;
        }
      // Forces at each node: where both contacts have the same, the node has it
      // as in one contact with all faces.
      whole.prestress = a * whole.prestress + (1 - a) * part.prestress;
      whole.cohesion  = a * whole.cohesion + (1 - a) * part.cohesion;
      whole.spacing   = std::max(whole.spacing, part.spacing);
      whole.outward.insert(whole.outward.end(),
                           part.outward.begin(),
                           part.outward.end());
      unite_places(whole, part, dim);
    }
  } // namespace

  /* Two contacts of one pair of bodies have both a row for a node on the seam
     of their faces, along one normal: reactions would be told in their sum
     only. The node stays with the first contact. */
  std::vector<unsigned int>
  unite_shared(const std::vector<Contact>                   &contacts,
               const std::vector<const bodies::Structure *> &structures,
               const unsigned int                            dim,
               std::vector<ContactNode>                     &nodes)
  {
    const std::vector<std::size_t> first = firsts(contacts, nodes);
    std::vector<std::size_t>       place(nodes.size());
    std::vector<ContactNode>       united;
    std::vector<unsigned int>      n_shared(contacts.size(), 0);
    united.reserve(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (first[i] == i)
        {
          place[i] = united.size();
          united.push_back(std::move(nodes[i]));
        }
      else
        {
          n_shared[nodes[i].contact] += !nodes[i].meets_nothing();
          unite(united[place[first[i]]], nodes[i], dim);
        }
    std::vector<bool> takes_means;
    for (const Contact &contact : contacts)
      takes_means.push_back(pairing_of(contact, structures).takes_means);
    for (ContactNode &node : united)
      node.is_mean = takes_means[node.contact];
    nodes = std::move(united);
    return n_shared;
  }

  namespace
  {
    /** Tells whether any two contacts that slide may share nodes. */
    bool
    may_share(const std::vector<Contact> &contacts)
    {
      for (std::size_t i = 0; i < contacts.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (contacts[i].slides && may_be_one(contacts[i], contacts[j]))
            return true;
      return false;
    }

    /** Nodes of contacts of bodies that slide, as each of them finds them. */
    std::vector<ContactNode>
    found_alone(const std::vector<Contact>                   &contacts,
                const std::vector<const bodies::Structure *> &structures)
    {
      std::vector<ContactNode> nodes;
      for (unsigned int c = 0; c < contacts.size(); ++c)
        if (contacts[c].slides && contacts[c].obstacle == nullptr)
          for (ContactNode &node : pairing_of(contacts[c], structures)
                                     .pair(contacts[c], structures)
                                     .nodes)
            {
              node.contact = c;
              nodes.push_back(std::move(node));
            }
      return nodes;
    }
  } // namespace

  SharedNodes::SharedNodes(
    const std::vector<Contact>                   &contacts,
    const std::vector<const bodies::Structure *> &structures,
    const std::vector<ContactNode>               &nodes)
    : found(contacts.size())
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      found[nodes[i].contact].push_back(i);
    if (!may_share(contacts))
      return;
    // Each contact is paired alone once more: in the order in which it will
    // find its nodes each of them gets the number of its own next node, or that
    // of the contact before it with which it was united.
    const std::vector<std::vector<std::size_t>> own = found;
    const auto alone = found_alone(contacts, structures);
    const auto first = firsts(contacts, alone);
    for (unsigned int c = 0; c < contacts.size(); ++c)
      if (contacts[c].slides && contacts[c].obstacle == nullptr)
        found[c].clear();
    std::vector<std::size_t> number(alone.size()), n_own(contacts.size(), 0);
    for (std::size_t i = 0; i < alone.size(); ++i)
      {
        const unsigned int c = alone[i].contact;
        number[i] = first[i] == i ? own[c].at(n_own[c]++) : number[first[i]];
        found[c].push_back(number[i]);
        if (first[i] != i)
          owners[{c, alone[i].node}] = alone[first[i]].contact;
      }
  }

  unsigned int
  SharedNodes::owner(const unsigned int contact, const unsigned int node) const
  {
    AssertIndexRange(contact, found.size());
    const auto of_another = owners.find({contact, node});
    return of_another == owners.end() ? contact : of_another->second;
  }
} // namespace conetact::pairing
