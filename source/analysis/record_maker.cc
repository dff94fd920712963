// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/record_maker.h"

#include "conetact/bodies/frame/frame.h"
#include "conetact/output/extremes.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::analysis
{
  namespace
  {
    /** Of the largest force so far: what is left of it is rounding. */
    constexpr double noise = 64 * 2.2e-16;

    /**
     * The sum of all resultants over the largest of them; nothing where they
     * are rounding of the largest `so far`. Round an axis radial forces cancel
     * by themselves.
     */
    double
    balance_of(const model::IncrementRecord &record,
               const bool                    axisymmetric,
               const double                  reach,
               double                       &so_far)
    {
      model::Resultant sum;
      double           largest = 0;
      const auto       add     = [&](const model::Resultant &resultant) {
        sum.force += resultant.force;
        sum.moment += resultant.moment;
        // a couple has forces, which cancel
        largest = std::max(
          {largest, resultant.force.norm(), resultant.moment.norm() / reach});
      };
      for (const model::Resultant &contact : record.contacts)
        add(contact);
      for (const model::Resultant &support : record.each_support)
        add(support);
      add(record.loads);
      for (const model::ObstacleRecord &obstacle : record.obstacles)
        add(obstacle.contacts);
      so_far = std::max(so_far, largest);
      if (axisymmetric)
        sum.force[0] = 0;
      return largest > noise * so_far ?
               // Moments about the origin, compared with the largest lever.
               std::max(sum.force.norm() / largest,
                        sum.moment.norm() / (largest * reach)) :
               0.;
    }
  } // namespace



  RecordMaker::RecordMaker(const application::Scene    &s,
                           const contact::ContactModel &m)
    : scene(s)
    , model(m)
  {
    for (const bodies::Structure *structure : model.bodies.structures)
      reach = std::max(reach, bodies::reach(*structure));
  }



  void
  RecordMaker::add_resultants(model::IncrementRecord      &record,
                              const verification::Finding &finding)
  {
    Assert(finding.external.contacts.size() <= scene.contact_sides.size(),
           dealii::ExcMessage(
             "Each contact of a finding is one of the scene."));
    AssertDimension(finding.external.masters.size(),
                    finding.external.contacts.size());
    const verification::ExternalForces &external = finding.external;
    record.equilibrium                           = finding.equilibrium;
    record.report.residual                       = finding.residual;
    record.contacts.assign(scene.contact_sides.size(), {});
    for (std::size_t c = 0; c < external.contacts.size(); ++c)
      {
        record.contacts[c] = external.contacts[c];
        if (scene.master_side[c] != c)
          // A contact of two bodies has one column for each side.
          record.contacts[scene.master_side[c]] = external.masters[c];
      }
    record.each_support = external.supports;
    record.supports     = {};
    for (const model::Resultant &support : external.supports)
      {
        record.supports.force += support.force;
        record.supports.moment += support.moment;
      }
    record.loads = external.loads;
    add_obstacles(record, finding);
    add_preloads(record, finding);
    record.body_balance.clear();
    // resultants may vanish where forces do not: a ring shrunk onto another
    for (const verification::Balance &body : external.bodies)
      largest_force = std::max(largest_force, body.forces);
    for (const verification::Balance &body : external.bodies)
      record.body_balance.push_back(
        body.forces > noise * largest_force ? body.error() : 0.);
    record.balance =
      balance_of(record, model.bodies.are_axisymmetric(), reach, largest_force);
    if (record.body_balance.size() == 1)
      record.body_balance.clear();
  }



  /* What contacts do to each obstacle that is free, and how it moves. */
  void
  RecordMaker::add_obstacles(model::IncrementRecord      &record,
                             const verification::Finding &finding) const
  {
    const model::Bodies &bodies = model.bodies;
    record.obstacles.assign(bodies.n_free_obstacles(), {});
    std::vector<bool> taken(finding.external.masters.size(), false);
    for (const contact::ContactPoint &point : model.points.all())
      {
        const pairing::ContactNode &node = *point.node;
        if (node.obstacle == nullptr || node.masters.empty() ||
            taken[node.contact])
          continue;
        taken[node.contact] = true;
        model::Resultant &sum =
          record.obstacles[node.master - bodies.n_elastic()].contacts;
        sum.force += finding.external.masters[node.contact].force;
        sum.moment += finding.external.masters[node.contact].moment;
      }
    for (std::size_t k = 0; k < record.obstacles.size(); ++k)
      {
        // The first node of a rigid body rotates, too.
        const auto         body  = bodies.n_elastic() + k;
        const Eigen::Index first = model.coordinates.offset(body);
        for (unsigned int c = 0;
             c < bodies.structures[body]->n_components() && finding.u;
             ++c)
          if (c < bodies.dim)
            record.obstacles[k].displacement[c] = (*finding.u)[first + c];
          else
            record.obstacles[k].rotation[bodies.dim == 2 ? 2 : c - 3] =
              (*finding.u)[first + c];
      }
  }



  void
  RecordMaker::add_preloads(model::IncrementRecord      &record,
                            const verification::Finding &finding) const
  {
    record.preloads.clear();
    for (const model::Cut &cut : model.bodies.cuts)
      record.preloads.push_back(
        {-(finding.external.contacts[cut.contact].force * cut.axis),
         finding.u ? -model.opening(cut, *finding.u) : 0.});
  }



  void
  RecordMaker::observe(model::IncrementRecord &record,
                       const Eigen::VectorXd  &u) const
  {
    AssertDimension(u.size(), model.coordinates.n_dofs());
    const model::Bodies &bodies = model.bodies;
    const auto size = [&](const unsigned int b, const unsigned int i) {
      return model.displacement(u, b, i).norm();
    };
    record.largest_displacement =
      output::largest_displacement(bodies.structures, bodies.n_elastic(), size);
    record.probes.clear();
    if (scene.probes.empty())
      return;
    const auto actions = scene.actions(record.time);
    for (const bodies::Probe &probe : scene.probes)
      {
        const bodies::Structure &body = *bodies.structures[probe.body];
        record.probes.push_back(probe.displacement(
          u.segment(model.coordinates.offset(probe.body), body.n_dofs())));
        if (const auto *frame = dynamic_cast<const bodies::Frame *>(&body))
          record.probes.back() +=
            frame->deflection_between_nodes(probe.point, actions[probe.body]);
      }
  }



  void
  RecordMaker::add_displacements(model::IncrementRecord &record,
                                 const Eigen::VectorXd  &u,
                                 const Eigen::VectorXd  &w) const
  {
    AssertDimension(u.size(), model.coordinates.n_dofs());
    AssertDimension(w.size(), model.coordinates.n_dofs());
    record.actions = scene.actions(record.time);
    for (std::size_t b = 0; b < scene.bodies.n_elastic(); ++b)
      {
        const Eigen::Index n = scene.bodies.structures[b]->n_dofs();
        record.displacements.push_back(
          u.segment(model.coordinates.offset(b), n));
        record.deformations.push_back(
          w.segment(model.coordinates.offset(b), n));
      }
  }



  model::IncrementRecord
  RecordMaker::undeformed() const
  {
    model::IncrementRecord record;
    for (std::size_t b = 0; b < scene.bodies.n_elastic(); ++b)
      {
        record.displacements.push_back(
          Eigen::VectorXd::Zero(scene.bodies.structures[b]->n_dofs()));
        record.actions.emplace_back();
      }
    return record;
  }



  void
  RecordMaker::save(Archive &archive) const
  {
    archive.put("acceptance/largest_force", largest_force);
  }



  void
  RecordMaker::restore(const Archive &archive)
  {
    archive.fill("acceptance/largest_force", largest_force);
  }
} // namespace conetact::analysis
