// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/warnings.h"

#include "conetact/base/joined_warnings.h"
#include "conetact/base/text.h"
#include "conetact/contact/force_shares.h"
#include "conetact/contact/open_motions.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::analysis
{
  namespace
  {
    using Eigen::Index;

    constexpr double large_deformation = .1; ///< of the size of a body
    constexpr double large_rotation    = .05;
    constexpr double large_strain      = .1;
  } // namespace

  Warnings::Warnings(const contact::ContactModel &m, Log &l)
    : model(m)
    , log(l)
    , shortest_sides(m.bodies.structures.size(), 0.)
  {}

  void
  Warnings::once(const std::string &kind, const std::string &sentence)
  {
    if (said.insert(kind).second)
      log.say("warning: " + sentence);
  }

  bool
  Warnings::is_determinate(const solvers::ContactState &state,
                           const double                 largest_force,
                           const solvers::NodalLaws    *laws)
  {
    AssertDimension(state.node.size(), model.points.size());
    const contact::OpenMotions open(
      model.motions, model.points, state, largest_force, laws);
    const Eigen::VectorXd elsewhere = open.elsewhere();
    if (elsewhere.size() == 0)
      return true;
    const contact::RigidMotions::Motion motion =
      model.motions.largest(model.motions.of_free(elsewhere));
    const contact::ContactPoints &points = model.points;
    const bool                    is_pressed =
      std::any_of(points.begin(),
                  points.end(),
                  [&](const contact::ContactPoint &point) {
                    return !contact::carries_nothing(state.r[point.normal()],
                                                     largest_force);
                  }) ||
      points.n_bound() > 0;
    once("position",
         model.bodies.called(motion.body) + " may move " + describe(motion) +
           ", which nothing opposes: " +
           (is_pressed ? "forces are determined, its position is not, "
                         "and " :
                         "nothing presses it, and its position is not "
                         "determined; ") +
           "the shortest motion is taken.");
    return false;
  }

  bool
  Warnings::are_forces_determinate(
    const std::vector<solvers::NodeState> &states,
    const Eigen::VectorXd                 &r)
  {
    const pairing::ContactNode *twice = model.held_twice();
    if (twice != nullptr)
      once("held twice",
           "the node at " + to_text(twice->position) + " of body '" +
             model.bodies.names[twice->body] +
             "' is bound by a contact along what supports or other bound "
             "contacts hold as well: how they share its force is not "
             "determined, the sum is; the least forces of bound contacts are "
             "given.");
    const pairing::ContactNode *node =
      contact::undetermined_share(model.points, states, r);
    if (node == nullptr)
      return twice == nullptr;
    once(
      "shares",
      "the node at " + to_text(node->position) + " of body '" +
        model.bodies.names[node->body] +
        "' is in several contacts, some with friction: how they share its "
        "force is not determined, nor is what follows from that; one of many "
        "solutions is given.");
    return false;
  }

  /* To ask for all positions in each increment takes longer than to pull. */
  double
  Warnings::shortest_side(const unsigned int body)
  {
    double &shortest = shortest_sides.at(body);
    if (shortest > 0)
      return shortest;
    const bodies::Structure &structure = *model.bodies.structures[body];
    const unsigned int       n_c       = structure.n_components();
    double                   least     = std::numeric_limits<double>::max();
    structure.elements().for_each_connection(
      [&](const std::vector<unsigned int> &dofs) {
        const unsigned int a      = dofs.front() / n_c;
        const Point<3>     origin = structure.position(a);
        for (const unsigned int dof : dofs)
          if (const unsigned int b = dof / n_c; b != a)
            least =
              std::min(least, origin.distance_square(structure.position(b)));
      });
    shortest = std::sqrt(least);
    return shortest;
  }

  /* Over the distance of two nodes of an element: how much they move apart, and
     how far they move at all, which is what their line turns by besides. */
  Warnings::Strained
  Warnings::strained(const unsigned int body, const Eigen::VectorXd &w)
  {
    AssertDimension(w.size(), model.coordinates.n_dofs());
    const bodies::Structure &structure = *model.bodies.structures[body];
    const unsigned int n_c = structure.n_components(), dim = model.bodies.dim;
    const Index        offset = model.coordinates.offset(body);
    const Index        n      = model.coordinates.offset(body + 1) - offset;
    Strained           most;
    if (structure.elements().largest_stretch(w.segment(offset, n)) <=
        large_strain * shortest_side(body))
      return most;
    structure.elements().for_each_connection(
      [&](const std::vector<unsigned int> &dofs) {
        const unsigned int a = dofs.front() / n_c;
        for (const unsigned int dof : dofs)
          if (const unsigned int b = dof / n_c; b != a)
            {
              Tensor<1, 3> moved;
              for (unsigned int c = 0; c < dim; ++c)
                moved[c] = w[offset + b * n_c + c] - w[offset + a * n_c + c];
              const Tensor<1, 3> side =
                structure.position(b) - structure.position(a);
              most.strain =
                std::max(most.strain,
                         std::abs(moved * side) / side.norm_square());
              most.turn = std::max(most.turn, moved.norm() / side.norm());
            }
      });
    return most;
  }

  void
  Warnings::check_size(const Eigen::VectorXd &amounts, const Eigen::VectorXd &w)
  {
    AssertDimension(w.size(), model.coordinates.n_dofs());
    std::vector<std::string> sentences;
    const auto               first = [&](const std::string &kind,
                           const std::string &sentence) {
      if (said.insert(kind).second)
        sentences.push_back(sentence);
    };
    for (unsigned int body = 0; body < model.bodies.names.size(); ++body)
      {
        const std::string name   = model.bodies.called(body) + " ";
        const double      size   = 2 * model.motions.size(body);
        const Index       offset = model.coordinates.offset(body);
        const Index       n      = model.coordinates.offset(body + 1) - offset;
        const double      most   = solvers::largest(w.segment(offset, n));
        const std::string theory =
          " Small-strain theory is wrong there: results are those of the "
          "undeformed body.";
        if (const double angle = model.motions.rotation(amounts, body);
            angle > large_rotation)
          first("rotation " + name,
                name + "turns by " + to_text(angle) + " rad." + theory);
        if (most > large_deformation * size && !model.bodies.is_rigid(body))
          first("deformation " + name,
                name + "deforms by " + to_text(most) + ", " +
                  to_text(most / size) + " of its size." + theory);
        // cells may be small: only where the deformation allows for it
        if (most > 1e-4 * size && said.count("strain " + name) == 0)
          if (const Strained by = strained(body, w);
              std::max(by.strain, by.turn) > large_strain)
            first("strain " + name,
                  name +
                    (by.strain > large_strain ?
                       "is strained by about " + to_text(by.strain) :
                       "bends until parts of it turn by about " +
                         to_text(by.turn) + " rad") +
                    "." + theory);
      }
    warn(sentences, log);
  }
} // namespace conetact::analysis
