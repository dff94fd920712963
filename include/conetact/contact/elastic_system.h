// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_elastic_system_h
#define conetact_contact_elastic_system_h

#include "conetact/contact/coordinates.h"

#include <Eigen/SparseCore>

#include <cstdint>
#include <functional>
#include <vector>

namespace conetact::contact
{
  /** Some nodes of each body; null where all of all bodies are meant. */
  using SomeNodesOfBodies = std::vector<bodies::SomeNodes>;

  /** What an elastic support does, on all dofs. */
  struct Foundation
  {
    Eigen::VectorXd forces; ///< on its body [force]
    Eigen::VectorXd ground; ///< displacement of its far end [length]
  };

  /**
   * All bodies and foundations of a scene, but for bodies at rest, as one
   * uncondensed elastic system in the dofs u of all bodies: nothing is
   * eliminated here, so that its internal forces can judge every result of the
   * condensed system.
   */
  class ElasticSystem
  {
  public:
    explicit ElasticSystem(const model::Bodies &bodies);

    const model::Bodies &bodies;

    /** Elements of all bodies and springs, dofs counted over all bodies; those
     * alone that have some of these nodes. */
    void
    for_each_element(const bodies::ElementVisitor &visit,
                     const SomeNodesOfBodies      *nodes = nullptr) const;
    /** The same without their matrices. */
    void
    for_each_connection(const bodies::ConnectionVisitor &visit,
                        const SomeNodesOfBodies         *nodes = nullptr) const;
    /** Elements that were visited or multiplied so far, for the log. */
    std::uint64_t
    n_visited() const
    {
      return visited;
    }

    /** K u, the forces that hold the displacements u [force]. */
    Eigen::VectorXd
    internal_forces(const Eigen::VectorXd &u) const;
    /** Whether there are foundations. */
    bool
    has_springs() const
    {
      return !springs.empty();
    }
    /** Parts of them that go into structures, into foundations. */
    Eigen::VectorXd
    structure_forces(const Eigen::VectorXd &u) const;
    /** The same at these nodes, and anything at others. */
    Eigen::VectorXd
    structure_forces_at(const SomeNodesOfBodies &nodes,
                        const Eigen::VectorXd   &u) const;
    Eigen::VectorXd
    spring_forces(const Eigen::VectorXd &u) const;
    /** Forces of the first foundations of all bodies, of the second ones ... */
    std::vector<Eigen::VectorXd>
    forces_by_foundation(const Eigen::VectorXd &u) const;
    /**
     * Sums of the magnitudes of the terms of K u [force]; their rounding is
     * that of the forces, however small they are themselves. At some nodes,
     * with less than all of them at others.
     */
    Eigen::VectorXd
    terms(const Eigen::VectorXd   &u,
          const SomeNodesOfBodies *nodes = nullptr) const;
    /** The foundations at time t, by support; empty where one is none. */
    std::vector<Foundation>
    foundations(const Eigen::VectorXd &u, const double t) const;
    /** Forces of the foundations' own motion at time t [force]. */
    Eigen::VectorXd
    ground_forces(const double t) const;

  private:
    /** Displacements of the ground of a support, on all dofs [length]. */
    Eigen::VectorXd
    ground(const std::size_t support, const double t) const;

    struct Spring
    {
      std::vector<unsigned int> dofs;
      std::vector<double>       matrix;
      std::size_t               support;
      unsigned int              place; ///< of it, among those of its body
    };
    /** Whether a spring has some of these nodes. */
    bool
    has_some(const Spring &spring, const SomeNodesOfBodies *nodes) const;

    std::vector<Eigen::Index> dof_offset;
    std::vector<Spring>       springs;
    mutable std::uint64_t     visited = 0;
  };

  /**
   * Gets the unknowns of an element, each once, and its part of
   * @f$ C^T K C @f$, row by row [force/length].
   */
  using UnknownsVisitor =
    std::function<void(const std::vector<Eigen::Index> &unknowns,
                       const double                    *matrix)>;

  /** The unknowns of all elements of the system, in those of `coordinates`; of
   * elements alone that have some of these nodes. */
  void
  for_each_connection(
    const ElasticSystem                                          &system,
    const LinearMap                                              &coordinates,
    const std::function<void(const std::vector<Eigen::Index> &)> &visit,
    const SomeNodesOfBodies *nodes = nullptr);
  /** The same with their matrices. */
  void
  for_each_element(const ElasticSystem     &system,
                   const LinearMap         &coordinates,
                   const UnknownsVisitor   &visit,
                   const SomeNodesOfBodies *nodes = nullptr);

  /** The nodes that unknowns move of which `some` are meant. */
  SomeNodesOfBodies
  nodes_of(const model::Bodies     &bodies,
           const LinearMap         &coordinates,
           const std::vector<bool> &some);

  /**
   * Upper triangle of @f$ C^T K C @f$, the stiffness in the unknowns of
   * `coordinates` [force/length].
   */
  Eigen::SparseMatrix<double>
  assemble(const ElasticSystem &system, const LinearMap &coordinates);
} // namespace conetact::contact

#endif
