// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/acceptance.h"

#include "conetact/base/text.h"

#include <algorithm>

namespace conetact
{
  Acceptance::Acceptance(const Scene &s, const ContactModel &m)
    : scene(s)
    , model(m)
    , contact_rows(model, scene.master_side)
  {}

  Equilibrium
  Acceptance::judge(const PendingIncrement &increment,
                    const Eigen::VectorXd  &u) const
  {
    return check_equilibrium(scene.bodies,
                             model.elastic,
                             model.coordinates,
                             u,
                             increment.state.r,
                             increment.forces,
                             increment.record.time,
                             scene.contact_names.size(),
                             largest_force);
  }

  std::string
  Acceptance::complete(PendingIncrement      &increment,
                       const Equilibrium     &e,
                       const Eigen::VectorXd &u,
                       const bool             drawn)
  {
    IncrementRecord &record = increment.record;
    largest_force           = std::max(largest_force, e.largest_force);
    add_resultants(record, e);
    if (!(record.equilibrium <= scene.solver.tolerance))
      return "the uncondensed equilibrium is violated by " +
             to_text(record.equilibrium) +
             " of the largest nodal force. Forces cannot be told better from "
             "rounding where bodies differ this much in stiffness or move this "
             "far; a larger Solver/Tolerance would accept them";
    record.rows =
      contact_rows.rows(increment.state, increment.contact, u, record.time);
    if (drawn)
      add_displacements(record, u);
    return "";
  }

  void
  Acceptance::add_resultants(IncrementRecord   &record,
                             const Equilibrium &e) const
  {
    record.equilibrium = e.residual;
    record.balance     = e.balance;
    record.contacts    = e.contacts;
    record.contacts.resize(scene.contact_sides.size());
    for (std::size_t c = 0; c < e.masters.size(); ++c)
      if (scene.master_side[c] != c)
        record.contacts[scene.master_side[c]] = e.masters[c];
    if (record.body_balance = e.body_balance; record.body_balance.size() == 1)
      record.body_balance.clear();
    record.supports = e.supports;
    record.loads    = e.loads;
  }

  void
  Acceptance::add_displacements(IncrementRecord       &record,
                                const Eigen::VectorXd &u) const
  {
    record.actions = scene.actions(record.time);
    for (std::size_t b = 0; b < scene.bodies.structures.size(); ++b)
      record.displacements.push_back(
        u.segment(model.coordinates.offset(b),
                  scene.bodies.structures[b]->n_dofs()));
  }
} // namespace conetact
