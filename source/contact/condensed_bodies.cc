// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensed_bodies.h"

#include "conetact/base/index.h"

#include <deal.II/base/exceptions.h>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using SparseMatrix = Eigen::SparseMatrix<double>;
  } // namespace

  CondensedBodies::CondensedBodies(
    const ElasticSystem                          &e,
    const BodyCoordinates                        &o,
    const condensed::Condenser                   &by,
    const std::vector<std::vector<unsigned int>> &groups,
    const Retain                                 &retain)
    : elastic(e)
    , own(o)
    , condenser(by)
  {
    // Bodies at rest and rigid ones have no own unknowns, and no part.
    const auto n = static_cast<unsigned int>(elastic.bodies.names.size());
    std::vector<bool> placed(n, false);
    for (const auto &group : groups)
      {
        all_parts.push_back({group, {}, nullptr});
        for (const unsigned int body : group)
          placed[body] = true;
      }
    for (unsigned int body = 0; body < n; ++body)
      if (!placed[body] && n_own(body) > 0)
        all_parts.push_back({{body}, {}, nullptr});
    for (Part &part : all_parts)
      {
        // Equal bodies meet others at different nodes: they keep the unknowns
        // that any of them needs.
        std::vector<bool> kept(at(n_own(part.bodies[0])), false);
        for (const unsigned int body : part.bodies)
          {
            AssertDimension(kept.size(), at(n_own(body)));
            retain(body, kept);
          }
        for (std::size_t i = 0; i < kept.size(); ++i)
          if (kept[i])
            part.retained.push_back(static_cast<Index>(i));
      }
  }

  /* All bodies of a part have the matrix of the first. No element joins two
     bodies, so that the matrix of a body is a block on the diagonal of that of
     all. */
  void
  CondensedBodies::for_each_matrix(
    const std::function<void(std::size_t part, const Uncondensed &)> &act) const
  {
    SparseMatrix all = assemble(elastic, own);
    for (std::size_t i = 0; i < all_parts.size(); ++i)
      {
        const unsigned int body  = all_parts[i].bodies[0];
        const Index        begin = own.begin(body), n = n_own(body);
        Uncondensed        matrix;
        if (n == all.cols()) // the usual one body, and a large matrix
          matrix.upper.swap(all);
        else
          matrix.upper = all.block(begin, begin, n, n);
        for (Index p = begin; p < begin + n; ++p)
          matrix.node_of.push_back(own.node_of(p));
        act(i, matrix);
      }
  }

  /* Bodies that their contacts hold: K_FF is positive definite, and the Schur
     complement of the retained unknowns is all that is wanted. */
  void
  CondensedBodies::condense()
  {
    for_each_matrix([&](const std::size_t i, const Uncondensed &body) {
      Part &part   = all_parts[i];
      part.element = std::make_unique<condensed::SuperElement>(body.upper,
                                                               body.node_of,
                                                               part.retained,
                                                               condenser);
    });
  }

  /* Bodies that may float: P_b stands for the inverse, with the rigid motions
     of the body told in closed form. From a factor they would come with the
     rounding of K. */
  void
  CondensedBodies::condense(
    const std::function<const MatrixXd &(unsigned int body)> &motions)
  {
    for_each_matrix([&](const std::size_t i, const Uncondensed &body) {
      Part &part = all_parts[i];
      part.element =
        std::make_unique<condensed::SuperElement>(body.upper,
                                                  body.node_of,
                                                  part.retained,
                                                  motions(part.bodies[0]),
                                                  condenser);
    });
  }

  condensed::FactorEstimate
  CondensedBodies::estimate() const
  {
    condensed::FactorEstimate sum;
    for_each_matrix([&](const std::size_t i, const Uncondensed &body) {
      const Part &part = all_parts[i];
      sum += condensed::SuperElement::estimate(body.upper,
                                               body.node_of,
                                               part.retained,
                                               condenser);
      sum.n_shared += static_cast<unsigned int>(part.bodies.size() - 1);
    });
    return sum;
  }

  /* Equal bodies share an element, not their columns: it is asked once for each
     body. */
  MatrixXd
  CondensedBodies::map(const MatrixXd &columns, const Answer &answer) const
  {
    AssertDimension(columns.rows(), own.n_unknowns());
    MatrixXd result = MatrixXd::Zero(columns.rows(), columns.cols());
    for (const Part &part : all_parts)
      for (const unsigned int body : part.bodies)
        result.middleRows(own.begin(body), n_own(body)) =
          answer(part, body, columns.middleRows(own.begin(body), n_own(body)));
    return result;
  }

  /* The largest difference over the largest entry: both come from other orders
     of elimination, and 1e-15 to 1e-12 is what is left between them. */
  std::vector<StiffnessDifference>
  CondensedBodies::compare(const condensed::Condenser &other) const
  {
    std::vector<StiffnessDifference> result;
    for_each_matrix([&](const std::size_t i, const Uncondensed &body) {
      const Part &part = all_parts[i];
      if (part.retained.empty())
        return;
      const auto stiffness = [&](const condensed::Condenser &by) {
        return condensed::SuperElement(body.upper,
                                       body.node_of,
                                       part.retained,
                                       by)
          .take_stiffness();
      };
      const MatrixXd K = stiffness(condenser);
      result.push_back({part.bodies,
                        (K - stiffness(other)).cwiseAbs().maxCoeff() /
                          K.cwiseAbs().maxCoeff()});
    });
    return result;
  }

  ElasticReport
  CondensedBodies::report() const
  {
    ElasticReport sum;
    sum.description = "condensation by " + std::string(condenser.name) +
                      ": order, factor and Schur complement";
    for (const Part &part : all_parts)
      {
        sum.factor_bytes += part.element->solver().factor_bytes();
        sum.n_shared_bodies +=
          static_cast<unsigned int>(part.bodies.size() - 1);
        sum.work += part.element->solver().work();
      }
    return sum;
  }
} // namespace conetact::contact
