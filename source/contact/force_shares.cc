// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/force_shares.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/QR>

#include <algorithm>
#include <map>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Node = std::pair<unsigned int, unsigned int>; ///< body and number

    /** A closed contact: where it acts, and the forces that it may change. */
    struct Closed
    {
      const pairing::ContactNode          *node;
      std::vector<std::pair<Node, double>> sides;
      std::vector<Tensor<1, 3>>            forces;
      double                               force; ///< what it carries
    };

    bool
    meets_free_obstacle(const pairing::ContactNode &node)
    {
      return node.obstacle != nullptr && !node.masters.empty();
    }

    Closed
    make_closed(const ContactPoint      &point,
                const solvers::NodeState state,
                const Eigen::VectorXd   &r)
    {
      Closed closed{point.node, {}, {}, 0};
      pairing::for_each_side(
        *point.node,
        [&](const unsigned int body,
            const unsigned int number,
            const double       weight) {
          if (weight != 0 &&
              !(meets_free_obstacle(*point.node) && body == point.node->master))
            closed.sides.push_back({{body, number}, weight});
        });
      // it moves as a whole
      if (meets_free_obstacle(*point.node))
        closed.sides.push_back({{point.node->master, 0}, -1.});
      // What sticks may change all components of its force, as long as the cone
      // holds them. Those of a layer that gives way follow from where its sides
      // are.
      const auto &layer = point.node->layer;
      if (state == solvers::NodeState::stick && !(layer && layer->is_sheared()))
        closed.forces.assign(point.dual.begin(), point.dual.end() - 1);
      if (state == solvers::NodeState::stick && !(layer && layer->closes()))
        closed.forces.push_back(point.dual.back());
      if (point.node->is_bound())
        return closed;
      const Tensor<1, 3> force = force_of(point, r);
      closed.force             = force.norm();
      // A slipping contact keeps the direction of its force.
      if (closed.forces.empty() && !(layer && layer->is_soft()))
        // what only touches may press
        closed.forces.push_back(closed.force > 0 ? force / closed.force :
                                                   point.dual.back());
      return closed;
    }

    /**
     * Only contacts of which each node stands in another one, too, can exchange
     * forces: the others are taken away until none is left to take. Few remain,
     * those of corners.
     */
    std::vector<Closed>
    joined(std::vector<Closed> all)
    {
      for (bool changed = true; changed;)
        {
          std::map<Node, unsigned int> n_at;
          for (const Closed &closed : all)
            for (const auto &[node, weight] : closed.sides)
              ++n_at[node];
          const auto alone =
            std::partition(all.begin(), all.end(), [&](const Closed &closed) {
              return std::all_of(closed.sides.begin(),
                                 closed.sides.end(),
                                 [&](const auto &side) {
                                   return n_at[side.first] > 1;
                                 });
            });
          changed = alone != all.end();
          all.erase(alone, all.end());
        }
      return all;
    }

    /** Contacts that share nodes, directly or by others. */
    std::vector<std::vector<const Closed *>>
    groups_of(const std::vector<Closed> &all)
    {
      std::map<Node, std::vector<std::size_t>> at;
      for (std::size_t i = 0; i < all.size(); ++i)
        for (const auto &[node, weight] : all[i].sides)
          at[node].push_back(i);
      std::vector<std::vector<const Closed *>> groups;
      std::vector<bool>                        seen(all.size(), false);
      for (std::size_t i = 0; i < all.size(); ++i)
        {
          std::vector<std::size_t> waiting;
          if (!seen[i])
            {
              groups.emplace_back();
              waiting.push_back(i);
              seen[i] = true;
            }
          // Two contacts of one node are in one group, and so is what shares a
          // node with either.
          while (!waiting.empty())
            {
              const Closed &closed = all[waiting.back()];
              waiting.pop_back();
              groups.back().push_back(&closed);
              for (const auto &[node, weight] : closed.sides)
                for (const std::size_t other : at[node])
                  if (!seen[other])
                    {
                      seen[other] = true;
                      waiting.push_back(other);
                    }
            }
        }
      return groups;
    }

    /** Adds a force on the free obstacle of a node to six rows: its components
     * and moments, as far as they are free. */
    void
    add_to_obstacle(const pairing::ContactNode             &node,
                    const Tensor<1, 3>                     &force,
                    Eigen::Ref<Eigen::Matrix<double, 6, 1>> rows)
    {
      const Tensor<1, 3> moment = dealii::cross_product_3d(
        Tensor<1, 3>(node.foot() - node.obstacle->reference), force);
      for (unsigned int d = 0; d < 3; ++d)
        {
          if (node.obstacle->free.components.at(d))
            rows(d) += force[d];
          if (node.obstacle->free.components.at(d + 3))
            rows(d + 3) += moment[d];
        }
    }

    /**
     * Whether different forces of a group are the same forces on all nodes:
     * columns of H^T, three rows a node, that depend on each other. More
     * columns than rows always do; pivots below 1e-9 of the largest are
     * rounding.
     */
    bool
    exchange_forces(const std::vector<const Closed *> &group)
    {
      // A larger group is no corner, and its rank would take longer than
      // solving.
      constexpr Index       largest = 600;
      std::map<Node, Index> row_of;
      Index                 n_columns = 0, n_rows = 0;
      for (const Closed *closed : group)
        {
          n_columns += static_cast<Index>(closed->forces.size());
          for (const auto &[node, weight] : closed->sides)
            if (row_of.emplace(node, n_rows).second)
              n_rows += meets_free_obstacle(*closed->node) &&
                            node.first == closed->node->master ?
                          6 :
                          3;
        }
      // Rows of H^T: forces along x, y and z on each node. In the plane one of
      // three is zero, and the rank is the same.
      if (n_columns > n_rows)
        return true;
      if (n_columns > largest || n_columns == 0)
        return false;
      Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(n_rows, n_columns);
      Index           column = 0;
      for (const Closed *closed : group)
        for (const Tensor<1, 3> &force : closed->forces)
          {
            for (const auto &[node, weight] : closed->sides)
              if (meets_free_obstacle(*closed->node) &&
                  node.first == closed->node->master)
                add_to_obstacle(*closed->node,
                                weight * force,
                                forces.col(column).segment<6>(row_of[node]));
              else
                for (unsigned int d = 0; d < 3; ++d)
                  forces(row_of[node] + d, column) += weight * force[d];
            ++column;
          }
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(forces);
      qr.setThreshold(1e-9);
      return qr.rank() < n_columns;
    }
  } // namespace

  const pairing::ContactNode *
  undetermined_share(const ContactPoints                   &points,
                     const std::vector<solvers::NodeState> &states,
                     const Eigen::VectorXd                 &r)
  {
    AssertDimension(states.size(), points.size());
    Assert(r.size() >= points.n_unknowns(),
           dealii::ExcMessage("Each candidate has a reaction."));
    // Alone on its obstacle no node can exchange anything, as in most scenes.
    if (!points.traits().shares_nodes &&
        std::all_of(points.begin(),
                    points.end(),
                    [](const ContactPoint &point) {
                      return point.node->masters.empty();
                    }))
      return nullptr;
    std::vector<Closed> closed;
    for (std::size_t i = 0; i < points.size(); ++i)
      // the force of a spring follows from where its ends are
      if (states[i] != solvers::NodeState::open && !points[i].node->spring)
        closed.push_back(make_closed(points[i], states[i], r));
    const bool only_bound = closed.empty();
    for (std::size_t i = points.size(); i < points.all().size() && !only_bound;
         ++i)
      closed.push_back(
        make_closed(points.all()[i], solvers::NodeState::stick, r));
    closed = joined(std::move(closed));
    for (const auto &group : groups_of(closed))
      // Bound contacts by themselves have the shares of RedundantRows, and
      // contacts that carry nothing cannot give.
      if (std::any_of(group.begin(),
                      group.end(),
                      [](const Closed *one) {
                        return !one->node->is_bound();
                      }) &&
          std::any_of(group.begin(),
                      group.end(),
                      [](const Closed *one) {
                        return one->node->is_bound() || one->force > 0;
                      }) &&
          exchange_forces(group))
        return group.front()->node;
    return nullptr;
  }
} // namespace conetact::contact
