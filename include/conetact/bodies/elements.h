// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_elements_h
#define conetact_bodies_elements_h

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <vector>

namespace conetact::bodies
{
  /**
   * Called for each element with the `n` numbers of its dofs and its symmetric
   * n x n stiffness [force/length]. The same pointer `matrix` may come again
   * for congruent elements.
   */
  using ElementVisitor =
    std::function<void(const std::vector<unsigned int> &dofs,
                       const double                    *matrix)>;

  /** Called for each element with the numbers of its dofs. */
  using ConnectionVisitor =
    std::function<void(const std::vector<unsigned int> &dofs)>;

  /** Whether each node of a body is one of some that are meant. */
  using SomeNodes = std::vector<bool>;

  /** The elements of a body, in an order that is the same each time. Vectors
   * are in all dofs of the body. */
  class Elements
  {
  public:
    explicit Elements(const unsigned int n_components)
      : dofs_of_node(n_components)
    {}
    virtual ~Elements() = default;

    virtual void
    for_each(const ElementVisitor &visit) const = 0;
    /** The same where matrices are not needed: none need be computed. */
    virtual void
    for_each_connection(const ConnectionVisitor &visit) const
    {
      for_each([&](const std::vector<unsigned int> &dofs, const double *) {
        visit(dofs);
      });
    }
    /**
     * f += K u [force], such that a motion without strain costs no digits of
     * the forces.
     */
    virtual void
    add_forces(const Eigen::VectorXd &u, Eigen::VectorXd &f) const = 0;

    /** @name Elements that have a node of some
     * As above, in the same order: what many processes share. By default all
     * elements are looked at.
     * @{ */
    virtual void
    for_each_at(const SomeNodes &nodes, const ElementVisitor &visit) const;
    virtual void
    for_each_connection_at(const SomeNodes         &nodes,
                           const ConnectionVisitor &visit) const;
    /** f += K u at these nodes, and anything at others. Returns how many
     * elements were multiplied. */
    virtual std::size_t
    add_forces_at(const SomeNodes       &nodes,
                  const Eigen::VectorXd &u,
                  Eigen::VectorXd       &f) const;
    /** @} */

    /**
     * How far a node of an element moves relative to the first one of it, at
     * most [length]; infinity: not known.
     */
    virtual double
    largest_stretch(const Eigen::VectorXd & /*u*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /** For the log: congruent elements share a matrix. */
    struct Count
    {
      unsigned int elements = 0, matrices = 0;
    };
    virtual Count
    count() const
    {
      return {};
    }

  protected:
    const unsigned int dofs_of_node;
  };
} // namespace conetact::bodies

#endif
