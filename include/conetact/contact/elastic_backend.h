// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_elastic_backend_h
#define conetact_contact_elastic_backend_h

#include "conetact/backends/condenser.h"
#include "conetact/contact/working_set.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace conetact::contact
{
  /** A load case, seen by the contact unknowns of a working set. */
  struct LoadCase
  {
    Eigen::VectorXd prescribed; ///< deformation that supports give, all dofs
                                ///< [length]
    Eigen::VectorXd b;          ///< its forces on the elastic unknowns [force]
    /**
     * Load of a ContactProblem in total terms: f [force] in stiffness form, q
     * [length] and -b [force] in compliance form.
     */
    Eigen::VectorXd f;
    /** Elastic displacements, where nothing may touch [length]. */
    Eigen::VectorXd q;
    /** What ties and bilateral contacts see of it, as BoundUnknowns has it. */
    Eigen::VectorXd bound;
    /**
     * What moves all candidates' unknowns without strain: placements of bodies
     * by their supports less the motion of obstacles [length].
     */
    Eigen::VectorXd offset;
    Eigen::VectorXd placement; ///< amounts of RigidMotions
  };

  /** Ties and bilateral contacts, which solvers do not see. */
  struct BoundState
  {
    Eigen::VectorXd r;      ///< their reactions [force]
    Eigen::VectorXd motion; ///< rigid motions that they resist, amounts of the
                            ///< bodies' own ones [length]
  };

  /** How far two condensers agree on a stiffness. */
  struct StiffnessDifference
  {
    std::vector<unsigned int> bodies;       ///< whose stiffness it is
    double                    relative = 0; ///< to its largest entry [-]
  };

  /**
   * The elastic answer of all bodies to the nodes of a working set that may
   * touch, whichever way it comes about. Displacements are the deformation w
   * of RigidMotions. What is primal is p of the solver's linear relation:
   * elastic displacements of the contact unknowns in stiffness form, reactions
   * and free motions in compliance form.
   */
  class ElasticBackend
  {
  public:
    explicit ElasticBackend(const WorkingSet &of)
      : set(of)
    {}
    virtual ~ElasticBackend() = default;

    const WorkingSet &
    working_set() const
    {
      return set;
    }
    /** The relation of contact unknowns, cones, motions without resistance. */
    const std::shared_ptr<const solvers::ContactSystem> &
    system() const
    {
      return contact_system;
    }

    /**
     * Nodal `forces` on all dofs and the prescribed deformation. A load case
     * that is a linear combination of earlier ones costs no solve.
     */
    LoadCase
    reduce(const Eigen::VectorXd &forces, const Eigen::VectorXd &prescribed);

    /** Deformation of all dofs, a column for each load case and its primal. */
    virtual Eigen::MatrixXd
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const = 0;

    /**
     * Iterative refinement: the change of a load case that takes away forces
     * on all dofs that are not balanced, and the change of the deformation
     * that does so while the primal unknowns change by `primal`.
     */
    virtual LoadCase
    reduce_unbalanced(const Eigen::VectorXd &unbalanced) const = 0;
    virtual Eigen::VectorXd
    correction(const LoadCase &change, const Eigen::VectorXd &primal) const = 0;

    /** What is bound has moved by `offset` without strain. */
    virtual void
    move_bound(const Eigen::VectorXd & /*offset*/, LoadCase & /*load*/) const
    {}
    /** What is bound under a load case and its primal. */
    virtual BoundState
    bound_state(const LoadCase & /*load*/,
                const Eigen::VectorXd & /*primal*/) const
    {
      return {};
    }
    /** Stiffness along each unknown of what is bound [force/length]. */
    virtual Eigen::VectorXd
    bound_stiffness() const
    {
      return {};
    }

    /**
     * Adds candidates to the set. False if it has to be made anew for that, or
     * if that is cheaper.
     */
    virtual bool
    extend(const std::vector<Eigen::Index> & /*nodes*/)
    {
      return false;
    }

    /** Load cases that were reduced by the solver. */
    unsigned int
    n_reductions() const
    {
      return n_reduced;
    }
    virtual double
    factor_bytes() const
    {
      return 0;
    }
    /** Bodies for which an equal one is condensed. */
    virtual unsigned int
    n_shared_bodies() const
    {
      return 0;
    }
    /** Work with the factors so far. */
    virtual backends::SchurWork
    work() const
    {
      return {};
    }

    /**
     * Condenses all bodies once more by another condenser and compares:
     * largest difference of an entry over the largest entry, body by body.
     */
    virtual std::vector<StiffnessDifference>
    compare(const backends::Condenser & /*other*/) const
    {
      return {};
    }

  protected:
    /** Fills b, f and q of one load case. */
    virtual void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) = 0;
    /** The same without anything that acts. */
    virtual LoadCase
    nothing() const = 0;
    /** Its f once more, after candidates were added. */
    void
    reduce_again();
    /** What was reduced does not hold any more. */
    void
    forget_reductions()
    {
      basis.clear();
    }
    virtual Eigen::VectorXd
    reduce_forces(const Eigen::VectorXd &b) const = 0;

    WorkingSet                                    set;
    std::shared_ptr<const solvers::ContactSystem> contact_system;
    /** Makes prescribed displacements as large as forces. */
    double stiffness_scale = 1;

  private:
    /** An orthonormal basis of load cases, and what they reduce to. */
    struct Known
    {
      Eigen::VectorXd direction; ///< (forces, stiffness_scale x prescribed)
      LoadCase        load;
    };
    std::vector<Known> basis;
    unsigned int       n_reduced = 0;
  };
} // namespace conetact::contact

#endif
