// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/mechanism.h"

#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    /** Smaller parts of the largest velocity are rest. */
    constexpr double at_rest = 1e-6;

    /** Most nodes that are told one by one. */
    constexpr std::size_t most_told = 8;

    /** Velocity of a contact node in space. */
    Tensor<1, 3>
    in_space(const ContactModel    &model,
             const std::size_t      i,
             const Eigen::VectorXd &velocity)
    {
      const ContactPoint &point = model.points[i];
      Tensor<1, 3>        v;
      for (std::size_t k = 0; k < point.directions.size(); ++k)
        v += velocity[point.first + static_cast<Eigen::Index>(k)] *
             point.directions[k];
      return v;
    }

    /** Whether no body turns along another one, or along the obstacles, as
     * nodes tell whose velocity has a part along their tangents. */
    bool
    are_translations(const ContactPoints             &points,
                     const Mechanism                 &m,
                     const std::vector<Tensor<1, 3>> &v)
    {
      constexpr int                              obstacles = -1;
      std::map<std::pair<int, int>, std::size_t> first; // of each pair
      std::vector<std::size_t>                   nodes = m.slide;
      nodes.insert(nodes.end(), m.stay.begin(), m.stay.end());
      nodes.insert(nodes.end(), m.open.begin(), m.open.end());
      return std::all_of(nodes.begin(), nodes.end(), [&](const std::size_t i) {
        const pairing::ContactNode &node = *points[i].node;
        if (points[i].directions.size() < 2)
          return true;
        const auto pair =
          std::make_pair(static_cast<int>(node.body),
                         node.masters.empty() ? obstacles :
                                                static_cast<int>(node.master));
        return (v[i] - v[first.emplace(pair, i).first->second]).norm() <
               at_rest;
      });
    }

    /** `lifts`: nodes move away from their obstacle, open ones counted. */
    std::string
    kind_of(const Mechanism                 &m,
            const ContactPoints             &points,
            const std::vector<Tensor<1, 3>> &v,
            const bool                       lifts)
    {
      if (m.slide.empty() && m.stay.empty())
        return "lifting";
      // Bodies that stay on one that slides go with it. A single node that
      // slides while others lift is the edge of a body that tips.
      if (!m.slide.empty() && are_translations(points, m, v) &&
          (m.slide.size() > 1 || !lifts))
        return "sliding";
      return lifts ? "tipping" : "turning";
    }
  } // namespace



  /* The velocity is over its largest component: parts of it compare with 1.
     Nodes are told by what they do where they touch, as those that are open
     anyway say nothing of how the body moves. */
  Mechanism
  name_mechanism(const ContactModel      &model,
                 const Eigen::VectorXd   &velocity,
                 const std::vector<bool> &touching)
  {
    AssertDimension(velocity.size(), model.points.n_unknowns());
    AssertDimension(touching.size(), model.points.size());
    const ContactPoints      &points = model.points;
    std::vector<Tensor<1, 3>> v;
    std::set<unsigned int>    moving;
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        v.push_back(in_space(model, i, velocity));
        if (v.back().norm() > at_rest)
          moving.insert(points[i].node->body);
      }
    Mechanism                result;
    bool                     lifts = false;
    std::vector<std::size_t> smooth; // how they slide, if so, nothing tells
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        // v_n > 0 opens the gap.
        const double away =
          velocity[points.layout().normal(static_cast<Eigen::Index>(i))];
        lifts = lifts || away > at_rest;
        if (!touching[i] || moving.count(points[i].node->body) == 0)
          continue;
        if (away > at_rest)
          result.open.push_back(i);
        else if (v[i].norm() > at_rest)
          result.slide.push_back(i);
        else if (points[i].directions.size() > 1)
          result.stay.push_back(i);
        else
          smooth.push_back(i);
      }
    if (lifts)
      {
        result.stay.insert(result.stay.end(), smooth.begin(), smooth.end());
        std::sort(result.stay.begin(), result.stay.end());
      }
    else if (result.slide.empty() && result.stay.empty())
      result.slide = smooth;
    result.kind = kind_of(result, points, v, lifts);
    return result;
  }



  std::string
  name_nodes(const ContactModel             &model,
             const std::vector<std::string> &contact_names,
             const std::vector<std::size_t> &nodes)
  {
    std::map<unsigned int, std::vector<std::string>> of_contact;
    for (const std::size_t i : nodes)
      {
        const pairing::ContactNode &node = *model.points[i].node;
        of_contact[node.contact].push_back(std::to_string(node.node));
      }
    std::vector<std::string> texts;
    for (auto &[contact, numbers] : of_contact)
      {
        const std::size_t n = numbers.size();
        numbers.resize(std::min(n, most_told));
        texts.push_back(
          (n == 1 ? "node " : "nodes ") + conetact::join(numbers) +
          (n > most_told ? " and " + std::to_string(n - most_told) + " more" :
                           "") +
          " of contact '" + contact_names[contact] + "'");
      }
    return conetact::join(texts);
  }
} // namespace conetact::contact
