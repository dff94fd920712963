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

    /** Made when first asked for, of the working set. */
    Condensation &
    condensation();

    /** The candidates to be condensed; all, unless chosen otherwise. */
    const WorkingSet &
    working_set() const
    {
      return condensed ? condensed->working_set() : chosen;
    }
    /** Chooses them; a condensation made before is made anew. */
    void
    choose(WorkingSet set);
    /** Adds candidates to the condensation at hand. */
    void
    extend(const std::vector<Eigen::Index> &nodes);

    bool
    may_be_mechanism() const;

    /** Work with all elastic factors so far. */
    SchurWork
    work() const;

  private:
    std::string
    singular_sentence(const SingularMatrix &error) const;

    WorkingSet                    chosen;
    std::unique_ptr<Condensation> condensed;
    SchurWork                     former_work; ///< before condensed anew
  };

  /**
   * One increment in the terms of [K] (17): unknowns are slips of the
   * increment and new gaps, so that @f$ f = f_{total} + K (-u_t, g_0) @f$ with
   * the tangential displacements u_t at its start and the undeformed gaps. It
   * knows all candidates; problems and states of solvers are those of the
   * model's working set.
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
    /**
     * Displacements of all candidates, once they are known: those outside the
     * working set are taken over.
     */
    void
    recover(const Eigen::VectorXd &displacements);
    /** `end` of an increment for all candidates that began at `before`. */
    ContactState
    of_candidates(const ContactState &end, const ContactHistory &before) const;

    /** Relative displacements of all contact unknowns since the start. */
    const Eigen::VectorXd &
    displacements() const
    {
      return q;
    }
    /** Gaps of all candidates. */
    Eigen::VectorXd
    gaps() const;

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
