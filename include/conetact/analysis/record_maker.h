// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_record_maker_h
#define conetact_analysis_record_maker_h

#include "conetact/application/scene.h"
#include "conetact/base/archive.h"
#include "conetact/contact/contact_model.h"
#include "conetact/output/output.h"
#include "conetact/verification/claim.h"

namespace conetact::analysis
{
  /** Writes into the record of an increment what the verification has found of
   * forces, and what is observed of displacements. */
  class RecordMaker
  {
  public:
    /** What is given must outlive the object. */
    RecordMaker(const application::Scene    &scene,
                const contact::ContactModel &model);

    /** Of contacts, supports, loads and obstacles, and how they balance. */
    void
    add_resultants(model::IncrementRecord      &record,
                   const verification::Finding &finding);
    /** What history.csv tells of displacements of all dofs. */
    void
    observe(model::IncrementRecord &record, const Eigen::VectorXd &u) const;
    /** What is drawn: displacements u, of which w is deformation. */
    void
    add_displacements(model::IncrementRecord &record,
                      const Eigen::VectorXd  &u,
                      const Eigen::VectorXd  &w) const;
    /** Bodies before anything acts. */
    model::IncrementRecord
    undeformed() const;

    void
    save(Archive &archive) const;
    void
    restore(const Archive &archive);

  private:
    void
    add_obstacles(model::IncrementRecord      &record,
                  const verification::Finding &finding) const;
    void
    add_preloads(model::IncrementRecord      &record,
                 const verification::Finding &finding) const;

    const application::Scene    &scene;
    const contact::ContactModel &model;
    double                       reach         = 0; ///< of the bodies [length]
    double                       largest_force = 0; ///< on a body so far
  };
} // namespace conetact::analysis

#endif
