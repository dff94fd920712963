// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/substructures.h"

#include "conetact/contact/equal_bodies.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using SparseMatrix = Eigen::SparseMatrix<double>;
    using Groups       = std::vector<std::vector<unsigned int>>;

    Index
    place_of(const Places &place, const Index q)
    {
      return place.size() == 0 ? q : place.indices()[q];
    }

    std::vector<unsigned int>
    nodes_in_place(const Coordinates &coordinates, const Places &place)
    {
      std::vector<unsigned int> nodes = coordinates.node_of_unknowns();
      for (Index q = 0; q < place.size(); ++q)
        nodes[static_cast<std::size_t>(place.indices()[q])] =
          coordinates.node_of_unknowns()[static_cast<std::size_t>(q)];
      return nodes;
    }

    Substructures
    whole(const ElasticSystem &elastic,
          const Coordinates   &coordinates,
          const Places        &place,
          const Index          n_schur)
    {
      SparseMatrix upper = assemble(elastic, coordinates);
      if (place.size() > 0)
        {
          SparseMatrix sorted(upper.rows(), upper.cols());
          sorted.selfadjointView<Eigen::Upper>() =
            upper.selfadjointView<Eigen::Upper>().twistedBy(place);
          upper.swap(sorted);
        }
      const auto nodes = nodes_in_place(coordinates, place);
      return {{{std::move(upper), nodes, {}}}, nodes, n_schur};
    }

    bool
    may_have_equals(const Bodies &bodies)
    {
      std::set<unsigned int> sizes;
      for (std::size_t body = 0; body < bodies.structures.size(); ++body)
        if (!bodies.is_at_rest(body) &&
            !sizes.insert(bodies.structures[body]->n_nodes()).second)
          return true;
      return false;
    }

    /** Makes the parts of a system with equal bodies. */
    class Division
    {
    public:
      Division(const ElasticSystem   &elastic_system,
               const Coordinates     &c,
               const Places          &p,
               const BodyCoordinates &o,
               const Groups          &g)
        : elastic(elastic_system)
        , coordinates(c)
        , place(p)
        , own(o)
        , groups(g)
      {
        number_unknowns();
      }

      std::vector<Substructure>
      parts() const
      {
        const SparseMatrix        all = assemble(elastic, map());
        std::vector<Substructure> result;
        for (const auto &group : groups)
          result.push_back(equal_bodies(group, all));
        if (!rest.empty())
          result.push_back(other_bodies(all));
        return result;
      }

    private:
      /** First bodies of groups one after the other, then `rest`. */
      void
      number_unknowns()
      {
        const auto n_bodies = elastic.bodies.structures.size();
        shift.assign(n_bodies, 0);
        kind.assign(n_bodies, Kind::other);
        for (const auto &group : groups)
          {
            for (const unsigned int body : group)
              kind[body] = Kind::repeated;
            kind[group[0]]  = Kind::first;
            shift[group[0]] = n_own - own.begin(group[0]);
            n_own += own.end(group[0]) - own.begin(group[0]);
          }
        std::vector<bool> is_seen(
          static_cast<std::size_t>(coordinates.n_unknowns()));
        for_each_dof([&](const std::size_t body, const Index dof) {
          const auto [begin, end] = coordinates.row(dof);
          for (const auto *entry = begin; entry != end; ++entry)
            if (kind[body] == Kind::other)
              is_seen[static_cast<std::size_t>(entry->unknown)] = true;
        });
        number_in_rest.resize(is_seen.size());
        for (std::size_t q = 0; q < is_seen.size(); ++q)
          if (is_seen[q])
            {
              number_in_rest[q] = n_own + static_cast<Index>(rest.size());
              rest.push_back(static_cast<Index>(q));
            }
      }

      template <class Visitor>
      void
      for_each_dof(const Visitor &visit) const
      {
        for (std::size_t body = 0; body < kind.size(); ++body)
          for (Index dof = coordinates.offset(body);
               dof < coordinates.offset(body + 1);
               ++dof)
            visit(body, dof);
      }

      /** From the unknowns of all parts; empty for bodies repeated. */
      LinearMap
      map() const
      {
        LinearMap result;
        result.set_n_unknowns(n_own + static_cast<Index>(rest.size()));
        for_each_dof([&](const std::size_t body, const Index dof) {
          if (kind[body] == Kind::first)
            {
              const auto [begin, end] = own.row(dof);
              for (const auto *entry = begin; entry != end; ++entry)
                result.append(entry->unknown + shift[body], entry->factor);
            }
          if (kind[body] == Kind::other)
            {
              const auto [begin, end] = coordinates.row(dof);
              for (const auto *entry = begin; entry != end; ++entry)
                result.append(
                  number_in_rest[static_cast<std::size_t>(entry->unknown)],
                  entry->factor);
            }
          result.end_row();
        });
        return result;
      }

      Substructure
      equal_bodies(const std::vector<unsigned int> &group,
                   const SparseMatrix              &all) const
      {
        const Index  begin = own.begin(group[0]), end = own.end(group[0]);
        const Index  first = begin + shift[group[0]];
        Substructure part;
        part.upper = all.block(first, first, end - begin, end - begin);
        for (Index p = begin; p < end; ++p)
          part.node_of.push_back(own.node_of(p));
        for (const unsigned int body : group)
          part.uses.push_back(map_of(body));
        return part;
      }

      Substructure::Map
      map_of(const unsigned int body) const
      {
        std::vector<Eigen::Triplet<double>> entries;
        for (Index p = own.begin(body); p < own.end(body); ++p)
          for (const auto &[q, factor] : own.row_of(p))
            entries.emplace_back(p - own.begin(body),
                                 place_of(place, q),
                                 factor);
        Substructure::Map map(own.end(body) - own.begin(body),
                              coordinates.n_unknowns());
        map.setFromTriplets(entries.begin(), entries.end());
        return map;
      }

      Substructure
      other_bodies(const SparseMatrix &all) const
      {
        const auto   n = static_cast<Index>(rest.size());
        Substructure part;
        part.upper = all.block(n_own, n_own, n, n);
        std::vector<Eigen::Triplet<double>> entries;
        for (Index k = 0; k < n; ++k)
          {
            const Index q = rest[static_cast<std::size_t>(k)];
            part.node_of.push_back(
              coordinates.node_of_unknowns()[static_cast<std::size_t>(q)]);
            entries.emplace_back(k, place_of(place, q), 1.);
          }
        Substructure::Map selection(n, coordinates.n_unknowns());
        selection.setFromTriplets(entries.begin(), entries.end());
        part.uses.push_back(std::move(selection));
        return part;
      }

      enum class Kind
      {
        other,
        first,
        repeated
      };

      const ElasticSystem   &elastic;
      const Coordinates     &coordinates;
      const Places          &place;
      const BodyCoordinates &own;
      const Groups          &groups;

      std::vector<Kind>  kind;           ///< of each body
      std::vector<Index> shift;          ///< from unknowns in `own`
      Index              n_own = 0;      ///< unknowns of first bodies
      std::vector<Index> rest;           ///< unknowns q of other bodies
      std::vector<Index> number_in_rest; ///< of each q
    };
  } // namespace



  Substructures
  make_substructures(const ElasticSystem &elastic,
                     const Coordinates   &coordinates,
                     const Places        &place,
                     const Index          n_schur)
  {
    if (!may_have_equals(elastic.bodies))
      return whole(elastic, coordinates, place, n_schur);
    const BodyCoordinates own(elastic.bodies,
                              coordinates,
                              body_axes(elastic.bodies));
    const Groups          groups = find_equal_bodies(elastic, own);
    if (groups.empty())
      return whole(elastic, coordinates, place, n_schur);

    Substructures divided = {
      Division(elastic, coordinates, place, own, groups).parts(),
      nodes_in_place(coordinates, place),
      n_schur};
    // little beside what the contact solver does with a matrix of that size
    if (SubstructureSolver::estimate_sum(divided).flops <=
        std::pow(static_cast<double>(n_schur), 3))
      return divided;
    Substructures one = whole(elastic, coordinates, place, n_schur);
    return SubstructureSolver::estimate(divided).flops <
               SubstructureSolver::estimate(one).flops ?
             std::move(divided) :
             std::move(one);
  }
} // namespace conetact
