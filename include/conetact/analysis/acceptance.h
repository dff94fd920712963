// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_acceptance_h
#define conetact_analysis_acceptance_h

#include "conetact/analysis/record_maker.h"
#include "conetact/analysis/small_kinematics.h"
#include "conetact/analysis/unpaired_bodies.h"
#include "conetact/analysis/warnings.h"
#include "conetact/application/scene.h"
#include "conetact/base/log.h"
#include "conetact/contact/contact_rows.h"
#include "conetact/contact/held_joints.h"
#include "conetact/verification/energies.h"
#include "conetact/verification/verification.h"

#include <string>
#include <utility>
#include <vector>

namespace conetact::analysis
{
  /**
   * What the verification says of increments, and what goes to the tables of
   * those it accepts.
   */
  class Acceptance
  {
  public:
    Acceptance(const application::Scene    &scene,
               const contact::ContactModel &model,
               Log                         &log);

    /** `w`: deformation of all dofs at the end of the increment. */
    verification::Finding
    judge(const PendingIncrement      &increment,
          const contact::SharedVector &w) const;
    /** Forces that are left at all dofs; all processes of the team call this.
     */
    Eigen::VectorXd
    unbalanced(const verification::Finding &finding) const
    {
      return share().gather(finding.unbalanced);
    }
    /** What nodes have lost by wear before supports took them. */
    void
    know_held_depths(std::vector<double> depths)
    {
      held_depths = std::move(depths);
    }
    /** The end of the increment that came last. */
    double
    accepted_time() const
    {
      return verification.accepted_time();
    }
    /** What its table would have of an increment that is not completed. */
    std::vector<model::ContactRow>
    rows_of(const PendingIncrement      &increment,
            const contact::SharedVector &w) const;

    /**
     * Completes the record of the increment, with its displacements where
     * these are `drawn`. Returns why it is not accepted, empty where it is.
     * Increments come in their order, each once.
     */
    std::string
    complete(PendingIncrement            &increment,
             const verification::Finding &finding,
             const contact::SharedVector &w,
             const bool                   drawn);

    /** All processes of the team know all of it then: before it is saved, and
     * before some leave. */
    void
    gather()
    {
      energies.gather(share());
    }
    /** What of it is kept in a checkpoint, and taken from one again. */
    void
    save(Archive &archive) const;
    void
    restore(const Archive &archive);

    /** Increment 0: the bodies before anything acts. */
    model::IncrementRecord
    undeformed() const;

    /** Displacements of all dofs. */
    Eigen::VectorXd
    displacements(const PendingIncrement &increment,
                  const Eigen::VectorXd  &w) const;

    /** Those that were accepted last; empty: none yet. */
    const Eigen::VectorXd &
    accepted_displacements() const
    {
      return contact::numbers(verification.accepted_displacements());
    }
    /** Contacts of the model were found again. */
    void
    relink()
    {
      contact_rows.relink();
    }

    /** Contacts for which small kinematics was chosen and does not hold, by
     * number, and why: finite sliding can do it. */
    const std::map<unsigned int, std::string> &
    leaves_small() const
    {
      return leaves;
    }

    /** Stiffness of each contact node. */
    void
    set_stiffness(const contact::Elasticity &elastic);

    /** Of all rigid motions, in the frames of bodies. */
    Eigen::VectorXd
    amounts(const PendingIncrement &increment) const;

  private:
    /** The dofs of this process. */
    contact::DofShare
    share() const
    {
      return {model.bodies, model.coordinates};
    }
    /** Of all rigid motions. */
    verification::Claim
    claim(const PendingIncrement      &increment,
          const contact::SharedVector &w) const;
    /** Of all contact unknowns. */
    Eigen::VectorXd
    reactions(const PendingIncrement &increment) const;
    std::string
    leave(const unsigned int contact, const SmallKinematics::Left &left);
    /** Amounts of all motions and the deformation of all dofs, of w. */
    std::pair<Eigen::VectorXd, contact::SharedVector>
    motions_and_deformation(const PendingIncrement      &increment,
                            const contact::SharedVector &w) const;
    /** Whether small kinematics no longer holds, a sentence; empty: it does, or
     * is asked for. */
    std::string
    leave_small(const IncrementEnd &end);
    void
    warn_of_tilt(const IncrementEnd &end);
    std::string
    outdated(const IncrementEnd &end, const contact::KeptByLaws &kept);
    std::string
    wrong_at_supports(const PendingIncrement      &increment,
                      const verification::Finding &finding) const;

    const application::Scene           &scene;
    const contact::ContactModel        &model;
    verification::Verification          verification;
    contact::ContactRows                contact_rows;
    verification::Energies              energies;
    Warnings                            warnings;
    SmallKinematics                     small;
    UnpairedBodies                      unpaired;
    contact::HeldJoints                 joints;
    RecordMaker                         records;
    std::map<unsigned int, std::string> leaves;
    std::vector<double> held_depths; ///< of all nodes, or none [length]
  };
} // namespace conetact::analysis

#endif
