// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/flatness.h"

#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace conetact::pairing
{
  namespace
  {
    /** Normals that turn by more than 40 degrees, of which this is the cosine,
     * belong to sides of an edge. */
    constexpr double cosine_of_edge = .766;
    /**
     * Normals that differ by less [rad] are those of a plane: friction that a
     * pressed contact has because they turn is about 2.6 times as large a part
     * of the friction that it may have.
     */
    constexpr double flat = 1e-3;

    /** Normals of a surface, grouped where it is smooth. */
    class SmoothNormals
    {
    public:
      std::size_t
      add(const Tensor<1, 3> &normal)
      {
        normals.push_back(normal);
        parents.push_back(parents.size());
        return parents.back();
      }

      /**
       * Joins normals that meet in one place, unless an edge is between them.
       */
      void
      join(const std::size_t a, const std::size_t b)
      {
        if (normals[a] * normals[b] > cosine_of_edge)
          parents[root(a)] = root(b);
      }

      /** How far one of them is from the mean of its group [rad]. */
      double
      spread()
      {
        std::vector<Tensor<1, 3>> sums(normals.size());
        for (std::size_t i = 0; i < normals.size(); ++i)
          sums[root(i)] += normals[i];
        double largest = 0;
        for (std::size_t i = 0; i < normals.size(); ++i)
          {
            const Tensor<1, 3> &sum = sums[root(i)];
            // The chord stands for the angle: they agree where it is small
            // enough to matter.
            largest = std::max(largest, (normals[i] - sum / sum.norm()).norm());
          }
        return largest;
      }

    private:
      std::size_t
      root(std::size_t i)
      {
        while (parents[i] != i)
          i = parents[i] = parents[parents[i]];
        return i;
      }

      std::vector<Tensor<1, 3>> normals;
      std::vector<std::size_t>  parents;
    };

    /** The faces of one side that are met, by their nodes. */
    class Side
    {
    public:
      /** `sign`: of the normals, so that those of both sides agree. */
      Side(const bodies::Surface        &surface,
           const std::set<unsigned int> &met,
           const double                  sign,
           SmoothNormals                &all)
      {
        for (const bodies::SurfaceFace &face : surface.faces)
          if (std::all_of(face.nodes.begin(),
                          face.nodes.end(),
                          [&](const unsigned int i) {
                            return met.count(i) > 0;
                          }))
            add(face, sign, all);
      }

      double
      spread()
      {
        return own.spread();
      }

      /** Numbers among all normals, and the nodes of the faces. */
      struct Face
      {
        std::size_t               number;
        std::vector<unsigned int> nodes;
      };
      const std::vector<Face> &
      at(const unsigned int node) const
      {
        static const std::vector<Face> none;
        const auto                     found = faces_at.find(node);
        return found == faces_at.end() ? none : found->second;
      }

    private:
      void
      add(const bodies::SurfaceFace &face,
          const double               sign,
          SmoothNormals             &all)
      {
        const std::size_t number = all.add(sign * face.normal);
        own_numbers[number]      = own.add(face.normal);
        for (const unsigned int node : face.nodes)
          {
            for (const Face &neighbour : faces_at[node])
              {
                all.join(number, neighbour.number);
                own.join(own_numbers[number], own_numbers[neighbour.number]);
              }
            faces_at[node].push_back({number, face.nodes});
          }
      }

      SmoothNormals                             own;
      std::map<std::size_t, std::size_t>        own_numbers;
      std::map<unsigned int, std::vector<Face>> faces_at;
    };

    /** Compares normals within each side first, then those of faces that face
     * each other: each side may be plane, and both not parallel. */
    std::string
    why_pair_is_not_plane(
      const Contact                                &contact,
      const unsigned int                            number,
      const std::vector<ContactNode>               &nodes,
      const std::vector<const bodies::Structure *> &structures)
    {
      std::vector<std::map<unsigned int, double>> masters;
      std::vector<unsigned int>                   slaves;
      std::set<unsigned int>                      slaves_met, masters_met;
      for (const ContactNode &node : nodes)
        if (node.contact == number && !node.meets_nothing())
          {
            slaves.push_back(node.node);
            masters.emplace_back(node.masters.begin(), node.masters.end());
            slaves_met.insert(node.node);
            for (const auto &[master, weight] : node.masters)
              masters_met.insert(master);
          }
      SmoothNormals both;
      Side          slave(structures[contact.body]->surface(contact.ids),
                 slaves_met,
                 -1,
                 both);
      Side master(structures[contact.master]->surface(contact.master_ids),
                  masters_met,
                  1,
                  both);
      if (master.spread() > flat)
        return "the faces of its master are curved";
      if (slave.spread() > flat)
        return "its faces are curved";
      for (std::size_t i = 0; i < slaves.size(); ++i)
        for (const Side::Face &own : slave.at(slaves[i]))
          for (const auto &[corner, weight] : masters[i])
            for (const Side::Face &other : master.at(corner))
              if (std::all_of(other.nodes.begin(),
                              other.nodes.end(),
                              [&, &met = masters[i]](const unsigned int j) {
                                return met.count(j) > 0;
                              }))
                both.join(own.number, other.number);
      return both.spread() > flat ? "its two sides are not parallel" : "";
    }

    /**
     * How far the normal of an obstacle turns over the distance of a neighbour
     * along a tangent, forth or back: the way on which it turns less counts,
     * for an edge is on one side only.
     */
    double
    turn_along(const ContactNode &node, const Tensor<1, 3> &tangent)
    {
      double least = M_PI;
      for (const double way : {-1., 1.})
        {
          const auto there = node.obstacle->shape->closest_if_any(
            node.position + way * node.spacing * tangent, node.spacing);
          const bool is_edge =
            !there || there->normal * node.n <= cosine_of_edge;
          least =
            std::min(least, is_edge ? 0 : (there->normal - node.n).norm());
        }
      return least;
    }

    std::string
    why_obstacle_is_not_plane(const Contact                  &contact,
                              const unsigned int              number,
                              const std::vector<ContactNode> &nodes,
                              const bodies::Structure        &structure,
                              const unsigned int              dim)
    {
      // A gap that is written down has one normal, wherever bodies go.
      if (contact.obstacle->shape->states_gaps())
        return "";
      const std::string curved =
        "obstacle '" + contact.obstacle->name + "' is curved";
      SmoothNormals                       seen;
      std::map<unsigned int, std::size_t> at;
      std::set<unsigned int>              met;
      for (const ContactNode &node : nodes)
        if (node.contact == number)
          {
            at[node.node] = seen.add(node.n);
            met.insert(node.node);
          }
      for (const bodies::SurfaceFace &face :
           structure.surface(contact.ids).faces)
        for (const unsigned int one : face.nodes)
          for (const unsigned int other : face.nodes)
            if (at.count(one) > 0 && at.count(other) > 0)
              seen.join(at[one], at[other]);
      if (seen.spread() > flat)
        return curved;
      // Few nodes, or a row of them along a cylinder, see one normal.
      const auto is_round = [&](const ContactNode &node) {
        return node.contact == number &&
               (turn_along(node, node.t1) > flat ||
                (dim == 3 && turn_along(node, node.t2) > flat));
      };
      if (std::any_of(nodes.begin(), nodes.end(), is_round))
        return curved;
      // A round body rolls on a plane.
      SmoothNormals all;
      Side          own(structure.surface(contact.ids), met, 1, all);
      return own.spread() > flat ? "its faces are curved" : "";
    }
  } // namespace

  /* A sentence where normals turn as sides slide along each other: small
     kinematics is wrong there by more than a thousandth. Empty: both sides are
     plane and parallel. */
  std::string
  why_not_plane(const Contact                                &contact,
                const unsigned int                            number,
                const std::vector<ContactNode>               &nodes,
                const std::vector<const bodies::Structure *> &structures,
                const unsigned int                            dim)
  {
    return contact.obstacle == nullptr ?
             why_pair_is_not_plane(contact, number, nodes, structures) :
             why_obstacle_is_not_plane(
               contact, number, nodes, *structures[contact.body], dim);
  }
} // namespace conetact::pairing
