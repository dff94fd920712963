// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/acceptance.h"

#include "conetact/base/text.h"
#include "conetact/contact/free_motions.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    /** Over the spacing of nodes: a support that pushes a node in by less is
     * rounding. */
    constexpr double least_depth = 1e-6;

    /** Of coordinates: what they are known to. */
    constexpr double known_to = 16 * 2.2e-16;

    /** A kind of warning: one is enough. */
    const std::string small_is_off = "small kinematics";

    /**
     * States in which nodes touch whose gaps are rounding of positions, and
     * stick whose slips are: which of them are open, or at the limit of their
     * friction, is a matter of chance.
     */
    std::vector<solvers::NodeState>
    states_by_motion(const contact::ContactPoints &points,
                     const solvers::ContactState  &state,
                     const Eigen::VectorXd        &worn,
                     const verification::Finding  &finding,
                     const double                  t)
    {
      using solvers::NodeState;
      std::vector<NodeState> states = state.node;
      const double           moved  = solvers::largest(*finding.u);
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          const pairing::ContactNode &node = *points[i].node;
          const double gap = node.gap + worn[static_cast<Eigen::Index>(i)] +
                             finding.displacements[points[i].normal()];
          const double rounding = known_to * (node.position.norm() + moved);
          const double slip =
            state.v
              .segment(points[i].first, points[i].normal() - points[i].first)
              .norm();
          if (!node.is_active(t))
            continue;
          if (states[i] == NodeState::open && gap <= rounding)
            states[i] = NodeState::slip;
          else if (states[i] == NodeState::slip && slip <= rounding &&
                   points[i].mu > 0)
            states[i] = NodeState::stick;
        }
      return states;
    }

    /** The depths of all masters that wear. */
    std::vector<model::WornNode>
    worn_masters(const contact::Wear &wear)
    {
      std::vector<model::WornNode> nodes;
      for (Eigen::Index i = 0; i < wear.of_sides().size(); ++i)
        nodes.push_back({(*wear.sides())[i].body,
                         (*wear.sides())[i].node,
                         wear.of_sides()[i]});
      return nodes;
    }

    /** Of an increment that is accepted. */
    contact::KeptByLaws
    kept_by_laws(const PendingIncrement       &increment,
                 const contact::ContactPoints &points)
    {
      const contact::ContactHistory &after = increment.after;
      contact::KeptByLaws            kept{&after.memory().wear,
                               after.memory().broken,
                               {},
                               increment.wet};
      const auto                    &laws = increment.load.laws;
      if (!laws || !laws->has_bonds())
        return kept;
      kept.whole.resize(points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          const auto k  = static_cast<Eigen::Index>(i);
          kept.whole[i] = (*laws)[i].bond().is_whole(after.memory().opened[k],
                                                     after.memory().shorn[k]);
        }
      return kept;
    }
  } // namespace

  Acceptance::Acceptance(const application::Scene    &s,
                         const contact::ContactModel &m,
                         Log                         &log)
    : scene(s)
    , model(m)
    , verification(model.bodies,
                   model.elastic,
                   model.coordinates,
                   model.motions,
                   model.points,
                   scene.solver.tolerance)
    , contact_rows(model, scene.master_side)
    , warnings(model, log)
    , small(scene, model)
    , unpaired(scene, model)
    , joints(scene.contact_names, model)
    , records(scene, model)
  {}

  void
  Acceptance::set_stiffness(const contact::Elasticity &elastic)
  {
    const solvers::ContactSystem &system   = *elastic.system();
    const Eigen::VectorXd         diagonal = system.diagonal();
    Eigen::VectorXd               stiffness =
      Eigen::VectorXd::Zero(model.points.layout().n_nodes());
    for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
      {
        const double mean =
          diagonal
            .segment(system.first[static_cast<std::size_t>(i)],
                     system.n_tangents(i) + 1)
            .mean();
        // tr K_ii / dim, or dim / tr W_ii: what turns a gap that is left into a
        // force.
        stiffness[i] = system.form == solvers::Form::stiffness ? mean :
                       mean > 0                                ? 1 / mean :
                                                                 0;
      }
    const double largest = stiffness.size() > 0 ? stiffness.maxCoeff() : 0;
    verification.set_stiffness(stiffness.unaryExpr([largest](const double k) {
      return k > 0 ? k : largest;
    }),
                               elastic.bound().stiffness());
  }

  verification::Claim
  Acceptance::claim(const PendingIncrement      &increment,
                    const contact::SharedVector &w) const
  {
    AssertDimension(w->size(), model.coordinates.n_dofs());
    AssertDimension(increment.forces->size(), w->size());
    verification::Claim claim;
    claim.amounts    = amounts(increment);
    claim.w          = w;
    claim.r          = reactions(increment);
    claim.states     = increment.state.node;
    claim.loads      = increment.forces;
    claim.mechanical = increment.mechanical;
    if (!model.bodies.cuts.empty())
      {
        const Eigen::VectorXd locks = model.lock_forces(claim.r);
        claim.loads                 = contact::shared(*claim.loads + locks);
        claim.mechanical = contact::shared(*claim.mechanical + locks);
      }
    claim.laws  = increment.load.laws;
    claim.worn  = increment.before.memory().wear.receded();
    claim.t     = increment.record.time;
    claim.whole = increment.record.report.substeps <= 1;
    // The holonomic law, of all slip since the start, exists on load paths
    // only.
    claim.incremental =
      !scene.path.follows || scene.path.law == load_path::PathLaw::incremental;
    return claim;
  }

  Eigen::VectorXd
  Acceptance::reactions(const PendingIncrement &increment) const
  {
    AssertDimension(increment.state.r.size() + increment.bound.r.size(),
                    model.points.n_all_unknowns());
    Eigen::VectorXd r(model.points.n_all_unknowns());
    r << increment.state.r, increment.bound.r;
    return r;
  }

  verification::Finding
  Acceptance::judge(const PendingIncrement      &increment,
                    const contact::SharedVector &w) const
  {
    return verification.judge(claim(increment, w));
  }

  std::vector<model::ContactRow>
  Acceptance::rows_of(const PendingIncrement      &increment,
                      const contact::SharedVector &w) const
  {
    const verification::Finding finding = judge(increment, w);
    contact::ContactRows        rows    = contact_rows;
    return rows.rows(increment.state,
                     increment.contact,
                     increment.bound.r,
                     finding.u,
                     increment.record.time);
  }

  Eigen::VectorXd
  Acceptance::amounts(const PendingIncrement &increment) const
  {
    Eigen::VectorXd sum =
      model.amounts(increment.load.placement, increment.motions);
    if (increment.bound.motion.size() > 0)
      sum += increment.bound.motion;
    return sum;
  }

  Eigen::VectorXd
  Acceptance::displacements(const PendingIncrement &increment,
                            const Eigen::VectorXd  &w) const
  {
    AssertDimension(w.size(), model.coordinates.n_dofs());
    return model.coordinates.displacements(
      model.motions.field(amounts(increment)) + w);
  }

  /* What is judged by the size of motions is so whichever way the Elasticity
     has parted them from deformations. */
  std::pair<Eigen::VectorXd, contact::SharedVector>
  Acceptance::motions_and_deformation(const PendingIncrement      &increment,
                                      const contact::SharedVector &w) const
  {
    const Eigen::VectorXd own   = amounts(increment);
    Eigen::VectorXd       moved = contact::motions_with(model.motions, own, *w);
    if (moved == own)
      return {moved, w};
    Eigen::VectorXd deformed = model.motions.field(own - moved);
    deformed += *w;
    return {moved, contact::shared(std::move(deformed))};
  }

  std::string
  Acceptance::wrong_at_supports(const PendingIncrement      &increment,
                                const verification::Finding &finding) const
  {
    AssertDimension(finding.u->size(), model.coordinates.n_dofs());
    const auto       &nodes = model.points.nodes();
    std::vector<bool> has_rows(nodes.size(), false);
    for (const contact::ContactPoint &point : model.points.all())
      has_rows[static_cast<std::size_t>(point.node - nodes.data())] = true;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const pairing::ContactNode &node = nodes[i];
        // Nodes held along their normal are no unknowns of contact: no solver
        // has seen their gaps.
        const bool is_soft = node.layer && node.layer->is_soft();
        if (has_rows[i] || is_soft || !node.is_active(increment.record.time))
          continue;
        const double worn = i < held_depths.size() ? held_depths[i] : 0.;
        const double gap  = node.gap + worn +
                           contact::relative_displacement(
                             model, node, *finding.u, increment.record.time) *
                             node.n;
        if (gap < -least_depth * node.spacing)
          return "a support holds the contact node at " +
                 to_text(node.position) + " of body '" +
                 model.bodies.names[node.body] +
                 "' along its contact normal and pushes it into what it may "
                 "touch, by " +
                 to_text(-gap) +
                 ". Take the node out of the support or of the contact";
      }
    return "";
  }

  /* What is asked for is done, and said. What has been chosen is left for
     finite sliding, where that is possible. */
  std::string
  Acceptance::leave(const unsigned int           contact,
                    const SmallKinematics::Left &left)
  {
    const std::string &why = left.why;
    AssertIndexRange(contact, scene.kinematics.size());
    Assert(!why.empty(), dealii::ExcMessage("What is left has a reason."));
    const pairing::ContactKinematics &of = scene.kinematics[contact];
    if (of.asked == pairing::Kinematics::small)
      {
        warnings.once(small_is_off,
                      "contact '" + scene.contact_names[contact] + "': " + why +
                        ". Contact is that of the undeformed bodies "
                        "(Kinematics = small), and is wrong by as much.");
        return "";
      }
    if (scene.contacts[contact].slides)
      return why;
    if (of.may_slide())
      {
        leaves.emplace(contact, why);
        return why;
      }
    return why + (left.is_let_go ? ": then no equilibrium exists" : "") +
           ". Contact is that of the undeformed bodies: finite sliding, which "
           "would follow them, is not for it (" +
           of.why_not_finite + "). " +
           (left.is_let_go ?
              "Apply less load; where supports move bodies, use a smaller "
              "motion" :
              "Use a smaller motion; Kinematics = small takes such results, "
              "with a warning");
  }

  std::string
  Acceptance::leave_small(const IncrementEnd &end)
  {
    constexpr double too_far = .25; // rad
    std::string      reason;
    for (const auto &[contact, left] : small.left(end))
      if (const std::string more = leave(contact, left); reason.empty())
        reason = more;
    for (const SmallKinematics::Turned &turned : small.turned(end.amounts))
      if (turned.angle <= too_far)
        continue;
      else if (turned.could_turn)
        {
          for (const unsigned int contact : turned.small)
            leaves.emplace(contact, turned.why);
          reason = turned.why;
        }
      else if (turned.is_automatic && !scene.path.follows && reason.empty())
        reason = turned.why +
                 ", and what holds or joins it does not turn with it. Use a "
                 "smaller motion; Kinematics = small takes such results, with "
                 "a warning";
    if (reason.empty())
      warn_of_tilt(end);
    return reason;
  }

  void
  Acceptance::warn_of_tilt(const IncrementEnd &end)
  {
    if (warnings.has_said(small_is_off))
      return;
    const auto tilted = small.tilted(end);
    if (!tilted)
      return;
    const std::string &why_not = scene.kinematics[tilted->first].why_not_finite;
    warnings.once(small_is_off,
                  "contact '" + scene.contact_names[tilted->first] +
                    "': " + tilted->second +
                    ", and contact is that of the undeformed bodies (" +
                    (why_not.empty() ?
                       "Kinematics = finite sliding would follow them" :
                       "finite sliding is not for it: " + why_not) +
                    "): directions of forces are off by as much, friction "
                    "of what is only pressed by more." +
                    (small.all_slips(end.increment, tilted->first) ?
                       " All of its nodes that touch slip: the limit of its "
                       "friction may have been passed." :
                       ""));
  }

  /* The law holds for the contacts as they were linearised. This asks whether
     those are still the right ones. */
  std::string
  Acceptance::outdated(const IncrementEnd &end, const contact::KeptByLaws &kept)
  {
    const PendingIncrement      &increment = end.increment;
    const verification::Finding &finding   = end.finding;
    if (const std::string why = leave_small(end); !why.empty())
      return why;
    if (const std::string why = wrong_at_supports(increment, finding);
        !why.empty())
      return why;
    if (const std::string why =
          joints.parted({accepted_displacements(), accepted_time()},
                        {*finding.u, increment.record.time},
                        increment.state.node,
                        kept.whole);
        !why.empty())
      return why;
    return unpaired.overlap(*finding.u);
  }

  std::string
  Acceptance::complete(PendingIncrement            &increment,
                       const verification::Finding &finding,
                       const contact::SharedVector &w,
                       const bool                   drawn)
  {
    AssertDimension(increment.state.node.size(), model.points.size());
    AssertDimension(increment.contact.size(), model.points.n_unknowns());
    model::IncrementRecord &record = increment.record;
    records.add_resultants(record, finding);
    if (!finding.why.empty())
      return finding.why;
    const contact::KeptByLaws kept = kept_by_laws(increment, model.points);
    const auto [moved, deformed]   = motions_and_deformation(increment, w);
    if (const std::string why =
          outdated({increment, finding, *deformed, moved}, kept);
        !why.empty())
      return why;
    // From here on the increment is history: the next one is judged against it.
    energies.add(share(),
                 model.points,
                 reactions(increment),
                 record.time,
                 verification.accepted_displacements(),
                 finding,
                 record);
    verification.accept(record.time, finding);
    solvers::ContactState told = increment.state;
    // what has worn in the increment itself is no gap any more
    if (increment.load.laws)
      for (std::size_t i = 0; i < model.points.size(); ++i)
        if (const auto &layer = model.points[i].node->layer;
            layer && layer->wears_at_once())
          {
            const auto k = static_cast<Eigen::Index>(i);
            told.v[model.points[i].normal()] +=
              increment.after.memory().wear.worn()[k] -
              increment.before.memory().wear.worn()[k];
          }
    told.r              = finding.r.head(told.r.size());
    record.rows         = contact_rows.rows(told,
                                    increment.contact,
                                    finding.r.tail(increment.bound.r.size()),
                                    finding.u,
                                    record.time,
                                    record.report.substeps <= 1,
                                    kept);
    record.worn_masters = worn_masters(increment.after.memory().wear);
    record.determinate =
      warnings.is_determinate(increment.state,
                              std::max(increment.after.largest_force(),
                                       solvers::largest(increment.state.r)),
                              increment.load.laws.get()) &&
      warnings.are_forces_determinate(
        states_by_motion(model.points,
                         increment.state,
                         increment.before.memory().wear.receded(),
                         finding,
                         record.time),
        increment.state.r);
    warnings.check_size(moved, *deformed);
    records.observe(record, *finding.u);
    if (drawn)
      records.add_displacements(record, *finding.u, *w);
    return "";
  }

  model::IncrementRecord
  Acceptance::undeformed() const
  {
    model::IncrementRecord record = records.undeformed();
    record.rows                   = contact_rows.undeformed();
    return record;
  }

  void
  Acceptance::save(Archive &archive) const
  {
    verification.save(archive);
    contact_rows.save(archive);
    energies.save(archive,
                  scene.support_names,
                  verification.accepted_displacements());
    records.save(archive);
  }

  void
  Acceptance::restore(const Archive &archive)
  {
    verification.restore(archive);
    contact_rows.restore(archive,
                         verification.accepted_displacements(),
                         verification.accepted_time());
    energies.restore(archive, scene.support_names, model.points);
    records.restore(archive);
  }
} // namespace conetact::analysis
