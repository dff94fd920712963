// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/shared_nodes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace conetact::pairing
{
  namespace
  {
    using Weights = std::vector<std::pair<unsigned int, double>>;

    Weights
    mean(const Weights &first,
         const double   first_part,
         const Weights &second,
         const double   second_part)
    {
      std::map<unsigned int, double> sum;
      for (const auto &[node, weight] : first)
        sum[node] += first_part * weight;
      for (const auto &[node, weight] : second)
        sum[node] += second_part * weight;
      return {sum.begin(), sum.end()};
    }

    /** Faces that two contacts bind both are held twice, as was asked for. */
    bool
    have_other_faces(const Contact &one, const Contact &two)
    {
      return std::none_of(one.ids.begin(), one.ids.end(), [&](const auto id) {
        return std::find(two.ids.begin(), two.ids.end(), id) != two.ids.end();
      });
    }

    Weights
    own_side(const ContactNode &node)
    {
      Weights weights;
      for_each_slave(node, [&](const unsigned int slave, const double weight) {
        weights.emplace_back(slave, weight);
      });
      return weights;
    }

    bool
    are_one(const ContactNode          &first,
            const ContactNode          &second,
            const std::vector<Contact> &contacts)
    {
      const Contact &one = contacts[first.contact];
      const Contact &two = contacts[second.contact];
      return !first.masters.empty() && !second.masters.empty() &&
             first.master == second.master && one.kind == two.kind &&
             one.pairing == two.pairing && !one.slides && !two.slides &&
             !one.gap && !two.gap && !one.preload && !two.preload &&
             have_other_faces(one, two) &&
             first.n * second.n >
               std::cos(std::min(one.sharp_edge, two.sharp_edge));
    }

    void
    unite(ContactNode &whole, const ContactNode &part, const unsigned int dim)
    {
      const double area = whole.area + part.area;
      const double a    = area > 0 ? whole.area / area : .5;
      const double b    = 1 - a;
      whole.masters     = mean(whole.masters, a, part.masters, b);
      if (!whole.slaves.empty() || !part.slaves.empty())
        whole.slaves = mean(own_side(whole), a, own_side(part), b);
      whole.gap     = a * whole.gap + b * part.gap;
      whole.area    = area;
      whole.spacing = std::max(whole.spacing, part.spacing);
      whole.mu_1    = a * whole.mu_1 + b * part.mu_1;
      whole.mu_2    = a * whole.mu_2 + b * part.mu_2;
      whole.outward.insert(whole.outward.end(),
                           part.outward.begin(),
                           part.outward.end());
      const Tensor<1, 3> normal = a * whole.n + b * part.n;
      set_frame(whole, normal / normal.norm(), dim);
    }
  } // namespace

  void
  unite_shared(const std::vector<Contact> &contacts,
               const unsigned int          dim,
               std::vector<ContactNode>   &nodes)
  {
    std::multimap<std::pair<unsigned int, unsigned int>, std::size_t> known;
    std::vector<ContactNode>                                          united;
    for (ContactNode &node : nodes)
      {
        const auto key          = std::make_pair(node.body, node.node);
        const auto [begin, end] = known.equal_range(key);
        const auto whole = std::find_if(begin, end, [&](const auto &other) {
          return are_one(united[other.second], node, contacts);
        });
        if (whole != end)
          unite(united[whole->second], node, dim);
        else
          {
            known.emplace(key, united.size());
            united.push_back(std::move(node));
          }
      }
    nodes = std::move(united);
  }

  unsigned int
  n_shared(const unsigned int              contact,
           const unsigned int              n_paired,
           const std::vector<ContactNode> &nodes)
  {
    std::set<unsigned int> own;
    for (const ContactNode &node : nodes)
      if (node.contact == contact && !node.meets_nothing())
        own.insert(node.node);
    return n_paired > own.size() ?
             n_paired - static_cast<unsigned int>(own.size()) :
             0;
  }
} // namespace conetact::pairing
