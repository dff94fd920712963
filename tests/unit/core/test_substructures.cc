// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/substructures.h"

#include "body_fixture.h"

using namespace conetact;

namespace
{
  using Eigen::MatrixXd;

  /** Three cubes, the second turned on the first, the third beside them. */
  struct Scene
  {
    std::vector<std::unique_ptr<Structure>> structures;
    Bodies                                  bodies;

    explicit Scene(const std::string &third = "Young modulus = 5|"
                                              "Poisson ratio = 0.3")
    {
      const std::string cube = "Generator = subdivided_hyper_rectangle|"
                               "Arguments = 3, 3, 2 : -1, -1, 0 : 1, 1, 1 : "
                               "true|Refinement distance = 4 : 0.1 : 1|";
      structures.push_back(test::make_body(3, cube + "Scale = 2"));
      structures.push_back(test::make_body(3,
                                           cube +
                                             "Scale = 2|Rotation = 0, 0, 1, 33|"
                                             "Translation = 0, 0, 2"));
      structures.push_back(
        test::make_body(3,
                        cube + "Scale = 2|Rotation = 1, -2, 3, 71|"
                               "Translation = 9, 0, 0",
                        third));
      bodies.dim   = 3;
      bodies.names = {"lower", "upper", "turned"};
      for (const auto &structure : structures)
        bodies.structures.push_back(structure.get());
      hold(0, Tensor<1, 3>({1, 0, 0}));
      hold(1, edge(1));
      hold(2, edge(2));
    }

    /** Rollers on the first side of a body. */
    void
    hold(const unsigned int body, const Tensor<1, 3> &direction)
    {
      Support support;
      support.name       = "side";
      support.body       = body;
      support.ids        = {0};
      support.surface    = structures[body]->surface({0});
      support.directions = {direction};
      support.displacement.emplace_back("0", "test");
      bodies.supports.push_back(std::move(support));
    }

    /** Where the cube's own x axis is now: along its first cell. */
    Tensor<1, 3>
    edge(const unsigned int body) const
    {
      unsigned int along = 1;
      const auto   at    = [this](const unsigned int b, const unsigned int i) {
        return structures[b]->position(i) - structures[b]->position(0);
      };
      while (std::hypot(at(0, along)[1], at(0, along)[2]) > 1e-9)
        ++along;
      const Tensor<1, 3> e = at(body, along);
      return e / e.norm();
    }

    /** Nodes of the second cube's lower side touch the first one. */
    void
    touch(const double mu)
    {
      std::vector<Contact> contacts(1);
      contacts[0].name       = "joint";
      contacts[0].body       = 1;
      contacts[0].ids        = {4};
      contacts[0].master     = 0;
      contacts[0].master_ids = {5};
      contacts[0].reach      = 1;
      contacts[0].friction.emplace(std::to_string(mu), "test");
      contacts[0].prestress.emplace("0", "test");
      contacts[0].cohesion.emplace("0", "test");
      bodies.contact_nodes =
        find_contact_nodes(contacts, bodies.names, bodies.structures, 3).nodes;
    }
  };

  MatrixXd
  full(const Eigen::SparseMatrix<double> &upper)
  {
    return MatrixXd(upper).selfadjointView<Eigen::Upper>();
  }

  /** Whether the parts add up, with all contact unknowns condensed. */
  std::size_t
  n_parts(const Scene &scene)
  {
    const NodeRules     rules(scene.bodies, {1.});
    const Coordinates   coordinates(scene.bodies, rules);
    const ElasticSystem elastic(scene.bodies);
    const auto          divided = make_substructures(elastic,
                                            coordinates,
                                            {},
                                            coordinates.n_contact_unknowns());
    const MatrixXd      whole   = full(assemble(elastic, coordinates));
    MatrixXd            sum     = MatrixXd::Zero(whole.rows(), whole.cols());
    for (const Substructure &part : divided.parts)
      for (const Substructure::Map &T : part.uses)
        sum += T.transpose() * MatrixXd(full(part.upper) * T);
    if (divided.parts[0].uses.empty())
      sum = full(divided.parts[0].upper);
    EXPECT_LT((sum - whole).norm(), 1e-14 * whole.norm());
    return divided.parts.size();
  }
} // namespace



TEST(Substructures, AddUpToTheWhole)
{
  Scene equal;
  EXPECT_EQ(n_parts(equal), 1u);
  equal.touch(0);
  EXPECT_EQ(n_parts(equal), 1u);
  Scene two("Young modulus = 5|Poisson ratio = 0.31");
  EXPECT_EQ(n_parts(two), 2u);
  two.touch(0);
  EXPECT_EQ(n_parts(two), 2u);
}



TEST(Substructures, LeavesSupportsAskewToContactsAlone)
{
  // by less than rules refuse: the unknowns of a body do not tell
  Scene scene;
  scene.touch(.3);
  scene.bodies.supports[1].directions[0] += Tensor<1, 3>({0, 0, 1e-6});
  EXPECT_EQ(n_parts(scene), 2u);
}



TEST(Substructures, TellsBodiesApartOnAStiffFoundation)
{
  // so stiff that forces of the bodies are round-off beside its own
  Scene two("Young modulus = 5|Poisson ratio = 0.31");
  for (Support &support : two.bodies.supports)
    support.stiffness.emplace("1e16", "test");
  EXPECT_EQ(n_parts(two), 2u);
}



TEST(Substructures, TellsSoftFoundationsApartBesideStiffOnes)
{
  for (const char *third : {"1", "2"})
    {
      Scene      scene;
      const auto n_supports = scene.bodies.supports.size();
      for (std::size_t s = 0; s < n_supports; ++s)
        {
          const unsigned int body = scene.bodies.supports[s].body;
          scene.hold(body, scene.bodies.supports[s].directions[0]);
          scene.bodies.supports[s].stiffness.emplace("1e16", "test");
          scene.bodies.supports.back().stiffness.emplace(body == 2 ? third :
                                                                     "1",
                                                         "test");
        }
      EXPECT_EQ(n_parts(scene), *third == '1' ? 1u : 2u);
    }
}
