// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/separate_systems.h"

#include "conetact/backends/direct_system.h"
#include "conetact/base/index.h"

namespace conetact::backends
{
  namespace
  {
    using Eigen::Index;
    using solvers::NodeLaw;

    /** Of the unknowns and contact nodes of all, those of one system. */
    struct Part
    {
      std::vector<Index>                          unknowns, nodes;
      std::shared_ptr<const solvers::LargeSystem> system;
    };

    class SeparateSystems : public solvers::LargeSystem
    {
    public:
      explicit SeparateSystems(std::vector<Part> all)
        : parts(std::move(all))
      {}

      Index
      n_unknowns() const override
      {
        std::size_t n = 0;
        for (const Part &part : parts)
          n += part.unknowns.size();
        return static_cast<Index>(n);
      }
      Array
      multiply(const Array &u) const override
      {
        Array y(n_unknowns());
        for (const Part &part : parts)
          y(part.unknowns) = part.system->multiply(u(part.unknowns));
        return y;
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
            const Array                &f,
            const Precision            &precision) const override
      {
        Step sum;
        sum.du.resize(n_unknowns());
        for (const Part &part : parts)
          {
            std::vector<NodeLaw> own;
            for (const Index i : part.nodes)
              own.push_back(laws[at(i)]);
            const auto step =
              part.system->solve(own, f(part.unknowns), precision);
            if (!step)
              return {};
            sum.du(part.unknowns) = step->du;
            sum.iterations += step->iterations;
            sum.error = std::max(sum.error, step->error);
          }
        return sum;
      }

    private:
      const std::vector<Part> parts;
    };

    /** Numbers of unknowns in a part, -1 in others. */
    using PartNumbers = std::shared_ptr<const std::vector<Index>>;

    /** Those whose unknowns are in a part; none are in two. */
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
      return part;
    }

    /** What `given` has of the unknowns and contact nodes of a part. */
    LargeStiffness
    part_of(const LargeStiffness &given, const Part &part)
    {
      LargeStiffness own;
      const auto     number =
        std::make_shared<std::vector<Index>>(given.node_of.size(), Index(-1));
      own.modes = given.modes(part.unknowns, Eigen::all);
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
      own.surface    = given.surface;
      own.position   = given.position;
      own.elements   = part_of(given.elements, number);
      return own;
    }
  } // namespace



  std::shared_ptr<const solvers::LargeSystem>
  make_separate_systems(LargeStiffness              &&given,
                        const std::set<unsigned int> &direct,
                        const unsigned int            dim)
  {
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
    return std::make_shared<SeparateSystems>(std::move(parts));
  }
} // namespace conetact::backends
