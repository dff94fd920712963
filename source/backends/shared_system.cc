// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/shared_system.h"

#include "conetact/backends/block_system.h"
#include "conetact/backends/element_rows.h"
#include "conetact/base/index.h"

#include <algorithm>

namespace conetact::backends
{
  namespace
  {
    using Eigen::Index;
    using solvers::NodeLaw;

    /** Laws of all contact nodes as numbers, one behind the other. */
    std::vector<double>
    to_numbers(const std::vector<NodeLaw> &laws)
    {
      std::vector<double> x;
      for (const NodeLaw &law : laws)
        {
          x.insert(x.end(), law.p.data(), law.p.data() + law.p.size());
          x.insert(x.end(), law.d.data(), law.d.data() + law.d.size());
          x.insert(x.end(), law.h.data(), law.h.data() + law.h.size());
        }
      return x;
    }

    NodeLaw
    to_law(const double *x, const Index n)
    {
      using Square = Eigen::Map<const Eigen::MatrixXd>;
      NodeLaw law;
      law.p = Square(x, n, n);
      law.d = Square(x + n * n, n, n);
      law.h = Eigen::Map<const Eigen::VectorXd>(x + 2 * n * n, n);
      return law;
    }

    /** The unknowns of contact nodes of each process, and where their laws
     * begin among those of all. */
    struct ContactShare
    {
      std::vector<std::vector<int>> places;
      std::vector<std::size_t>      law;
    };

    /** Contact nodes as numbers: where its law is, how many places, which. */
    std::vector<std::vector<int>>
    contact_numbers(const std::vector<std::vector<int>> &contact,
                    const std::vector<int>              &first)
    {
      std::vector<std::vector<int>> numbers(first.size() - 1);
      int                           law = 0;
      for (const std::vector<int> &node : contact)
        {
          const int  n = static_cast<int>(node.size());
          const auto owner =
            at(std::upper_bound(first.begin(), first.end(), node.at(0)) -
               first.begin() - 1);
          std::vector<int> &list = numbers[owner];
          list.push_back(law);
          list.push_back(n);
          for (const int p : node)
            list.push_back(p - first[owner]);
          law += 2 * n * n + n;
        }
      return numbers;
    }

    ContactShare
    read_contact(const std::vector<int> &numbers)
    {
      ContactShare share;
      for (auto it = numbers.begin(); it != numbers.end();)
        {
          share.law.push_back(at(*it++));
          const int n = *it++;
          share.places.emplace_back(it, it + n);
          it += n;
        }
      return share;
    }

    ContactShare
    deal_contact(const std::vector<std::vector<int>> &contact,
                 const std::vector<int>              &first,
                 const Communicator                  &processes)
    {
      if (processes.rank() > 0)
        return read_contact(processes.receive<int>(0));
      const auto numbers = contact_numbers(contact, first);
      for (int p = 1; p < processes.size(); ++p)
        processes.send(numbers[at(p)], p);
      return read_contact(numbers[0]);
    }

    template <int block>
    class Shared : public SharedSystem
    {
    public:
      Shared(WholeSystem &whole, const Communicator &p)
        : processes(p)
      {
        first = whole.first;
        processes.broadcast(first);
        ContactShare contact = deal_contact(whole.contact, first, processes);
        laws_begin           = std::move(contact.law);
        for (const std::vector<int> &node : contact.places)
          sizes.push_back(static_cast<Index>(node.size()));
        BlockShare<block> share;
        share.processes = processes;
        share.first     = first;
        share.contact   = std::move(contact.places);
        share.surface   = deal_surface(std::move(whole.surface));
        share.exists    = deal_places(whole.places);
        share.modes     = deal_modes(std::move(whole.modes));
        share.K         = rows_of_elements<block>(whole.elements,
                                          whole.places,
                                          first,
                                          processes);
        system = std::make_unique<const BlockSystem<block>>(std::move(share));
      }

      Array
      multiply(Array x) const override
      {
        const Array own = processes.scatter(std::move(x), first);
        return processes.gather(system->multiply(own), first);
      }
      Array
      diagonal() const override
      {
        return processes.gather(system->diagonal(), first);
      }
      Step
      solve(const std::vector<NodeLaw> &laws,
            Array                       f,
            const Precision            &precision) const override
      {
        std::vector<double> asked = {precision.relative, precision.forces};
        processes.broadcast(asked);
        const Array own = processes.scatter(std::move(f), first);
        Step step = system->solve(deal_laws(laws), own, {asked[0], asked[1]});
        step.du   = processes.gather(std::move(step.du), first);
        return step;
      }

    private:
      /** 1 where there is an unknown. */
      Array
      deal_places(const std::vector<int> &places) const
      {
        Array exists;
        if (processes.rank() == 0)
          exists = Array::Zero(first.back());
        for (const int p : places)
          exists[p] = 1;
        return processes.scatter(std::move(exists), first);
      }
      /** Nodes of all processes. */
      std::vector<int>
      deal_surface(std::vector<int> places) const
      {
        processes.broadcast(places);
        for (int &p : places)
          p /= block;
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        return places;
      }
      Eigen::MatrixXd
      deal_modes(Eigen::MatrixXd modes) const
      {
        if (processes.size() == 1)
          return modes;
        const auto      own     = at(processes.rank());
        constexpr int   n_modes = 3 * (block - 1);
        Eigen::MatrixXd part(first[own + 1] - first[own], n_modes);
        for (Index j = 0; j < n_modes; ++j)
          part.col(j) = processes.scatter(
            processes.rank() == 0 ? Array(modes.col(j)) : Array(), first);
        return part;
      }
      std::vector<NodeLaw>
      deal_laws(const std::vector<NodeLaw> &laws) const
      {
        if (processes.size() == 1)
          return laws;
        std::vector<double> numbers = to_numbers(laws);
        processes.broadcast(numbers);
        std::vector<NodeLaw> own;
        for (std::size_t i = 0; i < sizes.size(); ++i)
          own.push_back(to_law(numbers.data() + laws_begin[i], sizes[i]));
        return own;
      }

      const Communicator                        processes;
      std::vector<int>                          first;
      std::vector<std::size_t>                  laws_begin;
      std::vector<Index>                        sizes; ///< of own contact nodes
      std::unique_ptr<const BlockSystem<block>> system;
    };
  } // namespace



  std::unique_ptr<SharedSystem>
  share_system(WholeSystem       &&whole,
               const unsigned int  dim,
               const Communicator &processes)
  {
    if (dim == 2)
      return std::make_unique<Shared<2>>(whole, processes);
    return std::make_unique<Shared<3>>(whole, processes);
  }
} // namespace conetact::backends
