// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_verification_energies_h
#define conetact_verification_energies_h

#include "conetact/base/archive.h"
#include "conetact/model/increment_record.h"
#include "conetact/verification/verification.h"

#include <vector>

namespace conetact::verification
{
  /**
   * Energies and works of increments [force x length], by the trapezoidal rule,
   * which is exact for elastic bodies: the work of loads, moving supports,
   * foundations and obstacles less the change of strain energy is what contacts
   * take, by friction and by the motion of their normal reactions. Reactions at
   * the start of an increment work in the frames that contacts had then.
   */
  class Energies
  {
  public:
    /** Writes those of an accepted increment; they come in their order. `u`:
     * of all dofs at the end of the one before; none: 0. All processes of the
     * team call this. */
    void
    add(const contact::DofShare      &share,
        const contact::ContactPoints &points,
        const Eigen::VectorXd        &reactions,
        const double                  t,
        const contact::SharedVector  &u,
        const Finding                &finding,
        model::IncrementRecord       &record);

    /** All processes get what each has: before it is saved, and before the
     * team becomes another one. */
    void
    gather(const contact::DofShare &share);
    /** What of it is kept in a checkpoint, and taken from one again. */
    void
    save(Archive                        &archive,
         const std::vector<std::string> &supports,
         const contact::SharedVector    &u) const;
    /** Springs of supports that the checkpoint does not know are new; points
     * that slide are where it found them. */
    void
    restore(const Archive                  &archive,
            const std::vector<std::string> &supports,
            const contact::ContactPoints   &points);

  private:
    void
    remember_nodes(const contact::ContactPoints &points);

    // at the end of the increment that came last
    Eigen::VectorXd last_forces; ///< external, of this process or all dofs
    std::vector<contact::Foundation> last_foundations;
    std::vector<Tensor<1, 3>>        last_reactions;
    std::vector<pairing::ContactNode>
                    last_nodes; ///< where they are found again
    double          last_t = 0;
    Eigen::VectorXd last_r;
  };
} // namespace conetact::verification

#endif
