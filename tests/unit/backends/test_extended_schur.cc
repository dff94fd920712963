// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/extended_schur.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lattice.h"

namespace
{
  using conetact::Lattice;
  using conetact::System;
  using conetact::backends::Condenser;
  using conetact::backends::ExtendedSchur;
  using Eigen::Index;
  using Eigen::MatrixXd;

  struct Reference
  {
    MatrixXd S, reduced, u;
  };

  // The same by dense algebra, the unknowns `kept` as C.
  Reference
  reference(const MatrixXd           &A,
            const std::vector<Index> &kept,
            const MatrixXd           &b,
            const MatrixXd           &u_C)
  {
    std::vector<Index> rest;
    for (Index i = 0; i < A.cols(); ++i)
      if (std::find(kept.begin(), kept.end(), i) == kept.end())
        rest.push_back(i);
    const Eigen::PartialPivLU<MatrixXd> F(MatrixXd(A(rest, rest)));
    const MatrixXd A_FC = A(rest, kept), b_F = b(rest, Eigen::all);
    Reference      result;
    const MatrixXd A_CF = A(kept, rest);
    result.S            = A(kept, kept) - A_CF * MatrixXd(F.solve(A_FC));
    result.reduced      = b(kept, Eigen::all) - A_CF * MatrixXd(F.solve(b_F));
    result.u            = MatrixXd(A.rows(), b.cols());
    result.u(kept, Eigen::all) = u_C;
    result.u(rest, Eigen::all) = MatrixXd(F.solve(MatrixXd(b_F - A_FC * u_C)));
    return result;
  }

  double
  difference(const MatrixXd &a, const MatrixXd &b)
  {
    return (a - b).norm() / b.norm();
  }

  // Three additions, one of them longer than a block of columns.
  void
  check_additions(const Condenser &condenser)
  {
    const System   system = Lattice{{6, 6, 5}}.assemble();
    const MatrixXd A = MatrixXd(system.upper).selfadjointView<Eigen::Upper>();
    const Index    n = A.cols(), n_base = 60;
    ExtendedSchur  schur(system.upper, n_base, system.node_of, condenser);
    MatrixXd       S = schur.base().take_schur_complement();

    std::vector<Index> kept(static_cast<std::size_t>(n_base));
    std::iota(kept.begin(), kept.end(), n - n_base);
    std::vector<Index> many(100);
    std::iota(many.begin(), many.end(), 200);
    for (const std::vector<Index> &more :
         {std::vector<Index>{}, {401, 400, 17}, many, {0}})
      {
        if (!more.empty())
          schur.extend(more, S);
        kept.insert(kept.end(), more.begin(), more.end());
        const MatrixXd  b   = MatrixXd::Random(n, 3);
        const MatrixXd  u_C = MatrixXd::Random(S.cols(), 3);
        const Reference r   = reference(A, kept, b, u_C);
        EXPECT_LT(difference(S, r.S), 1e-13);
        EXPECT_LT(difference(schur.reduce(b), r.reduced), 1e-13);
        EXPECT_LT(difference(schur.expand(b, u_C, schur.reduce(b)), r.u),
                  1e-13);
      }
    EXPECT_EQ(schur.base().work().factorizations, 1u);
  }

  TEST(ExtendedSchur, AdditionsCompose)
  {
    for (const Condenser &condenser : conetact::backends::condenser_table())
      {
        SCOPED_TRACE(condenser.name);
        check_additions(condenser);
      }
  }

  TEST(ExtendedSchur, OneReductionAndOneExpansionForEachUnknown)
  {
    const System  system = Lattice{{5, 5, 4}}.assemble();
    ExtendedSchur schur(system.upper, 30, system.node_of);
    MatrixXd      S = schur.base().take_schur_complement();
    schur.extend({3, 4, 5}, S);
    schur.extend({90, 91}, S);
    EXPECT_EQ(schur.base().work().reductions, 5u);
    EXPECT_EQ(schur.base().work().expansions, 5u);
    EXPECT_EQ(schur.base().work().condensations, 1u);
  }
} // namespace
