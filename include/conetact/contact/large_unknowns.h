// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_large_unknowns_h
#define conetact_contact_large_unknowns_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/rigid_motions.h"
#include "conetact/iterative/further_contacts.h"
#include "conetact/iterative/preconditioner.h"

#include <memory>
#include <optional>

namespace conetact::contact
{
  /**
   * A LargeSystem of all bodies, and how its unknowns and displacements of all
   * dofs make each other. Nodes that face a master have the displacement
   * relative to it as unknowns. Of several contacts of a node one has these
   * axes, the others stand beside the unknowns (iterative::FurtherContacts). A
   * process has own numbers of the unknowns.
   */
  class LargeUnknowns
  {
  public:
    using VectorXd = Eigen::VectorXd;

    /** References must outlive the object. */
    LargeUnknowns(const ElasticSystem            &elastic,
                  const NodeRules                &supports,
                  const ContactPoints            &points,
                  const RigidMotions             &motions,
                  const iterative::Preconditioner preconditioner);
    LargeUnknowns(const LargeUnknowns &) = delete;
    LargeUnknowns &
    operator=(const LargeUnknowns &) = delete;

    const Coordinates                               coordinates;
    const std::optional<iterative::FurtherContacts> further;
    std::shared_ptr<const solvers::LargeSystem>     system;

    /** Own numbers of those of all unknowns. */
    VectorXd
    own(VectorXd x) const;
    /** From own numbers all those of the elastic system, by all processes; */
    VectorXd
    elastic_part(const VectorXd &x) const;
    /** the displacements that they are, */
    VectorXd
    displacements(const VectorXd &x) const;
    /** also where nothing may touch, and no solver has been asked under this
     * load, */
    VectorXd
    displacements(const VectorXd &load, const VectorXd &x) const;
    /** and without motions that nothing resists: the shortest ones. */
    VectorXd
    field(const VectorXd &x) const;
    VectorXd
    without_motion(VectorXd w) const;
    /** All unknowns of displacements. */
    VectorXd
    values(const VectorXd &u) const;
    /** Own numbers of forces on all dofs. */
    VectorXd restrict(const VectorXd &forces) const;
    /** Amounts of the free motions in displacements by unknowns, least
     * squares; */
    VectorXd
    motions_in(const VectorXd &x) const;
    /** all unknowns of such amounts, */
    VectorXd
    of_motions(const VectorXd &a) const;
    /** and own numbers of forces by which foundations resist them. */
    VectorXd
    resistance(const VectorXd &a) const;

  private:
    const ElasticSystem  &elastic;
    const ContactPoints  &points;
    const RigidMotions   &motions;
    const Eigen::MatrixXd nowhere; ///< motions that nothing resists
  };
} // namespace conetact::contact

#endif
