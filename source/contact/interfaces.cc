// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/interfaces.h"

#include <algorithm>
#include <numeric>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Map      = Substructure::Map;
    using Triplets = std::vector<Eigen::Triplet<double>>;

    // Sets of numbers, each a tree: a root is its own parent.
    class Classes
    {
    public:
      explicit Classes(const Index n)
        : parent(static_cast<std::size_t>(n))
      {
        std::iota(parent.begin(), parent.end(), 0);
      }
      Index
      root(Index i)
      {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      }
      void
      join(const Index a, const Index b)
      {
        parent[root(a)] = root(b);
      }

    private:
      std::vector<Index> parent;
    };

    // Whether an unknown q is C, or several uses see it.
    std::vector<bool>
    seen_by_several(const Substructures &substructures)
    {
      const std::size_t n = substructures.node_of.size();
      std::vector<bool> several(n, false);
      std::fill(several.end() - substructures.n_schur, several.end(), true);
      std::vector<int> last_use(n, -1);
      int              number = 0;
      for (const Substructure &part : substructures.parts)
        for (const Map &T : part.uses)
          {
            for (Index row = 0; row < T.rows(); ++row)
              for (Map::InnerIterator entry(T, row); entry; ++entry)
                {
                  int &last = last_use[entry.col()];
                  if (last >= 0 && last != number)
                    several[entry.col()] = true;
                  last = number;
                }
            ++number;
          }
      return several;
    }
    InterfaceOrder
    interface_last(const std::vector<bool> &is_interface)
    {
      const auto     n = static_cast<Index>(is_interface.size());
      InterfaceOrder order;
      order.n_interface =
        std::count(is_interface.begin(), is_interface.end(), true);
      order.place.resize(n);
      int inside = 0, interface = static_cast<int>(n - order.n_interface);
      for (Index i = 0; i < n; ++i)
        order.place.indices()[i] = is_interface[i] ? interface++ : inside++;
      return order;
    }
  } // namespace



  Interfaces
  find_interfaces(const Substructures &substructures)
  {
    const auto n   = static_cast<Index>(substructures.node_of.size());
    Index      all = n;
    for (const Substructure &part : substructures.parts)
      all += part.upper.cols();

    Classes classes(all);
    Index   first = n; // of a part's p
    for (const Substructure &part : substructures.parts)
      {
        for (const Map &T : part.uses)
          for (Index row = 0; row < T.rows(); ++row)
            for (Map::InnerIterator entry(T, row); entry; ++entry)
              classes.join(first + row, entry.col());
        first += part.upper.cols();
      }

    const std::vector<bool> several = seen_by_several(substructures);
    std::vector<bool>       kept(all, false);
    for (Index q = 0; q < n; ++q)
      if (several[q])
        kept[classes.root(q)] = true;

    Interfaces result;
    result.place.assign(n, -1);
    for (Index q = 0; q < n; ++q)
      if (kept[classes.root(q)])
        {
          result.place[q] = static_cast<Index>(result.kept.size());
          result.kept.push_back(q);
        }
    result.n_E = static_cast<Index>(result.kept.size()) - substructures.n_schur;
    first      = n;
    for (const Substructure &part : substructures.parts)
      {
        std::vector<bool> is_interface(part.upper.cols());
        for (Index p = 0; p < part.upper.cols(); ++p)
          is_interface[p] = kept[classes.root(first + p)];
        result.of_part.push_back(interface_last(is_interface));
        first += part.upper.cols();
      }
    return result;
  }



  Substructure
  sorted(const Substructure &part, const InterfaceOrder &order)
  {
    Substructure result;
    result.upper.resize(part.upper.rows(), part.upper.cols());
    result.upper.selfadjointView<Eigen::Upper>() =
      part.upper.selfadjointView<Eigen::Upper>().twistedBy(order.place);
    result.node_of.resize(part.node_of.size());
    for (Index i = 0; i < order.place.size(); ++i)
      result.node_of[order.place.indices()[i]] = part.node_of[i];
    return result;
  }



  Map
  interface_rows(const Map        &T,
                 const Interfaces &interfaces,
                 const std::size_t k)
  {
    const InterfaceOrder &order    = interfaces.of_part[k];
    const Index           n_inside = T.rows() - order.n_interface;
    Triplets              entries;
    for (Index row = 0; row < T.rows(); ++row)
      for (Map::InnerIterator entry(T, row); entry; ++entry)
        if (const Index q = interfaces.place[entry.col()]; q >= 0)
          entries.emplace_back(order.place.indices()[row] - n_inside,
                               q,
                               entry.value());
    Map result(order.n_interface, static_cast<Index>(interfaces.kept.size()));
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }



  Map
  inside_rows(const Map &T, const Interfaces &interfaces, const std::size_t k)
  {
    Eigen::VectorXd square = Eigen::VectorXd::Zero(T.cols());
    for (Index row = 0; row < T.rows(); ++row)
      for (Map::InnerIterator entry(T, row); entry; ++entry)
        square[entry.col()] += entry.value() * entry.value();
    Triplets entries;
    for (Index row = 0; row < T.rows(); ++row)
      for (Map::InnerIterator entry(T, row); entry; ++entry)
        if (interfaces.place[entry.col()] < 0)
          entries.emplace_back(interfaces.of_part[k].place.indices()[row],
                               entry.col(),
                               entry.value() / square[entry.col()]);
    Map result(T.rows(), T.cols());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }
} // namespace conetact
