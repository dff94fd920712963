// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_contact_rows_h
#define conetact_contact_contact_rows_h

#include "conetact/base/archive.h"
#include "conetact/contact/contact_model.h"
#include "conetact/contact/shared_vector.h"
#include "conetact/contact/wear.h"
#include "conetact/model/increment_record.h"

#include <vector>

namespace conetact::contact
{
  /** What laws of contact nodes have kept of all candidates; or nothing. */
  struct KeptByLaws
  {
    const Wear       *wear = nullptr; ///< which outlives this; null: nothing
    Eigen::VectorXd   fracture;       ///< work against bonds [force x length]
    std::vector<bool> whole;          ///< bonds
    std::vector<bool> wet;            ///< what a fluid has reached
  };

  /**
   * Translates the solver's unknowns of contact nodes into the terms of users:
   * gap, normal and tangential displacement, slip, reaction and state in each
   * node's frame. Remembers displacements from increment to increment.
   */
  class ContactRows
  {
  public:
    ContactRows(const ContactModel              &model,
                const std::vector<unsigned int> &master_side);

    /**
     * Rows of all contact nodes; then, for pairs of bodies, those of the
     * master nodes they meet, whose contact index is that of `master_side`:
     * reactions there are minus those of the pair's nodes, gaps and
     * displacements their weighted means, states those of the nodes that they
     * carry most of. Where they carry nothing they are open, unless all nodes
     * above them are in one other state.
     *
     * Of an increment that was not solved as a `whole`, states tell the slip
     * of all its parts. `state`: end of the increment; `q`: displacements of
     * the contact unknowns since the start; `r_bound`: reactions of what is
     * bound, whose rows stand behind those of candidates; `u`: all dofs; `t`:
     * time.
     */
    std::vector<model::ContactRow>
    rows(const solvers::ContactState &state,
         const Eigen::VectorXd       &q,
         const Eigen::VectorXd       &r_bound,
         const SharedVector          &u,
         const double                 t,
         const bool                   whole = true,
         const KeptByLaws            &kept  = {});

    /**
     * Contacts were found again: their frames and feet, and what they moved by
     * until the end of the last increment.
     */
    void
    relink();
    /** What of it is kept in a checkpoint, and taken from one again: of the
     * contacts as the model has found them, at these displacements of all dofs
     * and time t. */
    void
    save(Archive &archive) const;
    void
    restore(const Archive      &archive,
            const SharedVector &displacements,
            const double        t);

    /** Before the first increment: gaps, and nothing else. */
    std::vector<model::ContactRow>
    undeformed() const;

  private:
    void
    place(const pairing::ContactNode &node, model::ContactRow &row) const;
    void
    set_candidate(const std::size_t            i,
                  const solvers::ContactState &state,
                  const Eigen::VectorXd       &q,
                  const Tensor<1, 3>          &other,
                  model::ContactRow           &row) const;
    void
    set_kept(const std::size_t  i,
             const KeptByLaws  &kept,
             model::ContactRow &row) const;
    static void
    set_bound(const ContactPoint &point,
              const Tensor<1, 3> &other,
              model::ContactRow  &row);
    void
    append_masters(std::vector<model::ContactRow> &rows,
                   const Wear                     *wear = nullptr) const;

    const ContactModel            &model;
    std::vector<unsigned int>      master_side;  ///< of each contact
    std::vector<model::ContactRow> last;         ///< of the increment before
    std::vector<Tensor<1, 3>>      other_before; ///< its displacements along
                                                 ///< directions without a cone
    SharedVector last_u; ///< of all dofs then; none: the start
    double       last_t = 0;
  };
} // namespace conetact::contact

#endif
