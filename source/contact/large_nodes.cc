// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/large_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace conetact::contact
{
  using Eigen::VectorXd;

  namespace
  {
    /** Rigid bodies have rotations, but no elements. */
    bool
    is_frame(const model::Bodies &bodies, const std::size_t body)
    {
      return bodies.structures[body]->n_components() > bodies.dim &&
             !bodies.is_rigid(body);
    }

    /** Rotations of a node are a node by themselves: blocks have `dim` unknowns
     * at most. */
    unsigned int
    node_of_rotations(const unsigned int number)
    {
      return 2 * number + 1;
    }
    unsigned int
    node_of_displacements(const unsigned int number)
    {
      return 2 * number;
    }

    /** Contacts and ties of one body with another. */
    struct Pair
    {
      std::set<unsigned int> nodes;                 ///< of both surfaces
      double                 slave = 0, master = 0; ///< hardest entry of K
    };
    using Pairs = std::map<std::pair<unsigned int, unsigned int>, Pair>;

    Pairs
    find_pairs(const ElasticSystem &elastic,
               const Coordinates   &coordinates,
               const ContactPoints &points)
    {
      Pairs      pairs;
      VectorXd   diagonal;
      const auto add = [&](const unsigned int body,
                           const unsigned int node,
                           Pair              &pair,
                           double            &hardest) {
        pair.nodes.insert(
          node_of_displacements(coordinates.number(body, node)));
        // Rigid bodies have no entries: they are harder than anything. Others
        // may be so along any axis.
        hardest =
          elastic.bodies.is_rigid(body) ?
            std::numeric_limits<double>::infinity() :
            std::max(hardest,
                     diagonal
                       .segment(coordinates.dof(body, node), elastic.bodies.dim)
                       .maxCoeff());
      };
      for (const ContactPoint &point : points.all())
        {
          const pairing::ContactNode &node = *point.node;
          if (node.masters.empty())
            continue;
          if (diagonal.size() == 0)
            diagonal = diagonal_of(elastic, coordinates.n_dofs());
          Pair &pair = pairs[{node.body, node.master}];
          add(node.body, node.node, pair, pair.slave);
          for (const auto &[master, weight] : node.masters)
            add(node.master, master, pair, pair.master);
        }
      return pairs;
    }

    /**
     * For each body the first of those that it meets, directly or by others.
     */
    std::vector<unsigned int>
    groups_of_bodies(const Pairs &pairs, const std::size_t n)
    {
      std::vector<unsigned int> group(n);
      std::iota(group.begin(), group.end(), 0);
      for (const auto &[who, pair] : pairs)
        {
          // Groups are united by their smaller number; as many passes over all
          // bodies as there are pairs are little work beside elements.
          const unsigned int from =
                               std::max(group[who.first], group[who.second]),
                             to = std::min(group[who.first], group[who.second]);
          std::replace(group.begin(), group.end(), from, to);
        }
      return group;
    }
  } // namespace



  /* arm^2 is the mean entry of rotations on the diagonal of frames over that of
     displacements: with arm . theta as unknown both are alike. */
  double
  arm_of_rotations(const ElasticSystem &elastic)
  {
    double       rotations = 0, displacements = 0;
    unsigned int n_rotations = 0, n_displacements = 0;
    for (std::size_t b = 0; b < elastic.bodies.structures.size(); ++b)
      if (const bodies::Structure &structure = *elastic.bodies.structures[b];
          is_frame(elastic.bodies, b))
        structure.elements().for_each(
          [&](const std::vector<unsigned int> &dofs, const double *matrix) {
            for (std::size_t i = 0; i < dofs.size(); ++i)
              {
                const double entry = matrix[i * dofs.size() + i];
                const bool   turns =
                  dofs[i] % structure.n_components() >= elastic.bodies.dim;
                (turns ? rotations : displacements) += entry;
                ++(turns ? n_rotations : n_displacements);
              }
          });
    if (!(rotations > 0 && displacements > 0))
      return 1;
    const double arm =
      std::sqrt(rotations / n_rotations * n_displacements / displacements);
    return std::exp2(std::round(std::log2(arm)));
  }



  std::vector<unsigned int>
  nodes_of_unknowns(const Coordinates &coordinates)
  {
    std::vector<unsigned int> nodes;
    for (const Coordinates::Origin &origin : coordinates.origins())
      nodes.push_back(origin.is_rotation ? node_of_rotations(origin.node) :
                                           node_of_displacements(origin.node));
    return nodes;
  }



  unsigned int
  number_of_node(const unsigned int node)
  {
    return node / 2;
  }



  /* The diagonal of K without assembling K. [force/length]; of rotations [force
     x length] */
  VectorXd
  diagonal_of(const ElasticSystem &elastic, const Eigen::Index n_dofs)
  {
    VectorXd diagonal = VectorXd::Zero(n_dofs);
    elastic.for_each_element(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        for (std::size_t i = 0; i < dofs.size(); ++i)
          diagonal[dofs[i]] += matrix[i * dofs.size() + i];
      });
    return diagonal;
  }



  /* The mean of some nodes all over the body. */
  double
  stencil_of(const bodies::Structure &body)
  {
    constexpr unsigned int              most = 500;
    const unsigned int                  step = 1 + body.n_nodes() / most;
    const unsigned int                  n    = body.n_components();
    std::vector<std::set<unsigned int>> met(body.n_nodes() / step + 1);
    body.elements().for_each_connection(
      [&](const std::vector<unsigned int> &dofs) {
        for (const unsigned int dof : dofs)
          if (dof % n == 0 && (dof / n) % step == 0)
            met[dof / n / step].insert(dofs.begin(), dofs.end());
      });
    double sum = 0, count = 0;
    for (const std::set<unsigned int> &others : met)
      if (!others.empty())
        {
          sum += static_cast<double>(others.size());
          ++count;
        }
    return count > 0 ? sum / count : 0.;
  }



  double
  hardest_slave(const ElasticSystem &elastic,
                const Coordinates   &coordinates,
                const ContactPoints &points)
  {
    double hardest = 0;
    for (const auto &[who, pair] : find_pairs(elastic, coordinates, points))
      hardest = std::max(hardest, pair.slave / pair.master);
    return hardest;
  }



  namespace
  {
    /** Rigid bodies that open ties, with the body on the slave side of each. */
    std::map<unsigned int, unsigned int>
    sides_of_cuts(const model::Bodies &bodies)
    {
      std::map<unsigned int, unsigned int> slaves;
      for (const pairing::ContactNode &node : bodies.contact_nodes)
        if (node.opening)
          slaves[*node.opening] = node.body;
      return slaves;
    }

    /** Bodies that are factorised: frames that meet no other body, and little
     * that meets frames. */
    std::vector<bool>
    are_direct(const model::Bodies &bodies, const Pairs &pairs)
    {
      // So many dofs take no longer to factorise in each step of Newton's
      // method than to iterate.
      const unsigned int        few   = bodies.dim == 2 ? 10000 : 3000;
      const std::size_t         n     = bodies.structures.size();
      const auto                group = groups_of_bodies(pairs, n);
      std::vector<unsigned int> n_bodies(n, 0), n_dofs(n, 0), n_frames(n, 0);
      for (unsigned int b = 0; b < n; ++b)
        {
          const bodies::Structure &structure = *bodies.structures[b];
          n_bodies[group[b]] += 1;
          n_dofs[group[b]] += structure.n_dofs();
          n_frames[group[b]] += is_frame(bodies, b) ? 1 : 0;
        }
      std::vector<bool> result;
      for (unsigned int b = 0; b < n; ++b)
        result.push_back(n_frames[group[b]] > 0 &&
                         (n_bodies[group[b]] == 1 || n_dofs[group[b]] <= few));
      // The rigid body that opens a tie is where its sides are.
      for (const auto &[body, sides] : sides_of_cuts(bodies))
        result[body] = result[sides];
      return result;
    }

    void
    insert_all(const Coordinates      &coordinates,
               const unsigned int      body,
               const unsigned int      n_nodes,
               std::set<unsigned int> &nodes)
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          const unsigned int number = coordinates.number(body, i);
          nodes.insert(
            {node_of_displacements(number), node_of_rotations(number)});
        }
    }
  } // namespace



  /* Which nodes the smoother solves together, as a surface, and which are
     factorised as a system of their own. */
  SpecialNodes
  special_nodes(const ElasticSystem &elastic,
                const Coordinates   &coordinates,
                const ContactPoints &points)
  {
    // Masters with much harder slaves have soft motions of short waves, which a
    // smoother of single nodes leaves: see SurfaceSmoother.
    constexpr double     much   = 20;
    const model::Bodies &bodies = elastic.bodies;
    const auto           frame  = [&](const unsigned int body) {
      return is_frame(bodies, body);
    };
    const Pairs pairs  = find_pairs(elastic, coordinates, points);
    const auto  direct = are_direct(bodies, pairs);

    SpecialNodes nodes;
    for (const auto &[who, pair] : pairs)
      if (pair.slave > much * pair.master || frame(who.first) ||
          frame(who.second))
        nodes.together.insert(pair.nodes.begin(), pair.nodes.end());
    for (unsigned int b = 0; b < bodies.structures.size(); ++b)
      if (direct[b] || frame(b))
        insert_all(coordinates,
                   b,
                   bodies.structures[b]->n_nodes(),
                   direct[b] ? nodes.direct : nodes.together);
    return nodes;
  }



  /* Rows H over all dofs: d . (weight u) at all sides of a point, with its dual
     directions d in the frame of each body. */
  Eigen::SparseMatrix<double, Eigen::RowMajor>
  rows_of_further(const model::Bodies &bodies,
                  const Coordinates   &coordinates,
                  const ContactPoints &points)
  {
    std::vector<Eigen::Triplet<double>> entries;
    int                                 row = 0;
    for (const Eigen::Index i : coordinates.contact_axes().further_nodes())
      for (const Tensor<1, 3> &along : points[i].dual)
        {
          const auto add = [&](const unsigned int body,
                               const unsigned int node,
                               const double       weight) {
            const Tensor<1, 3> own = bodies.in_frame(body, along);
            const auto first = static_cast<int>(coordinates.dof(body, node));
            for (unsigned int d = 0; d < bodies.dim; ++d)
              entries.emplace_back(row,
                                   first + static_cast<int>(d),
                                   weight * own[d]);
          };
          pairing::for_each_side(*points[i].node, add);
          ++row;
        }
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows(row,
                                                      coordinates.n_dofs());
    rows.setFromTriplets(entries.begin(), entries.end());
    return rows;
  }



  namespace
  {
    using FurtherRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    /**
     * Stiffnesses of rows: those of springs, whose law has one. Much more than
     * what is around a spring would take the digits of all else there.
     */
    VectorXd
    stiffness_of_rows(const ElasticSystem             &elastic,
                      const ContactPoints             &points,
                      const std::vector<Eigen::Index> &further,
                      const FurtherRows               &rows)
    {
      constexpr double much = 1e3;
      VectorXd         all  = VectorXd::Zero(rows.rows()), diagonal;
      Eigen::Index     row  = 0;
      for (const Eigen::Index i : further)
        for (std::size_t k = 0; k < points[i].dual.size(); ++k, ++row)
          if (const auto &spring = points[i].node->spring; spring)
            {
              if (diagonal.size() == 0)
                diagonal = diagonal_of(elastic, rows.cols());
              double sum = 0, squares = 0;
              for (FurtherRows::InnerIterator e(rows, row); e; ++e)
                {
                  const double square = e.value() * e.value();
                  sum += square * diagonal[e.col()];
                  squares += square;
                }
              const double own = 1 / spring->compliance();
              all[row] = sum > 0 ? std::min(own, much * sum / squares) : own;
            }
      return all;
    }
  } // namespace



  /* H of the unknowns is that of all dofs times C of u = C q: entries of a row
     are added up where an unknown comes more than once. */
  std::optional<iterative::FurtherContacts>
  further_contacts(const ElasticSystem &elastic,
                   const Coordinates   &coordinates,
                   const ContactPoints &points)
  {
    const ContactAxes &axes = coordinates.contact_axes();
    if (axes.further_nodes().empty())
      return {};
    const auto of_dofs = rows_of_further(elastic.bodies, coordinates, points);
    std::vector<Eigen::Triplet<double>> entries;
    for (int row = 0; row < of_dofs.rows(); ++row)
      for (iterative::FurtherContacts::Rows::InnerIterator e(of_dofs, row); e;
           ++e)
        coordinates.for_row(e.col(),
                            [&](const Eigen::Index unknown,
                                const double       factor) {
                              entries.emplace_back(row,
                                                   static_cast<int>(unknown),
                                                   factor * e.value());
                            });
    iterative::FurtherContacts::Rows rows(of_dofs.rows(),
                                          coordinates.n_unknowns());
    rows.setFromTriplets(entries.begin(), entries.end());
    return iterative::FurtherContacts{
      std::move(rows),
      stiffness_of_rows(elastic, points, axes.further_nodes(), of_dofs),
      points.layout(),
      axes.own_nodes(),
      axes.further_nodes()};
  }



  iterative::Elements
  springs_of(const iterative::FurtherContacts &further)
  {
    using Eigen::Index;
    using iterative::FurtherContacts;
    iterative::Elements elements;
    const auto          for_each_row = [&further](const auto &visit) {
      std::vector<Index>  unknowns;
      std::vector<double> row;
      for (Index k = 0; k < further.H.rows(); ++k)
        if (further.S[k] > 0)
          {
            unknowns.clear();
            row.clear();
            for (FurtherContacts::Rows::InnerIterator entry(further.H, k);
                 entry;
                 ++entry)
              {
                unknowns.push_back(entry.col());
                row.push_back(entry.value());
              }
            visit(k, unknowns, row);
          }
    };
    elements.for_each = [for_each_row, &further](const auto &visit) {
      for_each_row([&](const Index                k,
                       const std::vector<Index>  &unknowns,
                       const std::vector<double> &row) {
        const Eigen::Map<const VectorXd> h(row.data(),
                                           static_cast<Index>(row.size()));
        const Eigen::MatrixXd matrix = further.S[k] * h * h.transpose();
        visit(unknowns, matrix.data());
      });
    };
    elements.for_each_connection = [for_each_row](const auto &visit) {
      for_each_row([&](const Index,
                       const std::vector<Index> &unknowns,
                       const std::vector<double> &) { visit(unknowns); });
    };
    return elements;
  }



  /* Sides are numbered by bodies, from 1 on: nodes that are not told are on
     side 0, with the master. A negative side is that of a node by itself. */
  std::map<unsigned int, int>
  sides_of_ties(const model::Bodies &bodies, const Coordinates &coordinates)
  {
    std::map<unsigned int, int> sides;
    for (const auto &[opening, slave] : sides_of_cuts(bodies))
      {
        for (unsigned int i = 0; i < bodies.structures[slave]->n_nodes(); ++i)
          sides[node_of_displacements(coordinates.number(slave, i))] =
            static_cast<int>(slave) + 1;
        sides[node_of_displacements(coordinates.number(opening, 0))] = -1;
      }
    return sides;
  }
} // namespace conetact::contact
