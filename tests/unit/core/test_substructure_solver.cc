// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/extended_schur.h"
#include "conetact/contact/interfaces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lattice.h"

namespace
{
  using conetact::ExtendedSchur;
  using conetact::find_interfaces;
  using conetact::Lattice;
  using conetact::SchurSolver;
  using conetact::SingularMatrix;
  using conetact::Substructure;
  using conetact::Substructures;
  using conetact::SubstructureSolver;
  using conetact::System;
  using Eigen::Index;
  using Eigen::Matrix3d;
  using Eigen::MatrixXd;
  using SparseMatrix = Eigen::SparseMatrix<double>;

  constexpr Index plane = 25; // nodes of the last plane of a lattice

  Matrix3d
  random_rotation()
  {
    const Matrix3d random = Matrix3d::Random();
    return random.householderQr().householderQ();
  }

  // Lattices of 5 x 5 nodes a plane, each in unknowns q of its nodes that are
  // turned; those of its last `n_contact` nodes come behind all others.
  class Assembly
  {
  public:
    Substructures all;

    explicit Assembly(const std::vector<System> &systems)
    {
      for (const System &system : systems)
        all.parts.push_back({system.upper, system.node_of, {}});
    }

    void
    use(const std::size_t part, const Index n_contact, const bool turned)
    {
      Body       body{part, n_contact, {}, {}};
      const auto n = all.parts[part].upper.cols() / 3;
      for (Index node = 0; node < n; ++node)
        body.turn.push_back(turned ? random_rotation() :
                                     Matrix3d(Matrix3d::Identity()));
      bodies.push_back(body);
    }

    // The last plane of `upper` moves relative to the first of `lower`.
    void
    stack(const std::size_t upper, const std::size_t lower)
    {
      bodies[upper].masters.push_back(lower);
    }

    // Numbers q and writes maps.
    void
    finish()
    {
      Index n = 0;
      for (Body &body : bodies)
        body.first = number(body, n, 0);
      for (Body &body : bodies)
        body.first_contact = number(body, n, 1);
      all.node_of.resize(n);
      for (Index q = 0; q < n; ++q)
        all.node_of[q] = 1000 + static_cast<unsigned int>(q / 3);
      for (const Body &body : bodies)
        write(body);
    }

    System
    sum() const
    {
      MatrixXd A = MatrixXd::Zero(n_unknowns(), n_unknowns());
      System   whole{{}, all.node_of};
      for (const Substructure &part : all.parts)
        for (const Substructure::Map &T : part.uses)
          {
            const SparseMatrix full =
              part.upper.selfadjointView<Eigen::Upper>();
            A += MatrixXd(SparseMatrix(T.transpose() * full * T));
          }
      whole.upper =
        MatrixXd(A.triangularView<Eigen::Upper>()).sparseView(1., 1e-14);
      return whole;
    }

    double scale = 1; ///< of each node's first unknown

  private:
    struct Body
    {
      std::size_t              part;
      Index                    n_contact;
      std::vector<Matrix3d>    turn;
      std::vector<std::size_t> masters;
      Index                    first = 0, first_contact = 0;

      Index
      n_nodes() const
      {
        return static_cast<Index>(turn.size());
      }
      Index
      unknown(const Index node) const
      {
        const Index n_free = n_nodes() - n_contact;
        return node < n_free ? first + 3 * node :
                               first_contact + 3 * (node - n_free);
      }
    };

    Index
    number(const Body &body, Index &n, const int contact)
    {
      const Index before = n;
      n += 3 * (contact ? body.n_contact : body.n_nodes() - body.n_contact);
      all.n_schur += contact * (n - before);
      return before;
    }

    void
    write(const Body &body)
    {
      std::vector<Eigen::Triplet<double>> entries;
      const auto add = [&](const Index node, const Index q, const Matrix3d &T) {
        for (Index i = 0; i < 3; ++i)
          for (Index j = 0; j < 3; ++j)
            if (T(i, j) != 0)
              entries.emplace_back(3 * node + i, q + j, T(i, j));
      };
      for (Index node = 0; node < body.n_nodes(); ++node)
        {
          Matrix3d turn = body.turn[node];
          turn.col(0) *= scale;
          add(node, body.unknown(node), turn);
        }
      for (const std::size_t lower : body.masters)
        for (Index k = 0; k < plane; ++k)
          for (const Index neighbor : {k, (k + 1) % plane})
            add(body.n_nodes() - plane + k,
                bodies[lower].unknown(neighbor),
                .5 * bodies[lower].turn[neighbor]);
      Substructure::Map map(3 * body.n_nodes(), n_unknowns());
      map.setFromTriplets(entries.begin(), entries.end());
      all.parts[body.part].uses.push_back(map);
    }

