// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/contact_search.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/face_nodes.h"
#include "conetact/contact/free_spins.h"
#include "conetact/pairing/found_nodes.h"
#include "conetact/pairing/node_weights.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>

namespace conetact::analysis
{
  ContactSearch::ContactSearch(const pairing::SlidingContacts &c,
                               contact::ContactModel          &m)
    : contacts(c)
    , model(m)
    , passages(contacts, model)
  {
    start.frames = model.bodies.frames;
    if (is_needed())
      start.nodes = model.points.nodes();
  }

  std::string
  ContactSearch::passes_through(const Eigen::VectorXd &u,
                                const double           t,
                                const bool             may_be_cut)
  {
    return passages.pass_through(start, u, t, may_be_cut, inside);
  }

  std::string
  ContactSearch::loses_masters(const Eigen::VectorXd &u, const double t) const
  {
    return passages.lose_masters(start, u, t);
  }

  ContactSearch::Found
  ContactSearch::find_there(const Eigen::VectorXd &u,
                            const double           t,
                            const bool             keep_faced) const
  {
    return contacts.find(
      model.points.nodes(),
      [&](const unsigned int body, const unsigned int node) {
        return model.displacement(u, body, node);
      },
      t,
      keep_faced);
  }

  /* Whether supports hold a node along its normal decides which unknowns it
     has: where it meets nothing its faces, as they bend, must not change that.
   */
  void
  ContactSearch::keep_normals_of_held(Nodes &nodes) const
  {
    const Nodes &last = model.points.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (pairing::ContactNode &node = nodes[i];
          node.slides && node.meets_nothing())
        if (const contact::NodeRule *rule =
              model.rules.find(node.body, node.node);
            rule != nullptr && !rule->held.empty())
          pairing::set_frame(node, last[i].n, model.bodies.dim);
  }

  ContactSearch::Found
  ContactSearch::linearised(Found found) const
  {
    contact::align_with_supports(model.bodies, found.nodes);
    contact::point_to_axes(model.bodies, found.nodes);
    keep_normals_of_held(found.nodes);
    contacts.linearise(found.nodes);
    return found;
  }

  ContactSearch::Found
  ContactSearch::find(const Eigen::VectorXd &u,
                      const double           t,
                      const bool             keep_faced) const
  {
    return linearised(find_there(u, t, keep_faced));
  }

  /* A row between two: its gap is between theirs whatever the displacement. */
  void
  ContactSearch::go_part_of_the_way(const pairing::ContactNode &last,
                                    const Eigen::VectorXd      &u,
                                    const double                part,
                                    pairing::ContactNode       &node) const
  {
    node.n = last.n + part * (node.n - last.n);
    node.n /= node.n.norm();
    if (node.obstacle != nullptr || node.meets_nothing() ||
        last.meets_nothing() || node.master != last.master)
      return;
    const auto at = [&](const unsigned int body, const unsigned int i) {
      return model.displacement(u, body, i);
    };
    const double gap_of_last =
      last.gap + last.n * contact::difference_of_sides(last, at);
    node.gap     = (1 - part) * gap_of_last + part * node.gap;
    node.masters = pairing::mean_of(last.masters, 1 - part, node.masters, part);
    if (!node.slaves.empty() || !last.slaves.empty())
      node.slaves =
        pairing::mean_of(own_side(last), 1 - part, own_side(node), part);
    node.moved = contact::difference_of_sides(node, at);
  }

  ContactSearch::Found
  ContactSearch::find_between(const Eigen::VectorXd &u,
                              const double           t,
                              const double           part) const
  {
    Assert(part >= 0 && part <= 1, dealii::ExcMessage("A part of the way."));
    Found  found = find_there(u, t, /*keep_faced=*/true);
    Nodes &nodes = found.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (const pairing::ContactNode &last = model.points.nodes()[i];
          nodes[i].slides && nodes[i].n * last.n > 0)
        go_part_of_the_way(last, u, part, nodes[i]);
    return linearised(std::move(found));
  }

  namespace
  {
    constexpr double with_friction = 20, without = 170; // degrees

    /** Whether there is friction where nodes slide. */
    bool
    rub(const std::vector<pairing::ContactNode> &nodes)
    {
      return std::any_of(nodes.begin(), nodes.end(), [](const auto &node) {
        return node.slides && node.mu_1 + node.mu_2 > 0;
      });
    }
  } // namespace

  /* Friction opposes the slip from one end of an increment to the other: a
     chord, which a turn by half a circle would reverse. Without friction it
     must be clear which way bodies turn. */
  std::string
  ContactSearch::turns_too_far(const double t) const
  {
    const auto &nodes = model.points.nodes();
    if (!model.points.slide())
      return "";
    const bool   rubs    = rub(nodes);
    const double largest = rubs ? with_friction : without;
    double       turn    = 0;
    const auto   note    = [&](const Expression &angle) {
      turn =
        std::max(turn,
                 std::abs(angle(Point<3>(), t) - angle(Point<3>(), start.t)));
    };
    for (const bodies::Support &support : model.bodies.supports)
      if (support.turn)
        note(support.turn->angle);
    for (const pairing::ContactNode &node : nodes)
      if (node.slides && node.obstacle != nullptr && node.obstacle->turn)
        note(*node.obstacle->turn);
    if (turn <= largest)
      return "";
    return "supports or obstacles Turn by " + to_text(turn) + " degrees, and " +
           (rubs ? "friction knows the slip of an increment as a straight line "
                   "only" :
                   "what they meet on such a way is not known") +
           ", also in parts of the increment. Use increments with turns of " +
           to_text(largest) + " degrees at most";
  }

