// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/direct_system.h"
#include "conetact/iterative/separate_systems.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace conetact;
  using namespace conetact::iterative;
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  // Two bodies of four nodes, 8 unknowns each; the last node of each is one of
  // contact, whose unknowns stand behind all others.
  constexpr Index  n = 16, n_contact = 4;
  std::vector<int> first_body  = {0, 1, 2, 3, 4, 5, 12, 13},
                   second_body = {6, 7, 8, 9, 10, 11, 14, 15};

  MatrixXd
  body_matrix(const unsigned int seed)
  {
    std::mt19937                     generator(seed);
    std::uniform_real_distribution<> number(-1, 1);
    const MatrixXd a = MatrixXd::NullaryExpr(8, 8, [&](auto, auto) {
      return number(generator);
    });
    return a * a.transpose() + MatrixXd::Identity(8, 8);
  }

  Elements
  elements()
  {
    Elements all;
    all.for_each = [](const auto &visit) {
      for (const auto &[body, seed] :
           {std::pair(first_body, 1u), std::pair(second_body, 2u)})
        {
          const MatrixXd matrix = body_matrix(seed);
          visit(std::vector<Index>(body.begin(), body.end()), matrix.data());
        }
    };
    all.for_each_connection = [](const auto &visit) {
      for (const auto &body : {first_body, second_body})
        visit(std::vector<Index>(body.begin(), body.end()));
    };
    return all;
  }

  MatrixXd
  whole_matrix()
  {
    MatrixXd K                  = MatrixXd::Zero(n, n);
    K(first_body, first_body)   = body_matrix(1);
    K(second_body, second_body) = body_matrix(2);
    return K;
  }

  solvers::ContactSystem
  contact()
  {
    solvers::ContactSystem layout;
    layout.first = {0, 2, 4};
    layout.mu    = VectorXd::Constant(2, .3);
    return layout;
  }

  LargeStiffness
  stiffness()
  {
    LargeStiffness given;
    given.elements = elements();
    for (Index q = 0; q < n - n_contact; ++q)
      given.node_of.push_back(static_cast<unsigned int>(q / 2));
    for (const unsigned int node : {6u, 6u, 7u, 7u})
      given.node_of.push_back(node);
    given.modes.assign(3, [] { return VectorXd(VectorXd::Random(n)); });
    given.contact  = contact();
    given.position = [](const unsigned int node) {
      return std::array<double, 3>{{double(node), 0, 0}};
    };
    return given;
  }

  /** The first node slips, the second one is closed and stuck. */
  std::vector<solvers::NodeLaw>
  laws()
  {
    std::vector<solvers::NodeLaw> result(2);
    for (solvers::NodeLaw &law : result)
      {
        law.p = MatrixXd::Identity(2, 2);
        law.d = MatrixXd::Zero(2, 2);
        law.h = VectorXd::Constant(2, .5);
      }
    result[0].p(0, 0) = .25;
    result[0].d << 1, -.3, 0, 0;
    return result;
  }

  /** Equilibrium and laws, all at once. */
  VectorXd
  expected(const VectorXd &f)
  {
    const MatrixXd K = whole_matrix();
    MatrixXd       J = K;
    VectorXd       b = -f;
    for (Index i = 0; i < 2; ++i)
      {
        const Index            begin = n - n_contact + 2 * i;
        const solvers::NodeLaw law   = laws()[static_cast<std::size_t>(i)];
        J.middleRows(begin, 2)       = law.d * K.middleRows(begin, 2);
        J.block(begin, begin, 2, 2) += law.p;
        b.segment(begin, 2) = law.h;
      }
    return J.fullPivLu().solve(b);
  }

  /** What systems do with the vectors they keep, against Eigen's. */
  void
  expect_vectors(const solvers::LargeSystem &system)
  {
    const VectorXd x = VectorXd::LinSpaced(n, -1, 2), y = x.cwiseAbs2();
    const auto     kept_x = system.keep(x), kept_y = system.keep(y);
    EXPECT_EQ(system.numbers(kept_x), x);
    EXPECT_EQ(system.of_contact(kept_x), x.tail(n_contact));
    EXPECT_EQ(system.numbers(system.add(kept_x, .5, kept_y)), x + .5 * y);
    EXPECT_NEAR(system.product_elsewhere(kept_x, kept_y),
                x.head(n - n_contact).dot(y.head(n - n_contact)),
                1e-14);
    const VectorXd Kx = whole_matrix() * x;
    EXPECT_LT((system.numbers(system.multiply(kept_x)) - Kx).norm(), 1e-13);
    EXPECT_LT((system.diagonal() - whole_matrix().diagonal()).norm(), 1e-14);
    EXPECT_EQ(system.numbers(kept_y), y);
  }
} // namespace



TEST(DirectSystem, FulfilsEquilibriumAndLaws)
{
  const DirectSystem system(elements(), contact(), n);
  const VectorXd     f    = VectorXd::LinSpaced(n, -1, 2);
  const auto         step = system.solve(laws(), system.keep(f), {1e-3});
  ASSERT_TRUE(step);
  EXPECT_LT((system.numbers(step->du) - expected(f)).norm(),
            1e-13 * expected(f).norm());
  EXPECT_LT(step->error, 1e-14);
  expect_vectors(system);
}



TEST(DirectSystem, HasNoStepWhereNothingResists)
{
  const auto         nothing = [](const auto &) {};
  const DirectSystem none({nothing, nothing, {}}, contact(), n);
  EXPECT_FALSE(none.solve(laws(), none.keep(VectorXd::Ones(n)), {1e-3}));
}



/* One body is factorised, the other one iterated. */
TEST(SeparateSystems, SolveEachBodyByItself)
{
  const VectorXd f = VectorXd::LinSpaced(n, -1, 2);
  for (const std::set<unsigned int> &direct : {std::set<unsigned int>{},
                                               {0, 1, 2, 6},
                                               {3, 4, 5, 7},
                                               {0, 1, 2, 3, 4, 5, 6, 7}})
    {
      const auto system = make_separate_systems(stiffness(), direct, 2);
      EXPECT_EQ(system->n_unknowns(), n);
      expect_vectors(*system);
      const auto step = system->solve(laws(), system->keep(f), {1e-12});
      ASSERT_TRUE(step);
      EXPECT_LT((system->numbers(step->du) - expected(f)).norm(),
                1e-11 * expected(f).norm());
    }
}
