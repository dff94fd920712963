// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/separate_systems.h"

#include "conetact/base/index.h"
#include "conetact/iterative/direct_system.h"

#include <deal.II/base/exceptions.h>

namespace conetact::iterative
{
  namespace
  {
    using Eigen::Index;
    using solvers::NodeLaw;

    /** One of the systems, and which of all unknowns and contact nodes it has.
     */
    struct Part
    {
      std::vector<Index>                          unknowns, nodes;
      std::shared_ptr<const solvers::LargeSystem> system;
    };

    /** A vector as the systems have it, in their order. */
    struct Vectors : solvers::LargeVector
    {
      std::vector<solvers::LargeSystem::Kept> of;
    };

    /**
     * As no element has nodes of two parts, K = diag(K_1, K_2), and as a law is
     * that of one node, P + D K has the same blocks: each part solves its own.
     */
    class SeparateSystems : public solvers::LargeSystem
    {
    public:
      explicit SeparateSystems(std::vector<Part> all, const Index n)
        : parts(std::move(all))
        , n_contact_unknowns(n)
      {}

      Index
      n_unknowns() const override
      {
        std::size_t n = 0;
        for (const Part &part : parts)
          n += part.unknowns.size();
        return static_cast<Index>(n);
      }
      Kept
      keep(const Array &x) const override
      {
        return of_parts([&](const Part &part, const std::size_t) {
          return part.system->keep(part.system->own(x(part.unknowns)));
        });
      }
      Array
      numbers(const Kept &x) const override
      {
        Array all(n_unknowns());
        for (std::size_t i = 0; i < parts.size(); ++i)
          all(parts[i].unknowns) =
            parts[i].system->all(parts[i].system->numbers(in_part(x, i)));
        return all;
      }
      /* Parts keep the order of all unknowns: those of contact are the last
         ones of each, too. */
      Array
      of_contact(const Kept &x) const override
      {
        Array       all(n_contact_unknowns);
        const Index begin = n_unknowns() - n_contact_unknowns;
        for (std::size_t i = 0; i < parts.size(); ++i)
          {
            const Array       own = parts[i].system->of_contact(in_part(x, i));
            const auto *const place =
              parts[i].unknowns.data() + parts[i].unknowns.size() - own.size();
            for (Index k = 0; k < own.size(); ++k)
              all[place[k] - begin] = own[k];
          }
        return all;
      }
      Kept
      add(const Kept &x, const double factor, const Kept &y) const override
      {
        return of_parts([&](const Part &part, const std::size_t i) {
          return part.system->add(in_part(x, i), factor, in_part(y, i));
        });
      }
      double
      product_elsewhere(const Kept &x, const Kept &y) const override
      {
        double sum = 0;
        for (std::size_t i = 0; i < parts.size(); ++i)
          sum +=
            parts[i].system->product_elsewhere(in_part(x, i), in_part(y, i));
        return sum;
      }
      Kept
      multiply(const Kept &u) const override
      {
        return of_parts([&](const Part &part, const std::size_t i) {
          return part.system->multiply(in_part(u, i));
        });
      }
      Array
      diagonal() const override
      {
        Array d(n_unknowns());
        for (const Part &part : parts)
          d(part.unknowns) = part.system->diagonal();
        return d;
      }
      std::optional<Step>
      solve(const std::vector<NodeLaw> &laws,
            const Kept                 &f,
            const Precision            &precision) const override
      {
        Step       sum;
        const auto du = std::make_shared<Vectors>();
        for (std::size_t k = 0; k < parts.size(); ++k)
          {
            std::vector<NodeLaw> own;
            for (const Index i : parts[k].nodes)
              own.push_back(laws[at(i)]);
            const auto step =
              parts[k].system->solve(own, in_part(f, k), precision);
            if (!step)
              return {};
            du->of.push_back(step->du);
            sum.iterations += step->iterations;
            sum.error = std::max(sum.error, step->error);
          }
        sum.du = du;
        return sum;
      }

    private:
      /** Made of f(part, its number). */
      template <typename F>
      Kept
      of_parts(const F &f) const
      {
        const auto made = std::make_shared<Vectors>();
        for (std::size_t i = 0; i < parts.size(); ++i)
          made->of.push_back(f(parts[i], i));
        return made;
      }
      static const Kept &
      in_part(const Kept &x, const std::size_t i)
      {
        return static_cast<const Vectors &>(*x).of[i];
      }

      const std::vector<Part> parts;
      const Index             n_contact_unknowns;
    };

    /** Numbers of unknowns in a part, -1 in others. */
    using PartNumbers = std::shared_ptr<const std::vector<Index>>;

