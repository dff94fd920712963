// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_iterative_elasticity_h
#define conetact_contact_iterative_elasticity_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/elasticity.h"
#include "conetact/contact/rigid_motions.h"
#include "conetact/iterative/further_contacts.h"
#include "conetact/iterative/preconditioner.h"

#include <optional>

namespace conetact::contact
{
  /**
   * The elastic system with all its unknowns, for solvers of LargeSystem: what
   * is too large to be condensed. Loads and what is primal are a process's own
   * numbers of the LargeSystem. Nodes that face a master have the displacement
   * relative to it as unknowns. Of several contacts of a node one has these
   * axes, the others stand beside the unknowns (iterative::FurtherContacts).
   */
  class IterativeElasticity : public Elasticity
  {
  public:
    /** Arguments must outlive the object. */
    IterativeElasticity(const ElasticSystem            &elastic,
                        const NodeRules                &supports,
                        const ContactPoints            &points,
                        const RigidMotions             &motions,
                        const iterative::Preconditioner preconditioner);

    std::vector<Eigen::VectorXd>
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const override;
    void
    write(const LoadCase          &load,
          const Eigen::VectorXd   &offset,
          const ElasticState      &state,
          solvers::ContactProblem &problem) const override;
    Eigen::VectorXd
    moved_by(const Eigen::VectorXd &base) const override;
    double
    largest_force(const LoadCase &load) const override;
    double
    reference_force(const LoadCase &load) const override;
    Eigen::VectorXd
    contact_load(const solvers::ContactProblem &problem) const override;
    void
    begin(const ElasticState    &state,
          solvers::ContactState &start) const override;
    void
    end(const solvers::ContactState &end, ElasticState &state) const override;
    Eigen::VectorXd
    primal(const ElasticState &state, const Eigen::VectorXd &r) const override;
    void
    move(const Eigen::VectorXd &amounts,
         const Eigen::VectorXd &seen,
         solvers::ContactState &end) const override;
    Eigen::VectorXd
    whole_start(const ElasticState &state) const override;
    void
    restore(const std::vector<double> &start,
            const Eigen::VectorXd     &q,
            ElasticState              &state) const override;
    bool
    linearise_about(const solvers::ContactProblem &problem,
                    const solvers::ContactState   &state,
                    ElasticState                  &elastic) const override;
    /** Also by unknowns of contacts that were there before. */
    Eigen::VectorXd
    deformation(const Eigen::VectorXd &primal) const override;
    Eigen::VectorXd
    nearby(const Eigen::VectorXd &w,
           const Eigen::VectorXd &amounts) const override;
    LoadCase
    reduce_unbalanced(const Eigen::VectorXd &unbalanced) const override;
    Eigen::VectorXd
    correction(const LoadCase        &change,
               const Eigen::VectorXd &primal) const override;
    bool
    is_rounded_by(const Eigen::VectorXd &motions,
                  const Eigen::VectorXd &w) const override;
    void
    move_bound(const Eigen::VectorXd &offset, LoadCase &load) const override;
    BoundState
    bound_state(const LoadCase        &load,
                const Eigen::VectorXd &primal) const override;
    Eigen::VectorXd
    bound_stiffness() const override
    {
      return stiffness_of_bound;
    }
    /** Gaps alone may change, and no node may turn or face others. */
    bool
    relink() override
    {
      return describe_contacts() == contacts;
    }
    /** What opened a tie was an unknown. */
    bool
    see_motions() override
    {
      return false;
    }
    std::string
    description() const override
    {
      return "stiffness of all unknowns, levels of multigrid";
    }

  protected:
    void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) override;
    LoadCase
    nothing() const override;

  private:
    /** Amounts of the free motions in displacements by unknowns, least
     * squares. */
    Eigen::VectorXd
    motions_in(const Eigen::VectorXd &values) const;
    /** The unknowns of such amounts. */
    Eigen::VectorXd
    values_of_motions(const Eigen::VectorXd &a) const;
    /** Forces on all unknowns by which foundations resist them. */
    Eigen::VectorXd
    resistance(const Eigen::VectorXd &a) const;
    /** Directions of contact nodes in the frames of both sides, and weights of
     * their masters: numbers one behind the other. */
    std::vector<double>
    describe_contacts() const;
    /** All unknowns of a load case and its primal. */
    Eigen::VectorXd
    unknowns(const LoadCase &load, const Eigen::VectorXd &primal) const;
    /** Displacements of all dofs by those of what is bound. */
    Eigen::VectorXd
    expand_bound(const Eigen::VectorXd &v) const;
    /** Forces on all dofs, as what is bound sees them. */
    Eigen::VectorXd
    restrict_bound(const Eigen::VectorXd &forces) const;
    /** From the diagonal of K, of all dofs. */
    void
    find_stiffness_of_bound(const Eigen::VectorXd &diagonal);
    /** Own numbers of those of all unknowns of solvers. */
    Eigen::VectorXd
    own(Eigen::VectorXd x) const;
    /** From own numbers of solvers' unknowns all those of the elastic system,
     * by all processes; and all of solvers from these. */
    Eigen::VectorXd
    elastic_part(const Eigen::VectorXd &x) const;
    Eigen::VectorXd
    with_further(const Eigen::VectorXd &u) const;
    /** Where nothing opposes a motion the shortest one is taken. */
    Eigen::VectorXd
    without_motion(Eigen::VectorXd w) const;

    const ElasticSystem  &elastic;
    const ContactPoints  &points;
    const RigidMotions   &motions;
    const Coordinates     coordinates;
    const Eigen::MatrixXd nowhere; ///< motions that nothing resists
    const Eigen::Index    n_bound;
    const std::optional<iterative::FurtherContacts> further;
    /** What these see of all dofs. */
    const Eigen::SparseMatrix<double, Eigen::RowMajor> rows_of_dofs;
    const std::vector<double> contacts; ///< as they were when it was made
    Eigen::VectorXd           stiffness_of_bound;
  };
} // namespace conetact::contact

#endif
