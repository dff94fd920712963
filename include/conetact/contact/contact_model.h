// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_contact_model_h
#define conetact_contact_contact_model_h

#include "conetact/contact/body_frames.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/elasticity_row.h"
#include "conetact/contact/node_rules.h"
#include "conetact/contact/rigid_motions.h"
#include "conetact/iterative/preconditioner.h"

#include <memory>
#include <string>

namespace conetact::contact
{
  /**
   * A scene's bodies made ready for contact solvers: rules of nodes, contact
   * points, rigid motions and, when first asked for, the Elasticity.
   */
  class ContactModel
  {
  private:
    model::Bodies own_bodies; ///< with their frames, and cuts that are locked

  public:
    /** `times` are those of the increments. Throws InputError. */
    ContactModel(
      const model::Bodies        &bodies,
      const std::vector<double>  &times,
      const condensed::Condenser &condenser = condensed::default_condenser(),
      const iterative::Preconditioner preconditioner =
        iterative::Preconditioner::aggregation);

    const model::Bodies &bodies;
    NodeRules            rules;       ///< what supports and hanging nodes leave
    ContactPoints        points;      ///< contacts as rows over the nodes
    const Coordinates    coordinates; ///< of the bodies without contacts
    const ElasticSystem  elastic;
    RigidMotions         motions;
    BodyFrames           frames;
    /** The preconditioner of large systems. */
    const iterative::Preconditioner preconditioner;

    /** A bound node of which supports or other bound contacts hold what its
     * own contact does; null: there is none. */
    const pairing::ContactNode *
    held_twice() const;

    /**
     * The form of the contact problem where bodies are condensed. Stiffness:
     * all bodies are held, meet obstacles only, do not slide along what
     * supports hold and differ from each other. Else compliance, with free
     * motions as unknowns.
     */
    solvers::Form
    condensed_form() const
    {
      return form;
    }

    /** Another way to solve it from here on. Throws InputError where the scene
     * has what that cannot do. */
    void
    solve_by(const ElasticityRow &row);
    /** What the way at hand cannot do; empty: nothing. */
    std::string
    why_not() const
    {
      return row->why_not(*this);
    }
    /** May bodies have motions without strain that are not rigid? */
    bool
    may_be_mechanism() const;

    /** The elastic answer of the bodies; factorises the first time. */
    Elasticity &
    elasticity();

    /**
     * How far its stiffness is that of another condenser. Throws AnalysisError
     * where one of both takes it for singular.
     */
    std::vector<StiffnessDifference>
    compare_stiffness(const condensed::Condenser &other);

    /** What the factorisation of a condensation takes. */
    condensed::FactorEstimate
    estimate_factor() const;

    /**
     * Everything that acts at time t: nodal forces on all dofs, and those of
     * changes of temperature (or none), which balance by themselves.
     */
    LoadCase
    load_case(const Eigen::VectorXd &mechanical,
              const Eigen::VectorXd &thermal,
              const double           t);
    /**
     * Displacements of the contact unknowns, from those of all dofs at time t.
     */
    Eigen::VectorXd
    relative_displacements(const Eigen::VectorXd &u, const double t) const;
    /** The displacement of a node, in space. */
    Tensor<1, 3>
    displacement(const Eigen::VectorXd &u,
                 const unsigned int     body,
                 const unsigned int     node) const;

    /** Amounts of all rigid motions, from the free ones. */
    Eigen::VectorXd
    amounts(const Eigen::VectorXd &placement, const Eigen::VectorXd &a) const;

    /**
     * Takes contact nodes that were found again (finite sliding): other rows
     * over the same bodies, nothing is factorised. What is not condensed is
     * made anew if nodes face others or turn, unless why_not() has a reason
     * now. Returns why they cannot be taken, a sentence.
     */
    std::string
    relink(std::vector<pairing::ContactNode> nodes, ElasticState &state);

    /**
     * From the next relink() on forces resist turns of bodies that have frames
     * (geometric_stiffness(); empty: they do not), from amounts `about` on,
     * which should be those that leave frames where they are: then the
     * resistance is nothing but a way to get there. For condensed bodies.
     */
    void
    stiffen(Eigen::MatrixXd geometric, Eigen::VectorXd about);
    /** What it adds to the balance of free motions that have moved by amounts
     * a [force]; empty: forces resist no turns. */
    Eigen::VectorXd
    geometric_forces(const Eigen::VectorXd &a) const;

    /**
     * Locks cuts that are due in increments that begin at t, as open as they
     * are in displacements u of all dofs (none: undeformed). Whether there were
     * any: free motions are other ones then. What is not condensed is made
     * anew, and starts where it was.
     */
    bool
    lock_cuts(const double t, const Eigen::VectorXd &u, ElasticState &state);
    /** How open cuts are in displacements u of all dofs [length]. */
    double
    opening(const model::Cut &cut, const Eigen::VectorXd &u) const;
    /** Forces on all dofs by which locks of cuts keep reactions in balance. */
    Eigen::VectorXd
    lock_forces(const Eigen::VectorXd &all_reactions) const;

    /** Work with all elastic factors so far. */
    condensed::SchurWork
    work() const;

  private:
    bool
    needs_compliance() const;
    /** Tells whether small frames have no motion but rigid ones; false for
     * large ones, as that takes a factorisation. */
    bool
    moves_as_rigid_only() const;
    bool
    has_equal_bodies() const;
    std::string
    singular_sentence(const condensed::SingularMatrix &error) const;
    Eigen::VectorXd
    all_offsets(const LoadCase &load, const double t) const;
    /** The deformation in displacements u of all dofs at time t. */
    Eigen::VectorXd
    deformation(const Eigen::VectorXd &u, const double t) const;

    const std::vector<double>   times;
    const condensed::Condenser &condenser;
    const solvers::Form         form;
    const ElasticityRow        *row = &elasticity_table().front();
    bool            is_stiffened    = false; ///< motions do not know it yet
    Eigen::VectorXd stiffened_about;         ///< amounts of all modes
    std::unique_ptr<Elasticity> made;
    condensed::SchurWork        former_work; ///< before it was made anew
  };

  /** Displacement of a node relative to what it may touch, where u displaces
   * all dofs at time t. */
  inline Tensor<1, 3>
  relative_displacement(const ContactModel         &model,
                        const pairing::ContactNode &node,
                        const Eigen::VectorXd      &u,
                        const double                t)
  {
    return relative_displacement(
      node,
      [&](const unsigned int body, const unsigned int i) {
        return model.displacement(u, body, i);
      },
      t);
  }
} // namespace conetact::contact

#endif
