// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/nodal_loads.h"

#include "conetact/bodies/asked_load.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace conetact::bodies
{
  namespace
  {
    /** Nodal forces that are kept: 256 MB of them. */
    constexpr Eigen::Index most_kept = 1 << 24;

    /** Sums below this part of what they are sums of are rounding. */
    constexpr double round_off = 1e-12;
  } // namespace



  namespace
  {
    /** Force and moment about the origin of nodal forces on a body. */
    std::pair<Tensor<1, 3>, Tensor<1, 3>>
    resultant(const Structure       &structure,
              const unsigned int     dim,
              const Eigen::VectorXd &f)
    {
      const unsigned int                    n = structure.n_components();
      std::pair<Tensor<1, 3>, Tensor<1, 3>> sum;
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        {
          const auto own = f.segment(i * static_cast<Eigen::Index>(n), n);
          if (own.isZero(0))
            continue;
          Tensor<1, 3> force;
          for (unsigned int c = 0; c < n; ++c)
            if (c < dim)
              force[c] = own[c];
            else
              sum.second[dim == 2 ? 2 : c - dim] += own[c];
          sum.first += force;
          if (structure.is_axisymmetric())
            continue; // moments cancel round the axis
          sum.second +=
            cross_product_3d(Tensor<1, 3>(structure.position(i)), force);
        }
      return sum;
    }

    void
    clear_rounding(const double size, double &sum)
    {
      if (std::abs(sum) <= round_off * size)
        sum = 0;
    }
  } // namespace



  NodalLoads::NodalLoads(const std::vector<Load>              &all_loads,
                         const std::vector<const Structure *> &bodies,
                         const unsigned int                    space)
    : loads(all_loads)
    , structures(bodies)
    , dim(space)
    , kept(loads.size())
    , of_loads(loads.size())
    , room(most_kept)
  {
    for (std::size_t i = 0; i < loads.size(); ++i)
      {
        of_loads[i].name        = loads[i].name;
        of_loads[i].is_constant = !loads[i].uses_time();
      }
  }



  NodalLoads::Acting
  NodalLoads::acting(const double t)
  {
    std::vector<Eigen::Index> begin(1, 0);
    for (const Structure *structure : structures)
      begin.push_back(begin.back() + structure->n_dofs());
    Acting all;
    all.mechanical.setZero(begin.back());
    visit(t, [&](const Load &load, const Eigen::VectorXd &f) {
      const bool is_thermal = load.strains();
      // but round the axis what strains a body balances: the rest is rounding
      const bool balances =
        is_thermal && !structures[load.body]->is_axisymmetric();
      all.each.push_back(balances ? std::pair<Tensor<1, 3>, Tensor<1, 3>>() :
                                    resultant(*structures[load.body], dim, f));
      if (is_thermal && all.thermal.size() == 0)
        {
          all.thermal.setZero(begin.back());
          all.both = all.mechanical;
        }
      if (all.thermal.size() > 0)
        all.both.segment(begin[load.body], f.size()) += f;
      (is_thermal ? all.thermal : all.mechanical)
        .segment(begin[load.body], f.size()) += f;
    });
    return all;
  }



  double
  NodalLoads::temperature(const unsigned int body,
                          const Point<3>    &p,
                          const double       t) const
  {
    AssertIndexRange(body, structures.size());
    double sum = 0;
    for (const Load &load : loads)
      if (load.body == body && load.kind == Load::Kind::temperature)
        sum += load.value.front()(p, t);
    return sum;
  }



  std::string
  NodalLoads::asked(const std::size_t load) const
  {
    AssertIndexRange(load, loads.size());
    const Largest &largest = of_loads[load];
    if (largest.size == 0)
      return "";
    return what_is_asked(loads[load],
                         *structures[loads[load].body],
                         largest.time,
                         {largest.force, largest.moment});
  }



  void
  NodalLoads::visit(const double t, const Visitor &visit)
  {
    Eigen::VectorXd f;
    for (std::size_t i = 0; i < loads.size(); ++i)
      {
        f.setZero(structures[loads[i].body]->n_dofs());
        add(i, t, f);
        visit(loads[i], f);
      }
  }



  void
  NodalLoads::add(const std::size_t load, const double t, Eigen::VectorXd &f)
  {
    AssertIndexRange(load, loads.size());
    AssertDimension(f.size(), structures[loads[load].body]->n_dofs());
    Assert(f.isZero(0),
           dealii::ExcMessage("What is kept of a load is that load alone."));
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
    note(load, t, f);
    const Eigen::Index n = (f.array() != 0).count();
    if (n > room)
      return;
    room -= n;
    kept[load].emplace(time, f.sparseView());
  }



  void
  NodalLoads::note(const std::size_t      load,
                   const double           t,
                   const Eigen::VectorXd &f)
  {
    Largest     &largest = of_loads[load];
    const double size    = f.lpNorm<1>();
    if (!(size > largest.size))
      return;
    const Structure &body     = *structures[loads[load].body];
    const auto       n        = static_cast<Eigen::Index>(body.n_components());
    const auto       of_nodes = f.reshaped(n, f.size() / n);
    double           arm      = 1; // of moments beside forces
    for (Eigen::Index i = 0; i < of_nodes.cols(); ++i)
      if (!of_nodes.col(i).isZero(0))
        arm = std::max(arm, body.position(static_cast<unsigned int>(i)).norm());
    std::tie(largest.force, largest.moment) = resultant(body, dim, f);
    for (unsigned int d = 0; d < 3; ++d)
      {
        clear_rounding(size, largest.force[d]);
        clear_rounding(arm * size, largest.moment[d]);
      }
    largest.time    = t;
    largest.size    = size;
    largest.n_nodes = static_cast<unsigned int>(
      (of_nodes.array() != 0).colwise().any().count());
  }
} // namespace conetact::bodies
