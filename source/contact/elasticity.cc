// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/elasticity.h"

#include "conetact/solvers/column_groups.h"

#include <deal.II/base/exceptions.h>

namespace conetact::contact
{
  namespace
  {
    /** More different loads than this are forgotten and begun anew: each keeps
     * several vectors of all dofs. */
    constexpr std::size_t largest_basis = 8;

    /** A load case of which less than this part is left, some units of
     * rounding, is a combination of others. */
    constexpr double same_load = 4e-15;

    void
    add(const double factor, const Eigen::VectorXd &x, Eigen::VectorXd &sum)
    {
      if (sum.size() == 0)
        sum.setZero(x.size());
      sum += factor * x;
    }

    void
    add(const double factor, const LoadCase &part, LoadCase &sum)
    {
      add(factor, part.b, sum.b);
      add(factor, part.f, sum.f);
      add(factor, part.q, sum.q);
      add(factor, part.bound, sum.bound);
    }
  } // namespace

  LoadCase
  Elasticity::reduce(const Eigen::VectorXd &forces,
                     const Eigen::VectorXd &prescribed)
  {
    AssertDimension(forces.size(), prescribed.size());
    Assert(forces.allFinite() && prescribed.allFinite(),
           dealii::ExcMessage("Loads are finite."));
    const Eigen::Index n = forces.size();
    if (forces.isZero(0) && prescribed.isZero(0))
      return nothing();
    LoadCase load;
    if (!prescribed.isZero(0))
      load.prescribed = prescribed;
    Eigen::VectorXd rest(2 * n);
    // Reduction is linear in forces and prescribed displacements: both as one
    // vector, made of like size, are written as a combination of earlier ones
    // by Gram and Schmidt, and only the rest is reduced.
    rest << forces, stiffness_scale * prescribed;

    const double size = rest.norm();
    if (size == 0) // of numbers whose squares are none
      return nothing();
    const auto project = [&] {
      for (const Known &known : basis)
        {
          const double part = known.direction.dot(rest);
          rest -= part * known.direction;
          add(part, known.load, load);
        }
    };
    project();
    project(); // twice is enough for orthogonality to round-off
    const double norm = rest.norm();
    if (norm <= same_load * size)
      return load;

    // Loads that go on changing their direction never come back to an early
    // one.
    if (basis.size() == largest_basis)
      basis.clear();
    Known known;
    known.direction = rest / norm;
    reduce_one(known.direction.head(n),
               known.direction.tail(n) / stiffness_scale,
               known.load);
    ++n_reduced;
    add(norm, known.load, load);
    basis.push_back(std::move(known));
    return load;
  }

  LoadCase
  Elasticity::reduce(const Eigen::VectorXd &forces,
                     const Eigen::VectorXd &heat,
                     const Eigen::VectorXd &prescribed)
  {
    return heat.size() == 0 ? reduce(forces, prescribed) :
                              reduce(forces + heat, prescribed);
  }

  const BoundContacts &
  Elasticity::bound() const
  {
    static const BoundContacts nothing;
    return nothing;
  }

  /* The least |x| with N^T x = resultants. */
  Eigen::VectorXd
  shortest_load(const Eigen::MatrixXd &null_space,
                const Eigen::VectorXd &resultants)
  {
    AssertDimension(null_space.cols(), resultants.size());
    Eigen::VectorXd load = Eigen::VectorXd::Zero(null_space.rows());
    for (const solvers::ColumnGroup &group : solvers::column_groups(null_space))
      {
        const Eigen::MatrixXd balance =
          null_space(group.blocks, group.columns).transpose();
        const Eigen::VectorXd own = resultants(group.columns);
        if (balance.size() > 0) // else nothing sees the motion
          load(group.blocks) =
            balance.completeOrthogonalDecomposition().solve(own).eval();
      }
    return load;
  }
} // namespace conetact::contact