    Index
    n_unknowns() const
    {
      return static_cast<Index>(all.node_of.size());
    }

    std::vector<Body> bodies;
  };

  double
  difference(const MatrixXd &a, const MatrixXd &b)
  {
    return b.size() == 0 ? 0. : (a - b).norm() / b.norm();
  }

  // Against one factor of all.
  void
  check(const Assembly    &assembly,
        const unsigned int n_factors,
        const unsigned int n_shared,
        const Index        n_between)
  {
    const auto &[upper, node_of] = assembly.sum();
    const Index        n = upper.cols(), n_schur = assembly.all.n_schur;
    SubstructureSolver parts(assembly.all);
    SchurSolver        whole(upper, n_schur, node_of);
    EXPECT_EQ(parts.n_unknowns(), n);
    EXPECT_EQ(parts.work().factorizations, n_factors);
    EXPECT_EQ(parts.n_shared(), n_shared);
    EXPECT_EQ(find_interfaces(assembly.all).n_E, n_between);
    const MatrixXd S = parts.take_schur_complement();
    EXPECT_LT(difference(S, whole.take_schur_complement()), 1e-13);
    EXPECT_EQ(S, S.transpose());

    MatrixXd b = MatrixXd::Random(n, 70), u_C = MatrixXd::Random(n_schur, 70);
    b.col(1).setZero();
    b.col(2).head(n / 3).setZero();
    u_C.leftCols(2).setZero();
    EXPECT_LT(difference(parts.reduce(b), whole.reduce(b)), 1e-13);
    EXPECT_LT(difference(parts.expand(b, u_C), whole.expand(b, u_C)), 1e-12);
    EXPECT_EQ(parts.expand(b, u_C).col(1).norm(), 0.);

    const auto estimate = SubstructureSolver::estimate(assembly.all);
    EXPECT_GE(estimate.factor_bytes, .9 * parts.factor_bytes());
    EXPECT_LE(estimate.factor_bytes, 1.5 * parts.factor_bytes() + 1000);
    EXPECT_EQ(estimate.n_shared, n_shared);
  }

  const System one = Lattice{{5, 5, 4}}.assemble();

  System
  other()
  {
    Lattice lattice{{5, 5, 4}};
    lattice.contrast = 2.;
    return lattice.assemble();
  }

  // Bodies of the first system, each on the one before.
  Assembly
  tower(const std::vector<System>      &systems,
        const std::vector<std::size_t> &of_body)
  {
    Assembly assembly(systems);
    for (const std::size_t part : of_body)
      assembly.use(part, plane, true);
    for (std::size_t k = 1; k < of_body.size(); ++k)
      assembly.stack(k, k - 1);
    assembly.finish();
    return assembly;
  }
} // namespace



TEST(SubstructureSolver, FactorisesEqualBodiesOnce)
{
  for (const bool turned : {false, true})
    for (const Index n_contact : {0, 1, 25})
      {
        Assembly two({one}), three({one});
        for (unsigned int k = 0; k < 3; ++k)
          {
            three.use(0, n_contact, turned && k > 0);
            if (k < 2)
              two.use(0, n_contact, turned);
          }
        two.finish();
        three.finish();
        check(two, 1, 1, 0);
        check(three, 1, 2, 0);
      }
}



TEST(SubstructureSolver, FactorisesOthersBesides)
{
  Assembly assembly({one, other(), Lattice{{5, 5, 3}}.assemble()});
  for (const std::size_t part : {1, 0, 2, 0, 1})
    assembly.use(part, 10, true);
  assembly.finish();
  check(assembly, 3, 2, 0);
}



TEST(SubstructureSolver, CondensesToAllContactNodesOfAnyUse)
{
  // 3 and 7 nodes that are contact nodes elsewhere only
  Assembly assembly({one});
  for (const Index n_contact : {25, 22, 18})
    assembly.use(0, n_contact, true);
  assembly.finish();
  check(assembly, 1, 2, 3 * (3 + 7));
}



