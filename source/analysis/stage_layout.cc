// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/stage_layout.h"

#include "conetact/base/errors.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace conetact::analysis
{
  namespace
  {
    using Numbers = std::vector<double>;
    using Key     = std::array<double, 3>; ///< contact, body, node

    const std::string layout_name = "contact/points";
    const std::string held_name   = "stages/held";

    /** What laws of contact remember of a node. */
    constexpr std::array<const char *, 11> memory = {{"contact/slipped",
                                                      "contact/worn",
                                                      "contact/packed",
                                                      "contact/broken",
                                                      "contact/parted",
                                                      "contact/opened",
                                                      "wear/error",
                                                      "wear/depth",
                                                      "contact/shorn",
                                                      "contact/removed",
                                                      "contact/receded"}};
    constexpr std::size_t slipped = 0, broken = 3, parted = 4, opened = 5,
                          shorn = 8, receded = 10;
    using Remembered = std::array<double, memory.size()>;

    /** Work against a bond that softens while a support parts it, up to this
     * gap at time t: what it gives back when it closes is part of that. */
    double
    work_of_parting(const pairing::ContactNode &node,
                    const Remembered           &before,
                    const double                gap,
                    const double                t)
    {
      constexpr unsigned int n = 1000;
      if (!node.bond || node.bond->is_brittle())
        return 0;
      pairing::Situation at;
      at.position        = node.position;
      at.t               = t;
      at.slipped         = before[slipped];
      const double least = node.least_opening();
      const double part  = (gap - before[parted]) / n;
      const double whole = node.bond->strength(at) * node.bonded_area();
      double       work  = 0;
      for (unsigned int k = 0; k < n; ++k)
        {
          const double g = before[parted] + (k + .5) * part;
          work +=
            whole * part *
            node.bond->rest(std::max(before[opened], g), before[shorn], least) *
            node.bond->unloading(g, before[opened], least);
        }
      return work;
    }

    /** A contact node of the layout that an archive was written with. */
    struct KeptPoint
    {
      Key         key;
      std::size_t number = 0, n = 0; ///< of unknowns
      std::size_t first        = 0;
      bool        is_candidate = false;
      /** With that of held nodes beside it, which nodes that slide far do not
       * have. */
      double area = 0;
    };

    Numbers
    layout_of(const contact::ContactPoints &points)
    {
      Numbers numbers;
      for (std::size_t i = 0; i < points.all().size(); ++i)
        {
          const contact::ContactPoint &point = points.all()[i];
          for (const double x : {static_cast<double>(point.node->contact),
                                 static_cast<double>(point.node->body),
                                 static_cast<double>(point.node->node),
                                 static_cast<double>(point.dual.size()),
                                 i < points.size() ? 1. : 0.,
                                 point.node->slides ? 0. : point.node->area})
            numbers.push_back(x);
        }
      return numbers;
    }

    std::vector<KeptPoint>
    kept_points(const Numbers &layout)
    {
      std::vector<KeptPoint> points;
      std::size_t            first = 0;
      for (std::size_t k = 0; k + 5 < layout.size(); k += 6)
        {
          KeptPoint point;
          point.key          = {{layout[k], layout[k + 1], layout[k + 2]}};
          point.number       = points.size();
          point.n            = static_cast<std::size_t>(layout[k + 3]);
          point.first        = first;
          point.is_candidate = layout[k + 4] > 0;
          point.area         = layout[k + 5];
          first += point.n;
          points.push_back(point);
        }
      return points;
    }

    /** Nodes that supports hold, which are none of a contact's for a while. */
    std::map<Key, Remembered>
    remembered_nodes(const Numbers &numbers)
    {
      std::map<Key, Remembered> nodes;
      constexpr std::size_t     size = 3 + memory.size();
      for (std::size_t at = 0; at + size <= numbers.size(); at += size)
        {
          const Key key = {{numbers[at], numbers[at + 1], numbers[at + 2]}};
          std::copy_n(numbers.data() + at + 3,
                      memory.size(),
                      nodes[key].data());
        }
      return nodes;
    }

    Key
    key_of(const pairing::ContactNode &node)
    {
      return {{static_cast<double>(node.contact),
               static_cast<double>(node.body),
               static_cast<double>(node.node)}};
    }

    /** From the points of one layout to those of the other. */
    class Translation
    {
    public:
      Translation(const contact::ContactModel &m,
                  const double                 at,
                  Archive                     &kept)
        : model(m)
        , t(at)
        , archive(kept)
        , old(kept_points(kept.get(layout_name)))
        , directions(kept.get("contact/directions"))
        , held(remembered_nodes(held_nodes(kept)))
      {
        std::map<Key, std::size_t> places;
        for (const KeptPoint &point : old)
          places.emplace(point.key, point.number);
        for (const contact::ContactPoint &point : points().all())
          {
            const auto found = places.find(key_of(*point.node));
            before.push_back(found == places.end() ?
                               std::nullopt :
                               std::optional(found->second));
          }
      }

      /** Gaps at the start. A node that takes the part of a held one, or gives
       * it back, is a mean over other nodes from here on. */
      void
      gaps(const std::string &name, const bool candidates)
      {
        if (!archive.has(name))
          return;
        const Numbers kept = archive.get(name);
        Numbers       now;
        for (std::size_t i = 0; i < n_points(candidates); ++i)
          {
            const pairing::ContactNode &node = *points().all()[i].node;
            const auto                  at   = before[i];
            now.push_back(at && old[*at].area == node.area &&
                              *at < kept.size() ?
                            kept[*at] :
                            node.gap);
          }
        archive.put(name, now);
      }

      /** Numbers of each node, `candidates` only or all, zero of those that are
       * new. */
      void
      nodes(const std::string &name,
            const bool         candidates,
            const std::size_t  per_node)
      {
        if (!archive.has(name))
          return;
        const Numbers kept = archive.get(name);
        Numbers       now;
        for (std::size_t i = 0; i < n_points(candidates); ++i)
          for (std::size_t k = 0; k < per_node; ++k)
            {
              const auto at    = before[i];
              const bool is_in = at && per_node * *at + k < kept.size();
              now.push_back(is_in ? kept[per_node * *at + k] : 0.);
            }
        archive.put(name, now);
      }

      /** What is remembered of nodes: those that supports have held have it
       * from before, and those that they hold now leave it here. `u` are the
       * displacements of all unknowns. */
      void
      memories(const Eigen::VectorXd &u)
      {
        std::array<Numbers, memory.size()> now;
        const std::vector<Remembered>      kept = kept_memories();
        for (std::size_t k = 0; k < kept.size(); ++k)
          held[old[k].key] = kept[k];
        for (std::size_t i = 0; i < points().size(); ++i)
          {
            const bool       was_there = before[i] && *before[i] < kept.size();
            const Remembered of_node =
              was_there ? kept[*before[i]] : when_let_go(points()[i], u);
            for (std::size_t m = 0; m < memory.size(); ++m)
              now[m].push_back(of_node[m]);
          }
        for (std::size_t i = 0; i < points().size(); ++i)
          held.erase(key_of(*points()[i].node));
        for (std::size_t m = 0; m < memory.size(); ++m)
          if (archive.has(memory[m]))
            archive.put(memory[m], now[m]);
        put_held();
      }

      /** Components of forces along the unknowns. */
      void
      forces(const std::string &name, const bool candidates)
      {
        const Numbers kept = archive.get(name);
        Numbers       now;
        for (std::size_t i = 0; i < n_points(candidates); ++i)
          {
            const contact::ContactPoint &point = points().all()[i];
            const KeptPoint *const       from =
              before[i] ? &old[*before[i]] : nullptr;
            const bool alike = from != nullptr && from->n == point.dual.size();
            const Tensor<1, 3> force =
              from != nullptr ? force_of(*from, kept) : Tensor<1, 3>();
            for (std::size_t k = 0; k < point.dual.size(); ++k)
              now.push_back(alike ? kept[from->first + k] :
                                    force * point.directions[k]);
          }
        archive.put(name, now);
      }

      void
      new_directions()
      {
        Numbers now;
        for (std::size_t i = 0; i < points().all().size(); ++i)
          {
            const contact::ContactPoint &point = points().all()[i];
            const bool                   alike =
              before[i] && old[*before[i]].n == point.dual.size();
            for (std::size_t k = 0; k < point.directions.size(); ++k)
              for (unsigned int d = 0; d < 3; ++d)
                now.push_back(
                  alike ? directions[3 * (old[*before[i]].first + k) + d] :
                          point.directions[k][d]);
          }
        archive.put("contact/directions", now);
      }

    private:
      std::size_t
      n_points(const bool candidates) const
      {
        return candidates ? points().size() : points().all().size();
      }
      /** Of candidates, which come first. */
      std::vector<Remembered>
      kept_memories() const
      {
        std::vector<Remembered> kept;
        for (const KeptPoint &point : old)
          if (point.is_candidate)
            kept.emplace_back();
        for (std::size_t m = 0; m < memory.size(); ++m)
          if (archive.has(memory[m]))
            for (std::size_t k = 0; k < kept.size(); ++k)
              kept[k][m] = archive.get(memory[m]).at(k);
        return kept;
      }

      /** What a support has parted has opened as by a pull. */
      Remembered
      when_let_go(const contact::ContactPoint &point,
                  const Eigen::VectorXd       &u) const
      {
        const auto found   = held.find(key_of(*point.node));
        Remembered of_node = {};
        if (found != held.end())
          of_node = found->second;
        else if (point.node->gap > 0)
          of_node[opened] = pairing::never_closed;
        if (of_node[opened] == pairing::never_closed)
          return of_node;
        const double gap =
          std::max(0., point.node->gap + of_node[receded] + u[point.normal()]);
        of_node[broken] += work_of_parting(*point.node, of_node, gap, t);
        of_node[parted] = gap;
        of_node[opened] = std::max(of_node[opened], gap);
        return of_node;
      }

      void
      put_held()
      {
        Numbers numbers;
        for (const auto &[key, of_node] : held)
          {
            numbers.insert(numbers.end(), key.begin(), key.end());
            numbers.insert(numbers.end(), of_node.begin(), of_node.end());
          }
        archive.put(held_name, numbers);
      }

      const contact::ContactPoints &
      points() const
      {
        return model.points;
      }

      /** Directions are orthogonal, of any length. */
      Tensor<1, 3>
      force_of(const KeptPoint &point, const Numbers &r) const
      {
        Tensor<1, 3> force;
        for (std::size_t k = 0; k < point.n; ++k)
          {
            const std::size_t at = 3 * (point.first + k);
            AssertIndexRange(at + 2, directions.size());
            const Tensor<1, 3> d(
              {directions[at], directions[at + 1], directions[at + 2]});
            force += r.at(point.first + k) / d.norm_square() * d;
          }
        return force;
      }

      const contact::ContactModel &model;
      const double                 t;
      Archive                     &archive;
      std::vector<KeptPoint>       old;
      Numbers                      directions;
      std::map<Key, Remembered>    held; ///< that are none of the contacts now
      /** Each point's number before, if it was there. */
      std::vector<std::optional<std::size_t>> before;
    };
  } // namespace

  void
  put_layout(const contact::ContactPoints &points, Archive &archive)
  {
    archive.put(layout_name, layout_of(points));
  }

  Numbers
  held_nodes(const Archive &archive)
  {
    return archive.has(held_name) ? archive.get(held_name) : Numbers();
  }

  std::vector<double>
  worn_while_held(const Numbers                           &held,
                  const std::vector<pairing::ContactNode> &nodes)
  {
    const std::map<Key, Remembered> remembered = remembered_nodes(held);
    std::vector<double>             depths;
    for (const pairing::ContactNode &node : nodes)
      {
        const auto found = remembered.find(key_of(node));
        depths.push_back(found == remembered.end() ? 0. :
                                                     found->second[receded]);
      }
    return depths;
  }

  void
  put_held_nodes(const Numbers &held, Archive &archive)
  {
    if (!held.empty())
      archive.put(held_name, held);
  }

  bool
  take_to_layout(const contact::ContactModel &model, Archive &archive)
  {
    const Numbers now = layout_of(model.points);
    // Of other meshes the checkpoint is refused by its sizes.
    if (!archive.has(layout_name) || archive.get(layout_name) == now ||
        archive.get("energies/u").size() !=
          static_cast<std::size_t>(model.coordinates.n_dofs()))
      return false;
    const double    t = archive.get("contact/time").at(0);
    Translation     translation(model, t, archive);
    Eigen::VectorXd u(model.coordinates.n_dofs());
    archive.fill("energies/u", u);
    u = model.relative_displacements(u, t);
    translation.memories(u);
    translation.nodes("contact/states", true, 1);
    translation.gaps("contact/gap", true);
    translation.gaps("rows/gaps", false);
    translation.nodes("rows/states", false, 1);
    for (const char *name : {"rows/u",
                             "rows/du",
                             "rows/reactions",
                             "rows/other",
                             "energies/reactions"})
      translation.nodes(name, false, 3);
    // by the rows of this layout: nodes may act for others than before
    archive.put("contact/q", u);
    translation.forces("contact/r", true);
    translation.forces("energies/r", false);
    translation.new_directions();
    archive.put("energies/points",
                static_cast<double>(model.points.all().size()));
    archive.put("contact/elastic", Numbers());
    return true;
  }
} // namespace conetact::analysis
