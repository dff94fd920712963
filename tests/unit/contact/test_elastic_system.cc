// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/elastic_system.h"

#include "body_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::contact;

namespace
{
  const std::string cells_2d = "Generator = subdivided_hyper_rectangle|"
                               "Arguments = 6, 4 : 0, 0 : 3, 2 : true";

  /** Strains of 1e-3 on top of a translation. */
  Eigen::VectorXd
  displacements(const Structure &body, const double translation)
  {
    Eigen::VectorXd u(body.n_dofs());
    for (unsigned int i = 0; i < body.n_nodes(); ++i)
      for (unsigned int c = 0; c < body.n_components(); ++c)
        u[i * body.n_components() + c] =
          translation + 1e-3 * body.position(i)[c] * body.position(i)[0];
    return u;
  }
} // namespace



TEST(ElasticSystem, ForcesKeepTheirDigitsInABodyThatMovesFar)
{
  const auto    body = test::make_body(2, cells_2d);
  model::Bodies bodies;
  bodies.dim        = 2;
  bodies.structures = {body.get()};
  bodies.names      = {"block"};
  const ElasticSystem   system(bodies);
  const Eigen::VectorXd still = system.internal_forces(displacements(*body, 0));
  // a power of two, but the sums with it are rounded
  const Eigen::VectorXd moved =
    system.internal_forces(displacements(*body, 1024));
  const double size = still.cwiseAbs().maxCoeff();
  EXPECT_GT(size, 1e-3);
  // rounding of the displacements, not of their products with K
  EXPECT_LE((moved - still).cwiseAbs().maxCoeff(), 1e-15 * 1024 * 5 * 4);
  for (const unsigned int c : {0U, 1U})
    {
      double sum = 0;
      for (unsigned int i = 0; i < body->n_nodes(); ++i)
        sum += moved[2 * i + c];
      EXPECT_LE(std::abs(sum), 1e-14 * size) << c;
    }
}



TEST(ElasticSystem, TermsOfABodyThatMovesWithoutStrain)
{
  const auto    body = test::make_body(2, cells_2d);
  model::Bodies bodies;
  bodies.dim        = 2;
  bodies.structures = {body.get()};
  bodies.names      = {"block"};
  const ElasticSystem   system(bodies);
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(body->n_dofs(), 2.);
  EXPECT_EQ(system.internal_forces(u).cwiseAbs().maxCoeff(), 0);
  EXPECT_GT(system.terms(u).maxCoeff(), 10);
  EXPECT_DOUBLE_EQ(system.terms(2 * u).maxCoeff(),
                   2 * system.terms(u).maxCoeff());
}



TEST(ElasticSystem, ElementsOfSomeNodesAreAllThatThereIsOfThem)
{
  // one body of its own, one whose rows of cells are parted
  const auto    block = test::make_body(2, cells_2d);
  model::Bodies bodies;
  bodies.dim        = 2;
  bodies.structures = {block.get(), block.get()};
  bodies.names      = {"left", "right"};
  const ElasticSystem system(bodies);
  const unsigned int  n = block->n_nodes();
  Eigen::VectorXd     u(4 * n);
  u << displacements(*block, 0), displacements(*block, 1);
  const Eigen::VectorXd all   = system.structure_forces(u);
  const Eigen::VectorXd terms = system.terms(u);
  const auto            seen  = [&](const auto &look) {
    const std::uint64_t before = system.n_visited();
    look();
    return system.n_visited() - before;
  };

  SomeNodesOfBodies nodes = {SomeNodes(n, false), SomeNodes(n, false)};
  // the first row of nodes, which a row of six cells has
  for (unsigned int i = 0; i < n; ++i)
    nodes[1][i] = block->position(i)[1] == 0;
  Eigen::VectorXd forces, some_terms;
  EXPECT_EQ(seen([&] { forces = system.structure_forces_at(nodes, u); }), 6U);
  EXPECT_EQ(seen([&] { some_terms = system.terms(u, &nodes); }), 6U);
  EXPECT_EQ(
    seen([&] { system.for_each_connection([](const auto &) {}, &nodes); }), 6U);
  EXPECT_EQ(seen([&] { system.terms(u); }), 48U);
  for (unsigned int i = 0; i < n; ++i)
    if (nodes[1][i])
      for (unsigned int c = 0; c < 2; ++c)
        {
          const Eigen::Index dof = 2 * (n + i) + c;
          EXPECT_DOUBLE_EQ(forces[dof], all[dof]);
          EXPECT_DOUBLE_EQ(some_terms[dof], terms[dof]);
        }
}



TEST(ElasticSystem, ElementsAreReducedToTheUnknownsOfAMap)
{
  const auto    body = test::make_body(2, cells_2d);
  model::Bodies bodies;
  bodies.dim        = 2;
  bodies.structures = {body.get()};
  bodies.names      = {"block"};
  const ElasticSystem system(bodies);
  // Every third dof follows two unknowns, one of which comes twice, and every
  // seventh is held; all others are unknowns.
  LinearMap    map;
  Eigen::Index n = 0;
  for (unsigned int dof = 0; dof < body->n_dofs(); ++dof)
    {
      if (dof % 7 == 6)
        ;
      else if (dof % 3 == 2)
        for (const double factor : {.25, .5, -.75})
          map.append(factor > 0 ? n - 1 : 0, factor);
      else
        map.append(n++, 1.);
      map.end_row();
    }
  map.set_n_unknowns(n);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  for_each_element(system,
                   map,
                   [&](const std::vector<Eigen::Index> &unknowns,
                       const double                    *matrix) {
                     for (const Eigen::Index i : unknowns)
                       for (const Eigen::Index j : unknowns)
                         sum(i, j) += *matrix++;
                   });
  // The other way, by deal.II's AffineConstraints.
  const Eigen::MatrixXd expected =
    Eigen::MatrixXd(assemble(system, map)).selfadjointView<Eigen::Upper>();
  EXPECT_LE((sum - expected).cwiseAbs().maxCoeff(),
            1e-14 * expected.cwiseAbs().maxCoeff());
  std::vector<std::vector<Eigen::Index>> met, connected;
  for_each_element(system,
                   map,
                   [&](const std::vector<Eigen::Index> &unknowns,
                       const double *) { met.push_back(unknowns); });
  for_each_connection(system,
                      map,
                      [&](const std::vector<Eigen::Index> &unknowns) {
                        connected.push_back(unknowns);
                      });
  EXPECT_EQ(met, connected);
}
