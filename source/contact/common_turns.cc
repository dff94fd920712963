// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/common_turns.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace conetact::contact
{
  namespace
  {
    /** Distances of both sides below this part of a cell are rounding. */
    constexpr double turn_rounding = 1e-13;
    /** Further away than so many cells nothing is continued to. */
    constexpr double most_cells = 1;

    /** Numbers of the group of each body: those that contacts join. */
    std::vector<unsigned int>
    groups_of(const model::Bodies &bodies)
    {
      std::vector<unsigned int> group(bodies.structures.size());
      std::iota(group.begin(), group.end(), 0u);
      for (const pairing::ContactNode &node : bodies.contact_nodes)
        if (!node.masters.empty() && group[node.body] != group[node.master])
          std::replace(group.begin(),
                       group.end(),
                       unsigned(group[node.master]),
                       unsigned(group[node.body]));
      return group;
    }

    /** Motions that a group is held against: rows of directions at places. */
    class HeldMotions
    {
    public:
      void
      hold(const Point<3> &place, const Tensor<1, 3> &direction)
      {
        if (held.isZero())
          centre = place;
        size                    = std::max(size, place.distance(centre));
        const Tensor<1, 3> turn = cross_product_3d(place - centre, direction);
        Eigen::Matrix<double, 6, 1> row;
        for (unsigned int d = 0; d < 3; ++d)
          {
            row[d]     = direction[d];
            row[3 + d] = turn[d];
          }
        held += row * row.transpose();
      }

      /** Whether a motion is left that is not a translation. */
      bool
      may_turn(const unsigned int dim) const
      {
        constexpr double nothing = 1e-12;
        if (size == 0)
          return true;
        Motions scaled = held;
        scaled.topRightCorner<3, 3>() /= size;
        scaled.bottomLeftCorner<3, 3>() /= size;
        scaled.bottomRightCorner<3, 3>() /= size * size;
        if (dim == 2)
          for (const Eigen::Index i : {2, 3, 4})
            scaled(i, i) += scaled.trace();
        const Eigen::SelfAdjointEigenSolver<Motions> modes(scaled);
        for (Eigen::Index i = 0; i < 6; ++i)
          if (modes.eigenvalues()[i] <= nothing * scaled.trace() &&
              modes.eigenvectors().col(i).tail<3>().norm() > 1e-6)
            return true;
        return false;
      }

    private:
      using Motions = Eigen::Matrix<double, 6, 6>;
      Motions  held = Motions::Zero();
      Point<3> centre;
      double   size = 0;
    };

    /** Whether supports, and obstacles that a group lies on, leave it a motion
     * that is not a translation. */
    bool
    may_turn(const model::Bodies             &bodies,
             const std::vector<unsigned int> &group,
             const unsigned int               number)
    {
      HeldMotions held;
      for (const bodies::Support &support : bodies.supports)
        if (group[support.body] == number)
          for (const bodies::SurfaceNode &node : support.surface.nodes)
            for (const bodies::Support::Held &way : support.directions_at(node))
              held.hold(bodies.structures[support.body]->position(node.node),
                        way.direction);
      for (const pairing::ContactNode &node : bodies.contact_nodes)
        if (node.obstacle != nullptr && node.masters.empty() &&
            group[node.body] == number &&
            std::abs(node.gap) <= most_cells * node.spacing)
          held.hold(node.position, node.n);
      return held.may_turn(bodies.dim);
    }

    /** The cells of one body that have faces which contact nodes meet. */
    class CellsBehindFaces
    {
    public:
      CellsBehindFaces(const bodies::Structure      &body,
                       const std::set<unsigned int> &met,
                       const unsigned int            dim)
        : n_of_face(dim)
      {
        std::set<unsigned int> hanging;
        for (const bodies::HangingNode &node : body.hanging_nodes())
          hanging.insert(node.node);
        body.elements().for_each_connection(
          [&](const std::vector<unsigned int> &dofs) {
            std::vector<unsigned int> nodes;
            for (std::size_t i = 0; i < dofs.size(); i += dim)
              nodes.push_back(dofs[i] / dim);
            const auto n = std::count_if(nodes.begin(),
                                         nodes.end(),
                                         [&](const unsigned int node) {
                                           return met.count(node) > 0;
                                         });
            if (n < n_of_face)
              return;
            for (const unsigned int node : nodes)
              if (met.count(node) > 0)
                cells_at[node].push_back(cells.size());
            nodes.erase(std::remove_if(nodes.begin(),
                                       nodes.end(),
                                       [&](const unsigned int node) {
                                         return hanging.count(node) > 0;
                                       }),
                        nodes.end());
            cells.push_back(std::move(nodes));
          });
      }

      /** The nodes of cells that have a face of these nodes. */
      std::set<unsigned int>
      nodes_behind(
        const std::vector<std::pair<unsigned int, double>> &face) const
      {
        std::map<std::size_t, int> n_met;
        for (const auto &[node, weight] : face)
          if (const auto found = cells_at.find(node); found != cells_at.end())
            for (const std::size_t cell : found->second)
              ++n_met[cell];
        std::set<unsigned int> nodes;
        for (const auto &[cell, n] : n_met)
          if (n >= n_of_face)
            nodes.insert(cells[cell].begin(), cells[cell].end());
        return nodes;
      }

    private:
      const std::ptrdiff_t                             n_of_face;
      std::vector<std::vector<unsigned int>>           cells;
      std::map<unsigned int, std::vector<std::size_t>> cells_at;
    };

    /** Weights without a sum that lead from one place to another: of those that
     * do the least ones. Empty: these nodes span no space. */
    std::map<unsigned int, double>
    weights_that_lead(const Tensor<1, 3>           &way,
                      const std::set<unsigned int> &nodes,
                      const bodies::Structure      &body,
                      const unsigned int            dim)
    {
      constexpr double flat = 1e-6;
      if (nodes.empty())
        return {};
      Tensor<1, 3> mean;
      for (const unsigned int node : nodes)
        mean += body.position(node) / static_cast<double>(nodes.size());
      const auto arm = [&](const unsigned int node) {
        const Tensor<1, 3> x = body.position(node) - mean;
        return Eigen::Vector3d(x[0], x[1], dim == 3 ? x[2] : 0);
      };
      Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
      for (const unsigned int node : nodes)
        spread += arm(node) * arm(node).transpose();
      if (dim == 2)
        spread(2, 2) = spread.trace();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
      if (axes.eigenvalues()[0] <= flat * axes.eigenvalues()[2])
        return {};
      const Eigen::Vector3d slope =
        spread.inverse() * Eigen::Vector3d(way[0], way[1], way[2]);
      std::map<unsigned int, double> weights;
      for (const unsigned int node : nodes)
        weights[node] = slope.dot(arm(node));
      return weights;
    }

    using Numbers = std::vector<std::size_t>; ///< of contact nodes

    /** Moves the opponents of contact nodes on one master to where they are. */
    void
    move_opponents(const unsigned int master,
                   const Numbers     &numbers,
                   model::Bodies     &bodies)
    {
      const bodies::Structure &body = *bodies.structures[master];
      std::set<unsigned int>   met;
      for (const std::size_t i : numbers)
        for (const auto &[node, weight] : bodies.contact_nodes[i].masters)
          met.insert(node);
      const CellsBehindFaces cells(body, met, bodies.dim);
      for (const std::size_t i : numbers)
        {
          pairing::ContactNode &node = bodies.contact_nodes[i];
          const Tensor<1, 3>    apart =
            pairing::undeformed_distance(node, bodies.structures);
          std::map<unsigned int, double> sum(node.masters.begin(),
                                             node.masters.end());
          for (const auto &[other, weight] : weights_that_lead(
                 apart, cells.nodes_behind(node.masters), body, bodies.dim))
            sum[other] += weight;
          node.masters.assign(sum.begin(), sum.end());
        }
    }

    /** Whether a turn of both bodies would slip there. */
    bool
    stands_apart(const pairing::ContactNode &node, const model::Bodies &bodies)
    {
      if (node.masters.empty() || node.slides || node.spring ||
          node.obstacle != nullptr || node.kind == pairing::ContactKind::tie ||
          bodies.structures[node.master]->n_components() != bodies.dim)
        return false;
      const double apart =
        pairing::undeformed_distance(node, bodies.structures).norm();
      return apart > turn_rounding * node.spacing &&
             apart <= most_cells * node.spacing;
    }
  } // namespace

  void
  keep_common_turns_free(model::Bodies &bodies)
  {
    if (bodies.are_axisymmetric())
      return;
    const std::vector<unsigned int> group = groups_of(bodies);
    std::map<unsigned int, bool>    turns;
    std::map<unsigned int, Numbers> of_master;
    for (std::size_t i = 0; i < bodies.contact_nodes.size(); ++i)
      if (const pairing::ContactNode &node = bodies.contact_nodes[i];
          stands_apart(node, bodies))
        {
          const unsigned int number = group[node.master];
          if (turns.count(number) == 0)
            turns[number] = may_turn(bodies, group, number);
          if (turns[number])
            of_master[node.master].push_back(i);
        }
    for (const auto &[master, numbers] : of_master)
      move_opponents(master, numbers, bodies);
  }
} // namespace conetact::contact