    /**
     * Those whose unknowns are in a part; none are in two, or their matrices
     * would have rows that the part has not. Nothing is copied: elements are
     * visited as all are, and renumbered on the way.
     */
    Elements
    part_of(const Elements &elements, const PartNumbers &number)
    {
      const auto renumber = [number](const std::vector<Index> &unknowns) {
        std::vector<Index> own;
        for (const Index q : unknowns)
          if ((*number)[at(q)] >= 0)
            own.push_back((*number)[at(q)]);
        return own;
      };
      Elements part;
      part.for_each = [renumber, all = elements.for_each](const auto &visit) {
        all([&](const std::vector<Index> &unknowns, const double *matrix) {
          if (const auto own = renumber(unknowns); !own.empty())
            visit(own, matrix);
        });
      };
      part.for_each_connection =
        [renumber, all = elements.for_each_connection](const auto &visit) {
          all([&](const std::vector<Index> &unknowns) {
            if (const auto own = renumber(unknowns); !own.empty())
              visit(own);
          });
        };
      if (elements.that_have)
        part.that_have = [number, all = elements.that_have](
                           const std::vector<bool> &unknowns) {
          std::vector<bool> among_all(number->size(), false);
          // A part knows its own unknowns only: what it asks for is told in
          // those of all, by which elements are found.
          for (std::size_t q = 0; q < number->size(); ++q)
            among_all[q] = (*number)[q] >= 0 && unknowns[at((*number)[q])];
          return part_of(all(among_all), number);
        };
      return part;
    }

    /** The part of `given` that has the unknowns and contact nodes of `part`.
     */
    LargeStiffness
    part_of(const LargeStiffness &given, const Part &part)
    {
      LargeStiffness own;
      const auto     number =
        std::make_shared<std::vector<Index>>(given.node_of.size(), Index(-1));
      for (const auto &mode : given.modes)
        own.modes.emplace_back([mode, unknowns = part.unknowns] {
          return Eigen::VectorXd(mode()(unknowns));
        });
      for (const Index q : part.unknowns)
        {
          (*number)[at(q)] = static_cast<Index>(own.node_of.size());
          own.node_of.push_back(given.node_of[at(q)]);
        }
      for (const Index i : part.nodes)
        own.contact.first.push_back(own.contact.first.back() +
                                    given.contact.first[at(i) + 1] -
                                    given.contact.first[at(i)]);
      own.contact.mu = given.contact.mu(part.nodes);
      // Nodes keep the numbers of the scene, by which these are asked: only
      // unknowns are counted anew.
      own.surface        = given.surface;
      own.side           = given.side;
      own.position       = given.position;
      own.elements       = part_of(given.elements, number);
      own.preconditioner = given.preconditioner;
      return own;
    }
  } // namespace



  /* The part that is factorised comes first, where both have unknowns: an order
     that keep() and all other functions of the system share. */
  std::shared_ptr<const solvers::LargeSystem>
  make_separate_systems(LargeStiffness              &&given,
                        const std::set<unsigned int> &direct,
                        const unsigned int            dim)
  {
    Assert(given.node_of.size() >= at(given.contact.n_unknowns()),
           dealii::ExcMessage("Unknowns of contact are the last ones."));
    if (direct.empty())
      return make_large_system(std::move(given), dim);
    Part       iterated, factorized;
    const auto part_of_unknown = [&](const std::size_t q) -> Part & {
      return direct.count(given.node_of[q]) > 0 ? factorized : iterated;
    };
    const std::size_t n = given.node_of.size();
    for (std::size_t q = 0; q < n; ++q)
      part_of_unknown(q).unknowns.push_back(static_cast<Index>(q));
    const std::size_t begin = n - at(given.contact.n_unknowns());
    for (Index i = 0; i < given.contact.n_nodes(); ++i)
      part_of_unknown(begin + at(given.contact.first[at(i)]))
        .nodes.push_back(i);

    std::vector<Part> parts;
    if (!factorized.unknowns.empty())
      {
        LargeStiffness own = part_of(given, factorized);
        factorized.system =
          std::make_shared<DirectSystem>(own.elements,
                                         std::move(own.contact),
                                         static_cast<Index>(
                                           own.node_of.size()));
        parts.push_back(std::move(factorized));
      }
    if (!iterated.unknowns.empty())
      {
        iterated.system = make_large_system(part_of(given, iterated), dim);
        parts.push_back(std::move(iterated));
      }
    return std::make_shared<SeparateSystems>(std::move(parts),
                                             given.contact.n_unknowns());
  }
} // namespace conetact::iterative
