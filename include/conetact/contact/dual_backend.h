// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_dual_backend_h
#define conetact_contact_dual_backend_h

#include "conetact/backends/super_element.h"
#include "conetact/contact/body_coordinates.h"
#include "conetact/contact/bound_unknowns.h"
#include "conetact/contact/elastic_backend.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/rigid_motions.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace conetact::contact
{
  /**
   * Bodies that condense themselves, and contacts as rows H over them:
   * @f[ v = W r + G a + q,\quad W = \sum_b H_b P_b H_b^T,\quad G = H R, @f]
   * with the balance of each free motion as an equation of its own (compliance
   * form of ContactProblem). Flexibilities of stiff and soft bodies just add:
   * no digits are lost where stiffnesses differ, nor where bodies float or move
   * far. Equal bodies share a SuperElement. Foundations K_s are part of a
   * body's stiffness; against its free motions they act as
   * @f[ Y = -P K_s R,\quad G = H (R + Y),\quad
   *     C = R^T K_s R + R^T K_s Y . @f]
   * Ties and bilateral contacts are rows as well, behind those of the working
   * set, and eliminated before anyone asks for the system (BoundUnknowns).
   * The form of FETI methods with friction (Dostal, Kozubek, Horyl, Brzobohaty,
   * Markopoulos, Comput. Struct. 2012).
   */
  class DualBackend : public ElasticBackend
  {
  public:
    /**
     * `coordinates` are those of the bodies without contacts. Throws
     * SingularMatrix. All but `set` must outlive the object.
     */
    DualBackend(const ElasticSystem       &elastic,
                const ContactPoints       &points,
                const Coordinates         &coordinates,
                const RigidMotions        &motions,
                const WorkingSet          &set,
                const backends::Condenser &condenser);

    Eigen::MatrixXd
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const override;
    LoadCase
    reduce_unbalanced(const Eigen::VectorXd &unbalanced) const override;
    Eigen::VectorXd
    correction(const LoadCase        &change,
               const Eigen::VectorXd &primal) const override;
    /**
     * A load whose parts cancel against a free motion leaves their rounding,
     * which must not drive a body that nothing holds.
     */
    void
    forget_rounding(LoadCase &load) const;
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
    /** Of what is bound. */
    const RedundantRows &
    redundant_rows() const
    {
      return bound.redundant_rows();
    }
    double
    factor_bytes() const override;
    unsigned int
    n_shared_bodies() const override;
    backends::SchurWork
    work() const override;
    std::vector<StiffnessDifference>
    compare(const backends::Condenser &other) const override;

    /**
     * Contacts were found again: other rows over the same bodies. Nothing is
     * factorised.
     */
    void
    relink();

    /** A cut was locked: fewer motions are free, nothing is factorised. */
    void
    see_motions();

    /** What the factorisations would take; nothing is factorised. */
    static backends::FactorEstimate
    estimate(const ElasticSystem       &elastic,
             const ContactPoints       &points,
             const Coordinates         &coordinates,
             const RigidMotions        &motions,
             const WorkingSet          &set,
             const backends::Condenser &condenser);

  protected:
    void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) override;
    LoadCase
    nothing() const override;
    Eigen::VectorXd
    reduce_forces(const Eigen::VectorXd &b) const override;

  private:
    using Index    = Eigen::Index;
    using VectorXd = Eigen::VectorXd;
    using MatrixXd = Eigen::MatrixXd;

    /** A body, or several equal ones. */
    struct Part
    {
      std::vector<unsigned int> bodies;
      std::vector<Index>        retained; ///< of each body's own unknowns
      std::unique_ptr<backends::SuperElement> element;
    };
    /** The stiffness of one of them in its own unknowns. */
    struct Uncondensed
    {
      Eigen::SparseMatrix<double> upper;
      std::vector<unsigned int>   node_of;
    };
    /** Free motions of a body in its own unknowns. */
    struct BodyMotions
    {
      Index    first = 0; ///< among all free motions
      MatrixXd R, spring_forces, Y;
    };

    void
    write_rows();
    void
    write_row(const ContactPoint                  &point,
              Index                               &row,
              std::vector<Eigen::Triplet<double>> &entries) const;
    void
    find_parts();
    void
    retain(const unsigned int body, std::vector<bool> &kept) const;
    void
    retain_anchors(const unsigned int body, std::vector<bool> &kept) const;
    void
    find_motions();
    /** `all`: that of all own unknowns. */
    Uncondensed
    stiffness_of(const Part                        &part,
                 const Eigen::SparseMatrix<double> &all) const;
    void
    condense();
    void
    respond_to_springs();
    MatrixXd
    assemble_all() const;
    void
    assemble_system();
    /** Of all rows and motions, as the system and what is bound see them. */
    void
    set_load(const VectorXd &all, LoadCase &load) const;
    VectorXd
    reduce_all(const VectorXd &b, const VectorXd &forces) const;
    VectorXd
    moved_rows(const VectorXd &u) const;
    /** Reactions of all rows and all own motions. */
    VectorXd
    all_of(const LoadCase &load, const VectorXd &primal) const;
    Index
    n_contact() const
    {
      return set.layout().n_unknowns();
    }
    MatrixXd
    flexibility() const;
    /** Deformations of all own unknowns under forces on them (columns). */
    MatrixXd
    deform(const MatrixXd &forces) const;
    /** -(forces against the free motions, foundations included). */
    VectorXd
    imbalance(const VectorXd &forces) const;
    /** The same of rigid bodies, which have no own unknowns: all dofs. */
    VectorXd
    rigid_imbalance(const VectorXd &forces) const;
    /** Of all motions that no foundation resists what contacts do not see. */
    void
    forget_unseen_motions(solvers::ContactSystem &system);
    /** Takes motions that nothing resists out of imbalances. */
    VectorXd
    without_unseen(const VectorXd &imbalance) const;
    /** Forces on own unknowns of reactions and free motions. */
    VectorXd
    forces_of(const VectorXd &primal) const;
    Index
    n_own(const unsigned int body) const
    {
      return own.end(body) - own.begin(body);
    }

    struct Empty
    {};
    /** Without factors, for an estimate. */
    DualBackend(const ElasticSystem       &elastic,
                const ContactPoints       &points,
                const Coordinates         &coordinates,
                const RigidMotions        &motions,
                const WorkingSet          &set,
                const backends::Condenser &condenser,
                const Empty);

    const ElasticSystem        &elastic;
    const ContactPoints        &points;
    const Coordinates          &coordinates;
    const RigidMotions         &motions;
    const backends::Condenser  &condenser;
    BodyCoordinates             own;
    Eigen::SparseMatrix<double> H; ///< of own unknowns
    std::vector<Part>           parts;
    std::vector<BodyMotions>    body_motions;
    BoundUnknowns               bound;
    VectorXd                    stiffness_of_bound;
    Index                       first_rigid = 0; ///< of the own motions
    MatrixXd                    unseen;          ///< motions, orthonormal
  };
} // namespace conetact::contact

#endif
