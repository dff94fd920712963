// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/shared_system.h"

#include "conetact/base/index.h"
#include "conetact/base/partition.h"
#include "conetact/iterative/block_system.h"
#include "conetact/iterative/element_rows.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>

namespace conetact::iterative
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
          const int         n     = static_cast<int>(node.size());
          const auto        owner = at(owner_of(node.at(0), first));
          std::vector<int> &list  = numbers[owner];
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
        ContactShare contact_share =
          deal_contact(whole.contact, first, processes);
        laws_begin = std::move(contact_share.law);
        for (const std::vector<int> &node : contact_share.places)
          sizes.push_back(static_cast<Index>(node.size()));
        take_contact(contact_share.places, whole.contact);
        BlockShare<block> share;
        share.processes      = processes;
        share.first          = first;
        share.contact        = std::move(contact_share.places);
        share.surface        = deal_surface(std::move(whole.surface));
        share.exists         = deal_places(whole.places);
        share.modes          = deal_modes(std::move(whole.modes));
        share.side           = deal_sides(std::move(whole.side));
        share.preconditioner = whole.preconditioner;
        share.K              = rows_of_elements<block>(whole.elements,
                                          whole.places,
                                          first,
                                          processes);
        system = std::make_unique<const BlockSystem<block>>(std::move(share));
      }

      void
      keep(Array x, const int to) override
      {
        kept[to] = processes.scatter(std::move(x), first);
      }
      Array
      numbers(const int x) const override
      {
        return processes.gather(kept.at(x), first);
      }
      Array
      of_contact(const int x) const override
      {
        const Array all =
          processes.gather(Array(kept.at(x)(contact)), first_contact);
        return all(contact_order);
      }
      void
      add(const int x, double factor, const int y, const int to) override
      {
        kept[to] = kept.at(x) + factor * kept.at(y);
      }
      double
      product_elsewhere(const int x, const int y) const override
      {
        const Array &a = kept.at(x), &b = kept.at(y);
        double       sum   = 0;
        Index        begin = 0;
        const auto   add   = [&](const Index end) {
          sum +=
            a.segment(begin, end - begin).dot(b.segment(begin, end - begin));
          begin = end + 1;
        };
        for (const int p : ascending_contact)
          add(p);
        add(a.size());
        return processes.sum(sum);
      }
      void
      multiply(const int x, const int to) override
      {
        kept[to] = system->multiply(kept.at(x));
      }
      void
      forget(const int x) override
      {
        kept.erase(x);
      }
      Array
      diagonal() const override
      {
        return processes.gather(system->diagonal(), first);
      }
      std::optional<Found>
      solve(const std::vector<NodeLaw> &laws,
            const int                   f,
            const Precision            &precision,
            const int                   to) override
      {
        std::vector<double> asked = {precision.relative, precision.forces};
        processes.broadcast(asked);
        auto step =
          system->solve(deal_laws(laws), kept.at(f), {asked[0], asked[1]});
        if (processes.sum(step.du.allFinite() ? 0. : 1.) > 0)
          return {};
        kept[to] = std::move(step.du);
        return Found{step.iterations, step.error};
      }

    private:
      /** Which unknowns of contact are this process's, and the order of all. */
      void
      take_contact(const std::vector<std::vector<int>> &own,
                   const std::vector<std::vector<int>> &all)
      {
        for (const std::vector<int> &node : own)
          contact.insert(contact.end(), node.begin(), node.end());
        ascending_contact = contact;
        std::sort(ascending_contact.begin(), ascending_contact.end());
        // each process has its nodes in the order of all
        std::vector<int> n_of(at(processes.size()), 0);
        for (const std::vector<int> &node : all)
          n_of[at(owner_of(node.at(0), first))] +=
            static_cast<int>(node.size());
        first_contact = {0};
        for (const int n : n_of)
          first_contact.push_back(first_contact.back() + n);
        std::vector<int> next = first_contact;
        for (const std::vector<int> &node : all)
          for (std::size_t k = 0; k < node.size(); ++k)
            contact_order.push_back(next[at(owner_of(node.at(0), first))]++);
        processes.broadcast(first_contact);
      }
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
      /** A number for each own node, or for none at all. */
      std::vector<int>
      deal_sides(Array side) const
      {
        if (processes.sum(static_cast<double>(side.size())) == 0)
          return {};
        const Array      own = processes.scatter(std::move(side), first);
        std::vector<int> sides;
        for (Index p = 0; p < own.size(); p += block)
          sides.push_back(static_cast<int>(own[p]));
        return sides;
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

      const Communicator       processes;
      std::vector<int>         first;
      std::vector<std::size_t> laws_begin;
      std::vector<Index>       sizes;              ///< of own contact nodes
      std::vector<int> contact, ascending_contact; ///< own places of contact
      std::vector<int> first_contact; ///< of each process, among those of all
      /** Of each unknown of contact, among those of all processes one behind
       * the other; on the first one. */
      std::vector<int>                          contact_order;
      std::map<int, Array>                      kept;
      std::unique_ptr<const BlockSystem<block>> system;
    };
  } // namespace



  std::unique_ptr<SharedSystem>
  share_system(WholeSystem       &&whole,
               const unsigned int  dim,
               const Communicator &processes)
  {
    Assert(dim == 2 || dim == 3,
           dealii::ExcMessage("Nodes have two unknowns or three."));
    if (dim == 2)
      return std::make_unique<Shared<2>>(whole, processes);
    return std::make_unique<Shared<3>>(whole, processes);
  }
} // namespace conetact::iterative
