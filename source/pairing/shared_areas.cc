// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/shared_areas.h"

#include "conetact/pairing/master_surface.h"
#include "conetact/pairing/node_to_face.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace conetact::pairing
{
  namespace
  {
    /** Contacts of the same faces, along one normal. */
    bool
    share(const ContactNode          &first,
          const ContactNode          &second,
          const std::vector<Contact> &contacts)
    {
      const Contact &one = contacts[first.contact];
      const Contact &two = contacts[second.contact];
      return first.contact != second.contact && one.ids == two.ids &&
             first.slides == second.slides &&
             first.n * second.n >
               std::cos(std::min(one.sharp_edge, two.sharp_edge));
    }

    /** Groups rows of one node that share its faces. Means over faces need no
     * sharing: they have the area that they cover. */
    std::vector<std::vector<std::size_t>>
    groups_of(const std::vector<Contact>     &contacts,
              const bool                      only_sliding,
              const std::vector<ContactNode> &nodes)
    {
      std::map<std::pair<unsigned int, unsigned int>, std::vector<std::size_t>>
        rows;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if ((nodes[i].slides || !only_sliding) &&
            nodes[i].obstacle == nullptr && !nodes[i].is_mean &&
            !nodes[i].masters.empty() && nodes[i].slaves.empty() &&
            !nodes[i].outward.empty())
          rows[{nodes[i].body, nodes[i].node}].push_back(i);
      std::vector<std::vector<std::size_t>> groups;
      for (auto &[node, left] : rows)
        while (left.size() > 1)
          {
            std::vector<std::size_t> group, others;
            for (const std::size_t i : left)
              (group.empty() || share(nodes[group[0]], nodes[i], contacts) ?
                 group :
                 others)
                .push_back(i);
            if (group.size() > 1)
              groups.push_back(std::move(group));
            left = std::move(others);
          }
      return groups;
    }

    /** The faces of a contact and its master. */
    class Sides
    {
    public:
      Sides(const Contact                                &c,
            const std::vector<const bodies::Structure *> &structures)
        : contact(c)
        , slave(*structures[contact.body],
                structures[contact.body]->surface(contact.ids))
        , master(*structures[contact.master], contact.master_ids)
      {
        for (std::size_t f = 0; f < slave.all().size(); ++f)
          for (const unsigned int node : slave.all()[f].nodes)
            faces_at.emplace(node, f);
      }

      /**
       * The part of a row's faces that is over the master. A face counts, with
       * its area, where a point on half of the way from the node to its middle
       * has a foot: the node itself has one in each contact.
       */
      double
      seen(const ContactNode &row, const Point<3> &p) const
      {
        constexpr double half   = .5; // of the way to the middle of a face
        const double     cosine = std::cos(contact.largest_angle);
        double           whole = 0, sum = 0;
        const auto [begin, end] = faces_at.equal_range(row.node);
        for (auto at = begin; at != end; ++at)
          {
            const FaceNet::Face &face = slave.all()[at->second];
            // A face that does not look at what is met is no part of the row,
            // and of its area neither.
            if (-(face.outward * row.n) < cosine)
              continue;
            const double area = face_area(face.corners);
            whole += area;
            if (master.foot(p + half * (face.centre - p),
                            {face.outward},
                            {contact.reach,
                             cosine,
                             interference_allowed(contact, face.size),
                             contact.body != contact.master}))
              sum += area;
          }
        return whole > 0 ? sum / whole : 0;
      }

    private:
      const Contact                           &contact;
      FaceNet                                  slave;
      MasterSurface                            master;
      std::multimap<unsigned int, std::size_t> faces_at; ///< nodes
    };
  } // namespace

  namespace
  {
    /**
     * Gives ties the area of contacts that touch beside them in the same node:
     * where both meet the same master along one normal the tie carries both,
     * for the contact has no gap of its own.
     */
    void
    give_to_ties(const std::vector<Contact> &contacts,
                 std::vector<ContactNode>   &nodes)
    {
      std::multimap<std::pair<unsigned int, unsigned int>, ContactNode *> ties;
      const auto is_alone = [](const ContactNode &node) {
        return !node.is_mean && !node.slides && !node.masters.empty();
      };
      for (ContactNode &node : nodes)
        if (node.is_tied() && is_alone(node) && !node.opening)
          ties.emplace(std::make_pair(node.body, node.node), &node);
      if (ties.empty())
        return;
      for (const ContactNode &node : nodes)
        if (!node.is_bound() && is_alone(node))
          {
            const auto [begin, end] = ties.equal_range({node.body, node.node});
            for (auto tie = begin; tie != end; ++tie)
              if (ContactNode &by = *tie->second;
                  by.master == node.master &&
                  contacts[node.contact].ids != contacts[by.contact].ids &&
                  by.n * node.n > std::cos(contacts[by.contact].sharp_edge))
                {
                  by.area += node.area;
                  break;
                }
          }
    }
  } // namespace

  void
  share_areas(const std::vector<Contact>                   &contacts,
              const std::vector<const bodies::Structure *> &structures,
              const bool                                    only_sliding,
              std::vector<ContactNode>                     &nodes)
  {
    std::map<unsigned int, std::unique_ptr<Sides>> sides; // of contacts
    for (const std::vector<std::size_t> &group :
         groups_of(contacts, only_sliding, nodes))
      for (const std::size_t i : group)
        {
          ContactNode            &row = nodes[i];
          std::unique_ptr<Sides> &of  = sides[row.contact];
          if (!of)
            of = std::make_unique<Sides>(contacts[row.contact], structures);
          // An edge of which no face sees the master keeps the area that it
          // has.
          if (const double part =
                of->seen(row, structures[row.body]->position(row.node));
              part > 0)
            row.area *= part;
        }
    if (!only_sliding)
      give_to_ties(contacts, nodes);
  }
} // namespace conetact::pairing
