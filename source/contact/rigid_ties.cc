// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/rigid_ties.h"

#include <algorithm>
#include <utility>

namespace conetact::contact
{
  /* Directions are those of the undeformed state: bodies that are tied turn
     together, and what their ties see of rigid motions stays the same in their
     frame. */
  RigidTies::RigidTies(const model::Bodies &bodies,
                       const RigidModes    &modes,
                       const ContactPoints &points)
  {
    // The row t of a tie: t . a is the displacement along its direction of one
    // side relative to the other by rigid motions a of all bodies.
    const auto make = [&](const pairing::ContactNode &node,
                          const Tensor<1, 3>         &direction) {
      Tie tied{&node, direction, {}};
      pairing::for_each_side(node,
                             [&](const unsigned int body,
                                 const unsigned int number,
                                 const double       weight) {
                               const Eigen::RowVectorXd row = modes.row(
                                 body,
                                 bodies.structures[body]->position(number),
                                 bodies.in_frame(body, weight * direction));
                               const auto [found, is_new] =
                                 tied.rows.emplace(body, row);
                               if (!is_new)
                                 found->second += row;
                             });
      return tied;
    };
    for (std::size_t i = points.size(); i < points.all().size(); ++i)
      {
        const ContactPoint         &point = points.all()[i];
        const pairing::ContactNode &node =
          bodies.contact_nodes[static_cast<std::size_t>(point.node -
                                                        points.nodes().data())];
        for (const Tensor<1, 3> &direction : point.dual)
          ties.push_back(make(node, direction));
      }
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      first.push_back(body);
    join_bodies();
  }



  /* Each body gets the number of the first body that it is tied to, directly or
     by others. */
  void
  RigidTies::join_bodies()
  {
    for (const Tie &tied : ties)
      for (const auto &[body, r] : tied.rows)
        {
          const unsigned int one   = first[tied.node->body];
          const unsigned int other = first[body];
          std::replace(first.begin(),
                       first.end(),
                       std::max(one, other),
                       std::min(one, other));
        }
  }



  /* Bodies that are tied to each other, in ascending order, so that the first
     one stands for all. A body without ties is one by itself. */
  std::vector<std::vector<unsigned int>>
  RigidTies::assemblies() const
  {
    std::vector<std::vector<unsigned int>> of_first(first.size()), found;
    for (unsigned int body = 0; body < first.size(); ++body)
      of_first[first[body]].push_back(body);
    for (const auto &assembly : of_first)
      if (!assembly.empty())
        found.push_back(assembly);
    return found;
  }



  /* The sum of t^T t over ties: its null space among modes are the motions that
     no tie sees. */
  Eigen::MatrixXd
  RigidTies::squares(const unsigned int               first_body,
                     const std::vector<Eigen::Index> &among) const
  {
    const auto n  = static_cast<Eigen::Index>(among.size());
    const auto at = [](const Eigen::Index i) {
      return static_cast<std::size_t>(i);
    };
    Eigen::MatrixXd           sum = Eigen::MatrixXd::Zero(n, n);
    std::vector<Eigen::Index> place; // of each amount among these, or -1
    for (Eigen::Index k = 0; k < n; ++k)
      {
        place.resize(std::max(place.size(), at(among[at(k)]) + 1), -1);
        place[at(among[at(k)])] = k;
      }
    // A tie sees the modes of two or three bodies, of however many there are.
    std::vector<std::pair<Eigen::Index, double>> seen;
    for (const Tie &tied : ties)
      if (first[tied.node->body] == first_body)
        {
          seen.clear();
          for (const auto &[body, r] : tied.rows)
            for (Eigen::Index k = 0; k < r.size(); ++k)
              if (const std::size_t amount = at(body * r.size() + k);
                  amount < place.size() && place[amount] >= 0)
                seen.emplace_back(place[amount], r[k]);
          for (const auto &[i, r_i] : seen)
            for (const auto &[j, r_j] : seen)
              sum(i, j) += r_i * r_j;
        }
    return sum;
  }



  /* The sum of t^T (d - t . a): d is how far an obstacle has moved that a body
     is tied to, 0 between bodies. */
  void
  RigidTies::add_missing(const double               t,
                         const RigidModes::Amounts &amounts,
                         RigidModes::Amounts       &sum) const
  {
    for (const Tie &tied : ties)
      {
        const double moved =
          pairing::obstacle_displacement(*tied.node, t) * tied.direction;
        add(moved - relative(tied, amounts), tied, sum);
      }
  }



  void
  RigidTies::add(const double factor, const Tie &tied, RigidModes::Amounts &sum)
  {
    for (const auto &[body, r] : tied.rows)
      sum.segment(body * r.size(), r.size()) += factor * r.transpose();
  }



  double
  RigidTies::relative(const Tie &tied, const RigidModes::Amounts &amounts)
  {
    double sum = 0;
    for (const auto &[body, r] : tied.rows)
      sum += r.dot(amounts.segment(body * r.size(), r.size()));
    return sum;
  }
} // namespace conetact::contact