TEST(SubstructureSolver, TakesUnknownsOfAnyScale)
{
  Assembly assembly({one});
  assembly.scale = 2.5;
  for (unsigned int k = 0; k < 3; ++k)
    assembly.use(0, 10 + k, true);
  assembly.finish();
  check(assembly, 1, 2, 3 * (2 + 1));
}



TEST(SubstructureSolver, EliminatesWhereBodiesMeet)
{
  // the topmost plane is interface because it is below
  check(tower({one}, {0, 0}), 1, 1, 3 * plane * 2);
  check(tower({one}, {0, 0, 0}), 1, 2, 3 * plane * 3);
  check(tower({one, other()}, {0, 1, 0, 1}), 2, 2, 3 * plane * 4);
}



TEST(SubstructureSolver, IsExtended)
{
  for (const bool stacked : {false, true})
    {
      Assembly assembly({one});
      assembly.use(0, 10, true);
      assembly.use(0, 8, true);
      if (stacked)
        assembly.stack(1, 0);
      assembly.finish();
      const auto &[upper, node_of] = assembly.sum();

      ExtendedSchur parts(assembly.all);
      ExtendedSchur whole(
        Substructures{{{upper, node_of, {}}}, node_of, assembly.all.n_schur});
      MatrixXd S_parts = parts.base().take_schur_complement();
      MatrixXd S_whole = whole.base().take_schur_complement();
      for (const std::vector<Index> &more :
           {std::vector<Index>{17, 400, 269}, {540, 541, 0}})
        {
          parts.extend(more, S_parts);
          whole.extend(more, S_whole);
        }
      EXPECT_LT(difference(S_parts, S_whole), 1e-13);
      const MatrixXd b = MatrixXd::Random(upper.cols(), 3);
      const MatrixXd u = MatrixXd::Random(S_parts.cols(), 3);
      EXPECT_LT(difference(parts.reduce(b), whole.reduce(b)), 1e-13);
      EXPECT_LT(difference(parts.expand(b, u, parts.reduce(b)),
                           whole.expand(b, u, whole.reduce(b))),
                1e-12);
      EXPECT_EQ(parts.base().work().factorizations, 1u);
    }
}



TEST(SubstructureSolver, ReducesOnlyWhatIsLoaded)
{
  Assembly assembly({one});
  for (unsigned int k = 0; k < 3; ++k)
    assembly.use(0, 10, true);
  assembly.finish();
  const SubstructureSolver parts(assembly.all);
  MatrixXd                 b = MatrixXd::Zero(900, 2);
  b(5, 0) = b(6, 1) = b(600, 1) = 1;
  parts.reduce(b);
  EXPECT_EQ(parts.work().reductions, 3u);
}



TEST(SubstructureSolver, NamesTheNodeThatMoves)
{
  Lattice lattice{{5, 5, 4}};
  lattice.support       = 0.;
  const System floating = lattice.assemble();
  Assembly     assembly({one, floating});
  for (const std::size_t part : {0, 0, 1, 1})
    assembly.use(part, 0, true);
  assembly.finish();
  EXPECT_THROW(SubstructureSolver(assembly.all), SingularMatrix);
  assembly.all.parts[1].upper.coeffRef(6, 6) = 0.;
  assembly.all.parts[1].node_of[6]           = 2000;
  try
    {
      SubstructureSolver solver(assembly.all);
      FAIL();
    }
  catch (const SingularMatrix &error)
    {
      EXPECT_EQ(error.node.value_or(0), 2000u);
    }
}



TEST(SubstructureSolver, RefusesBodiesThatMoveTogether)
{
  for (const double support : {0., 1e-7})
    {
      Lattice lattice{{5, 5, 4}};
      lattice.support = support;
      Assembly assembly({lattice.assemble(), other()});
      assembly.use(1, 0, true);
      assembly.use(0, 0, true);
      assembly.use(0, plane, true);
      assembly.stack(2, 1);
      assembly.finish();
      if (support > 0)
        {
          EXPECT_NO_THROW(SubstructureSolver(assembly.all));
          continue;
        }
      try
        {
          SubstructureSolver solver(assembly.all);
          FAIL();
        }
      catch (const SingularMatrix &error)
        {
          EXPECT_GE(error.node.value_or(1000), 1000u);
        }
    }
}
