// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensed_bodies_h
#define conetact_contact_condensed_bodies_h

#include "conetact/condensed/super_element.h"
#include "conetact/contact/body_coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/elasticity.h"

#include <functional>
#include <memory>
#include <vector>

namespace conetact::contact
{
  /**
   * The bodies, each condensed by itself to the unknowns that it keeps: in one
   * factor of all a soft body would have the rounding of a stiff one. Equal
   * bodies may share a SuperElement. Vectors are those of all own unknowns
   * (BodyCoordinates), body after body.
   */
  class CondensedBodies
  {
  public:
    using Index = Eigen::Index;

    /** A body, or several equal ones. */
    struct Part
    {
      std::vector<unsigned int>                bodies;
      std::vector<Index>                       retained; ///< own unknowns
      std::unique_ptr<condensed::SuperElement> element;
    };

    /** Marks the own unknowns that a body keeps. */
    using Retain = std::function<void(unsigned int body, std::vector<bool> &)>;

    /** Nothing is factorised. `groups` of equal bodies keep the same unknowns,
     * all that one of them needs. References must outlive the object. */
    CondensedBodies(const ElasticSystem                          &elastic,
                    const BodyCoordinates                        &own,
                    const condensed::Condenser                   &condenser,
                    const std::vector<std::vector<unsigned int>> &groups,
                    const Retain                                 &retain);

    /** Factorises all parts: their stiffness, to be taken from them. Throws
     * SingularMatrix. */
    void
    condense();
    /** The same with their flexibility but for motions, columns of a body. */
    void
    condense(
      const std::function<const Eigen::MatrixXd &(unsigned int body)> &motions);

    /** What that would take. */
    condensed::FactorEstimate
    estimate() const;

    const std::vector<Part> &
    parts() const
    {
      return all_parts;
    }
    Index
    n_own(const unsigned int body) const
    {
      return own.end(body) - own.begin(body);
    }
    /** A result for each body of columns of own unknowns of all. */
    using Answer =
      std::function<Eigen::MatrixXd(const Part            &part,
                                    const unsigned int     body,
                                    const Eigen::MatrixXd &of_body)>;
    Eigen::MatrixXd
    map(const Eigen::MatrixXd &columns, const Answer &answer) const;

    std::vector<StiffnessDifference>
    compare(const condensed::Condenser &other) const;
    ElasticReport
    report() const;

  private:
    struct Uncondensed
    {
      Eigen::SparseMatrix<double> upper;
      std::vector<unsigned int>   node_of;
    };
    /** Numbers of parts with their matrices, which are assembled for that. */
    void
    for_each_matrix(const std::function<void(std::size_t part,
                                             const Uncondensed &)> &act) const;

    const ElasticSystem        &elastic;
    const BodyCoordinates      &own;
    const condensed::Condenser &condenser;
    std::vector<Part>           all_parts;
  };
} // namespace conetact::contact

#endif
