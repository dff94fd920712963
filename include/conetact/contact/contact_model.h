// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_contact_model_h
#define conetact_contact_contact_model_h

#include "conetact/contact/condensation.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/node_rules.h"
#include "conetact/contact/rigid_motions.h"

#include <memory>

namespace conetact
{
  /**
   * A scene's bodies made ready for contact solvers: rules of nodes,
   * unknowns, rigid motions and, when first asked for, the condensation.
   */
  class ContactModel
  {
  public:
    /** `times` are those of the increments. Throws InputError. */
    ContactModel(const Bodies &bodies, const std::vector<double> &times);

    const Bodies       &bodies;
    const NodeRules     rules;
    const Coordinates   coordinates;
    const ElasticSystem elastic;
    const RigidMotions  motions;

    /** Made when first asked for. */
    Condensation &
    condensation();
    /** Work with it so far. */
    SchurWork
    work() const
    {
      return condensed ? condensed->work() : SchurWork();
    }

  private:
    bool
    may_be_mechanism() const;
    std::string
    singular_sentence(const SingularMatrix &error) const;

    std::unique_ptr<Condensation> condensed;
  };

  /**
   * One increment in the terms of [K] (17): unknowns are slips of the
   * increment and new gaps, so that @f$ f = f_{total} + K (-u_t, g_0) @f$ with
   * the tangential displacements u_t at its start and the undeformed gaps.
   */
  class ContactHistory
  {
  public:
    explicit ContactHistory(ContactModel &model);

    /** The increment that ends with `load`. */
    ContactProblem
    problem(const Condensation::Load &load);
    /** Where it starts: v = (0, gap), reactions and states so far. */
    ContactState
    start() const;
    /** Takes over the end of an increment. */
    void
    advance(const ContactState &end);

    /** Relative displacements of the contact unknowns since the start. */
    const Eigen::VectorXd &
    displacements() const
    {
      return q;
    }

  private:
    Eigen::VectorXd
    shift() const;

    ContactModel          *model;
    Eigen::VectorXd        initial_gap; ///< of each node with unknowns
    Eigen::VectorXd        q, r;
    std::vector<NodeState> states;
    double                 largest = 0; ///< reaction or load so far [force]
  };
} // namespace conetact

#endif