  /* What supports turn has been asked for; bodies roll beside it by less. */
  std::string
  ContactSearch::rolls_on() const
  {
    constexpr double most = 1.5 * with_friction * M_PI / 180;
    const auto      &now  = model.bodies.frames;
    for (std::size_t b = 0; b < now.size() && b < start.frames.size(); ++b)
      if (pairing::rotation_vector(now[b].rotation *
                                   transpose(start.frames[b].rotation))
              .norm() > most &&
          rub(model.points.nodes()))
        return model.bodies.called(b) + " rolls on and on, by more than " +
               to_text(1.5 * with_friction) +
               " degrees in the smallest part of the increment, as where "
               "nothing holds it. Use smaller loads or increments, or hold it";
    return "";
  }

  ContactSearch::Found
  ContactSearch::guess(const double t)
  {
    const contact::RigidMotions &motions = model.motions;
    Eigen::VectorXd              before  = motions.none(), deformed;
    go_back();
    if (start.u.size() > 0)
      {
        before   = motions.placement(start.t);
        deformed = model.coordinates.in_frames(start.u);
      }
    model.frames.move_with_supports(t);
    Eigen::VectorXd u = motions.field(motions.placement(t) - before);
    if (start.u.size() > 0)
      u += deformed;
    return find(model.coordinates.displacements(u), t);
  }

  ContactSearch::Change
  ContactSearch::change(const PendingIncrement &increment,
                        const Eigen::VectorXd  &u,
                        const Nodes            &found) const
  {
    AssertDimension(found.size(), model.points.nodes().size());
    const auto at = [&](const unsigned int body, const unsigned int node) {
      return model.displacement(u, body, node);
    };
    const auto         &points = model.points.all();
    Eigen::VectorXd     r(model.points.n_all_unknowns());
    std::vector<double> forces;
    double              largest = 0;
    Change              worst;
    r << increment.state.r, increment.bound.r;
    for (const contact::ContactPoint &point : points)
      {
        forces.push_back(contact::force_of(point, r).norm());
        largest = std::max(largest, forces.back());
      }
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const pairing::ContactNode &node = *points[i].node;
        if (!node.slides)
          continue;
        const pairing::ContactNode &now =
          found[static_cast<std::size_t>(&node - model.points.nodes().data())];
        const double t    = increment.record.time;
        const bool   open = i < model.points.size() &&
                          increment.state.node[i] == solvers::NodeState::open;
        pairing::FoundChange change = pairing::change_of(
          node,
          now,
          contact::relative_displacement(now, at, t),
          node.gap + node.n * contact::relative_displacement(node, at, t),
          open || largest == 0 ? 0 : forces[i] / largest);
        if (node.obstacle != nullptr && !open)
          // an obstacle that turns moves otherwise at its other points
          change.force =
            std::max(change.force,
                     forces[i] / largest *
                       (contact::relative_displacement(now, at, t) -
                        contact::relative_displacement(node, at, t))
                         .norm() /
                       node.spacing);
        if (std::max(change.gap, change.force) >
            std::max(worst.gap, worst.force))
          worst.worst = &node;
        worst.gap   = std::max(worst.gap, change.gap);
        worst.force = std::max(worst.force, change.force);
      }
    return worst;
  }

  std::string
  ContactSearch::take(Found found, contact::ContactHistory &history) const
  {
    return found.why_not.empty() ?
             history.relink(std::move(found.nodes), start.u, start.t) :
             found.why_not;
  }

  void
  ContactSearch::accept(const Eigen::VectorXd &u, const double t)
  {
    AssertDimension(u.size(), model.coordinates.n_dofs());
    start.u      = u;
    start.t      = t;
    start.frames = model.bodies.frames;
    start.nodes  = model.points.nodes();
    start.inside = inside;
  }

  void
  ContactSearch::go_back()
  {
    model.frames.place(start.frames);
  }

  void
  ContactSearch::save(Archive &archive) const
  {
    if (!is_needed())
      return;
    pairing::save_found(start.nodes, archive);
    pairing::save_frames(start.frames, archive);
    pairing::save_entries(start.inside, archive);
  }

  namespace
  {
    bool
    is_moved(const pairing::RigidMotion &frame)
    {
      const Tensor<2, 3> turn =
        frame.rotation - dealii::unit_symmetric_tensor<3>();
      return frame.translation.norm_square() + turn.norm_square() > 0;
    }
  } // namespace

  /* Of a run whose contacts stay all is where it was at the start. */
  void
  ContactSearch::restore(const Archive           &archive,
                         contact::ContactHistory &history)
  {
    const bool has_searched = archive.has("found/inside");
    if (!is_needed() && has_searched)
      throw InputError("Option --restart: a support has turned a body of the "
                       "run that is continued, and none does so here. Keep its "
                       "Turn, as an expression that stays the same if need "
                       "be.");
    if (!is_needed())
      return;
    start.u.resize(model.coordinates.n_dofs());
    archive.fill("verification/u", start.u);
    archive.fill("verification/t", start.t);
    if (!has_searched)
      return;
    pairing::restore_frames(archive, start.frames);
    for (unsigned int body = 0; body < start.frames.size(); ++body)
      if (!model.frames.has(body) && is_moved(start.frames[body]))
        throw InputError("Option --restart: " + model.bodies.called(body) +
                         " has turned far in the run that is continued, and "
                         "supports hold it here so that it turns little. Hold "
                         "it as before.");
    pairing::restore_found(archive, model.bodies.structures, start.nodes);
    start.inside =
      pairing::restore_entries(archive, model.bodies.structures, start.nodes);
    go_back();
    if (const std::string why = take({start.nodes}, history); !why.empty())
      throw AnalysisError(why);
  }
} // namespace conetact::analysis
