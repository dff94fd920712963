// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** With fewer unknowns than this, leaving some out saves nothing. */
    constexpr Index fewest_unknowns = 200;

    /** Nearest nodes of each contact that are always in. */
    constexpr std::size_t nearest = 8;

    /** How many times the load is taken, for what the guess overlooks. */
    constexpr double load_factor = 2;

    /** Of the largest displacement: what is less is round-off. */
    constexpr double round_off = 1e-12;

    Index
    index(const std::size_t i)
    {
      return static_cast<Index>(i);
    }

    /** Mean displacement that supports prescribe to each body. */
    std::vector<Tensor<1, 3>>
    mean_motions(const ContactModel &model, const double t)
    {
      const Coordinates        &coordinates = model.coordinates;
      const VectorXd            d           = coordinates.prescribed(t);
      std::vector<Tensor<1, 3>> sum(model.bodies.structures.size());
      std::vector<double>       n(sum.size());
      for (const NodeRule &rule : coordinates.rules().rules())
        if (!rule.held.empty())
          {
            const Index first = coordinates.dof(rule.body, rule.node);
            for (unsigned int c = 0; c < model.bodies.dim; ++c)
              sum[rule.body][c] += d[first + c];
            ++n[rule.body];
          }
      for (std::size_t body = 0; body < sum.size(); ++body)
        if (n[body] > 0)
          sum[body] /= n[body];
      return sum;
    }

    /**
     * Gaps when supports and obstacles have come closest, each body as rigid;
     * what stays apart is moved together, contact by contact.
     */
    VectorXd
    closest_gaps(const ContactModel &model, const std::vector<double> &times)
    {
      const ContactPoints &points = model.points;
      VectorXd             gaps(index(points.size()));
      for (std::size_t i = 0; i < points.size(); ++i)
        gaps[index(i)] = points[i].node->gap;
      VectorXd closest = gaps;
      for (const double t : times)
        {
          const auto motions = mean_motions(model, t);
          for (std::size_t i = 0; i < points.size(); ++i)
            {
              const pairing::ContactNode &node = *points[i].node;
              Tensor<1, 3> opponent            = node.opponent_displacement(t);
              if (!node.masters.empty())
                opponent += motions[node.master];
              closest[index(i)] =
                std::min(closest[index(i)],
                         gaps[index(i)] +
                           node.n * (motions[node.body] - opponent));
            }
        }
      std::map<unsigned int, double> apart;
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          double &least = apart
                            .emplace(points[i].node->contact,
                                     std::numeric_limits<double>::max())
                            .first->second;
          least = std::min(least, closest[index(i)]);
        }
      for (std::size_t i = 0; i < points.size(); ++i)
        closest[index(i)] -= std::max(0., apart[points[i].node->contact]);
      return closest;
    }

    /** Mean diagonal stiffness of each candidate's dofs [force/length]. */
    VectorXd
    nodal_stiffness(const ContactModel &model)
    {
      VectorXd diagonal = VectorXd::Zero(model.coordinates.n_dofs());
      model.elastic.for_each_element(
        [&](const std::vector<unsigned int> &dofs, const double *matrix) {
          for (std::size_t i = 0; i < dofs.size(); ++i)
            diagonal[dofs[i]] += matrix[i * (dofs.size() + 1)];
        });
      const ContactPoints &points = model.points;
      VectorXd             stiffness(index(points.size()));
      for (std::size_t i = 0; i < points.size(); ++i)
        stiffness[index(i)] =
          diagonal
            .segment(model.coordinates.dof(points[i].node->body,
                                           points[i].node->node),
                     model.bodies.dim)
            .mean();
      return stiffness;
    }

    /** Largest sum of the magnitudes of all bodies' loads [force]. */
    double
    largest_load(const ContactModel                            &model,
                 const std::function<VectorXd(const double t)> &forces,
                 const std::vector<double>                     &times)
    {
      double largest = 0;
      for (const double t : times)
        {
          const VectorXd f   = forces(t);
          double         sum = 0;
          for (unsigned int body = 0; body < model.bodies.structures.size();
               ++body)
            {
              const bodies::Structure &structure =
                *model.bodies.structures[body];
              Tensor<1, 3> resultant;
              for (unsigned int i = 0; i < structure.n_nodes(); ++i)
                for (unsigned int c = 0; c < model.bodies.dim; ++c)
                  resultant[c] += f[model.coordinates.dof(body, i) + c];
              sum += resultant.norm();
            }
          largest = std::max(largest, sum);
        }
      return largest;
    }

    /**
     * Number of the nodes, sorted by gap, that are pressed when they carry
     * `load`.
     */
    std::size_t
    n_pressed(const std::vector<Index> &sorted,
              const VectorXd           &gaps,
              const VectorXd           &stiffness,
              const double              load,
              const unsigned int        dim)
    {
      double sum = 0, weighted = 0; // of stiffness, of stiffness x gap
      for (std::size_t n = 0; n < sorted.size(); ++n)
        {
          const double gap = gaps[sorted[n]];
          const double across =
            std::pow(std::max<std::size_t>(n, 1), 1. / (dim - 1));
          // Pressed by the depth `gap`, all nodes before carry k (gap - g_i). A
          // continuum is softer than its nodes one by one, the more the wider
          // the contact.
          if (gap > 0 && (gap * sum - weighted) / across > load)
            return n;
          sum += stiffness[sorted[n]];
          weighted += stiffness[sorted[n]] * gap;
        }
      return sorted.size();
    }

    /** Nodes whose unknowns resist every rigid motion. */
    void
    add_holding_nodes(const ContactModel &model, std::vector<bool> &chosen)
    {
      const Eigen::MatrixXd &motions = model.motions.null_space();
      if (motions.cols() == 0)
        return;
      // Pivoting picks unknowns whose motions are independent: with them fixed
      // no body moves, and K_FF is positive definite.
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(motions.transpose());
      const auto &first = model.points.layout().first;
      for (Index k = 0; k < motions.cols(); ++k)
        {
          const Index unknown = qr.colsPermutation().indices()[k];
          const auto  node =
            std::upper_bound(first.begin(), first.end(), unknown) - 1;
          chosen[static_cast<std::size_t>(node - first.begin())] = true;
        }
    }

    std::vector<Index>
    nodes_of(const std::vector<bool> &chosen)
    {
      std::vector<Index> nodes;
      for (std::size_t i = 0; i < chosen.size(); ++i)
        if (chosen[i])
          nodes.push_back(index(i));
      return nodes;
    }

    /** The set, or all candidates where it is hardly smaller. */
    WorkingSet
    worthwhile(const solvers::ContactSystem &candidates,
               const std::vector<bool>      &chosen)
    {
      WorkingSet set(candidates, nodes_of(chosen));
      if (2 * set.layout().n_unknowns() > candidates.n_unknowns())
        return WorkingSet(candidates);
      return set;
    }
  } // namespace



  WorkingSet
  guess_working_set(const ContactModel                            &model,
                    const std::function<VectorXd(const double t)> &forces,
                    const std::vector<double>                     &times)
  {
    const solvers::ContactSystem &candidates = model.points.layout();
    // Which nodes hold a mechanism is not known beforehand.
    if (candidates.n_unknowns() < fewest_unknowns || model.may_be_mechanism())
      return WorkingSet(candidates);
    const VectorXd gaps      = closest_gaps(model, times);
    const VectorXd stiffness = nodal_stiffness(model);
    const double   load      = largest_load(model, forces, times);

    std::map<unsigned int, std::vector<Index>> of_contact;
    for (Index i = 0; i < candidates.n_nodes(); ++i)
      of_contact[model.points[i].node->contact].push_back(i);
    std::vector<bool> chosen(static_cast<std::size_t>(candidates.n_nodes()));
    for (auto &[contact, nodes] : of_contact)
      {
        std::stable_sort(nodes.begin(),
                         nodes.end(),
                         [&](const Index a, const Index b) {
                           return gaps[a] < gaps[b];
                         });
        const std::size_t n = std::min(nodes.size(),
                                       std::max(nearest,
                                                n_pressed(nodes,
                                                          gaps,
                                                          stiffness,
                                                          load_factor * load,
                                                          model.bodies.dim)));
        for (std::size_t k = 0; k < n; ++k)
          chosen[static_cast<std::size_t>(nodes[k])] = true;
      }
    add_holding_nodes(model, chosen);
    return worthwhile(candidates, chosen);
  }



  std::vector<Index>
  penetrating(const ContactModel &model, const VectorXd &gaps)
  {
    double largest = 0;
    Index  i       = 0;
    for (const ContactPoint &point : model.points)
      // What a gap has moved by is a difference of displacements: their
      // rounding is no penetration.
      largest = std::max(largest, std::abs(gaps[i++] - point.node->gap));
    std::vector<Index> nodes;
    for (i = 0; i < gaps.size(); ++i)
      if (!model.working_set().contains(i) && gaps[i] < -round_off * largest)
        nodes.push_back(i);
    return nodes;
  }



  void
  join(ContactModel &model, const VectorXd &gaps)
  {
    const solvers::ContactSystem &candidates = model.points.layout();
    const std::vector<Index>      nodes      = penetrating(model, gaps);
    if (model.extend(nodes))
      return;
    std::vector<bool> chosen(static_cast<std::size_t>(candidates.n_nodes()));
    for (Index i = 0; i < candidates.n_nodes(); ++i)
      chosen[static_cast<std::size_t>(i)] = model.working_set().contains(i);
    for (const Index i : nodes)
      chosen[static_cast<std::size_t>(i)] = true;
    model.choose(worthwhile(candidates, chosen));
  }
} // namespace conetact::contact
