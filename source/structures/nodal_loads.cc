// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/structures/nodal_loads.h"

namespace conetact
{
  namespace
  {
    /** Nodal forces that are kept: 256 MB of them. */
    constexpr Eigen::Index most_kept = 1 << 24;
  } // namespace



  NodalLoads::NodalLoads(const std::vector<Load>              &all_loads,
                         const std::vector<const Structure *> &bodies)
    : loads(all_loads)
    , structures(bodies)
    , kept(loads.size())
    , room(most_kept)
  {}



  Eigen::VectorXd
  NodalLoads::at(const double t)
  {
    std::vector<Eigen::Index> begin(1, 0);
    for (const Structure *structure : structures)
      begin.push_back(begin.back() + structure->n_dofs());
    Eigen::VectorXd all = Eigen::VectorXd::Zero(begin.back()), f;
    for (std::size_t i = 0; i < loads.size(); ++i)
      {
        const unsigned int body = loads[i].body;
        f.setZero(structures[body]->n_dofs());
        add(i, t, f);
        all.segment(begin[body], f.size()) += f;
      }
    return all;
  }



  void
  NodalLoads::add(const std::size_t load, const double t, Eigen::VectorXd &f)
  {
    ++evaluations;
    const double time  = loads[load].uses_time() ? t : 0;
    const auto   found = kept[load].find(time);
    if (found != kept[load].end())
      {
        f += found->second;
        return;
      }
    loads[load].add(*structures[loads[load].body], t, f);
    ++integrations;
    const Eigen::Index n = (f.array() != 0).count();
    if (n > room)
      return;
    room -= n;
    kept[load].emplace(time, f.sparseView());
  }
} // namespace conetact
