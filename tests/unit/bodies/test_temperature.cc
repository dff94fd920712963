// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/continuum.h"
#include "conetact/bodies/continuum/graphics.h"
#include "conetact/bodies/placement.h"

#include <deal.II/grid/tria.h>

#include "frame_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::test;

namespace
{
  constexpr double E = 5, nu = .3, alpha = .02, change = 10;

  std::string
  material(const std::string &plane)
  {
    return "Young modulus = 5|Poisson ratio = 0.3|Thickness = 2|"
           "Expansion coefficient = 0.02|Plane = " +
           plane;
  }

  InitialStrainField
  heat()
  {
    return [](const Point<3> &) { return InitialStrain{{}, change}; };
  }

  struct Case
  {
    unsigned int dim;
    std::string  plane;
    double       stretch;  ///< free strain over alpha times temperature
    double       pressure; ///< where nothing moves along dim axes
    std::string  element;
  };

  std::vector<Case>
  cases_of_all_elements()
  {
    const double      p = E * alpha * change;
    std::vector<Case> all;
    for (const auto &row : element_table<2>())
      for (const Case &c :
           std::vector<Case>{{2, "strain", 1 + nu, p / (1 - 2 * nu), row.name},
                             {2, "stress", 1, p / (1 - nu), row.name},
                             {3, "strain", 1, p / (1 - 2 * nu), row.name}})
        if (c.dim == 2 || !row.is_simplex || row.degree == 1)
          all.push_back(c);
    return all;
  }
  const std::vector<Case> cases = cases_of_all_elements();

  std::unique_ptr<Structure>
  distorted(const Case &c)
  {
    return make_body(c.dim,
                     "File = " + write_distorted_mesh(c.dim, 3),
                     material(c.plane),
                     c.element);
  }
} // namespace

TEST(Temperature, FreeExpansionNeedsNoForce)
{
  for (const Case &c : cases)
    {
      const auto            body = distorted(c);
      const Eigen::VectorXd u    = interpolate(*body, [&](const Point<3> &x) {
        return c.stretch * alpha * change * x;
      });
      Eigen::VectorXd       f    = no_forces(*body);
      EXPECT_TRUE(body->expands());
      body->add(Action::initial_strains(heat()), f);
      EXPECT_LE((stiffness(*body) * u - f).cwiseAbs().maxCoeff(),
                1e-13 * f.cwiseAbs().maxCoeff());
    }
}

TEST(Temperature, HeldBodyPressesOnItsBoundary)
{
  // the resultant on the side x = 1 of area 2 (of 1 in 3D)
  for (const Case &c : cases)
    {
      const auto      body = distorted(c);
      Eigen::VectorXd f    = no_forces(*body);
      body->add(Action::initial_strains(heat()), f);
      double sum = 0;
      for (unsigned int n = 0; n < body->n_nodes(); ++n)
        if (std::abs(body->position(n)[0] - 1) < 1e-9)
          sum += f[body->n_components() * n];
      const double area = c.dim == 2 ? 2 : 1;
      EXPECT_NEAR(sum, c.pressure * area, 1e-13 * c.pressure);
    }
}

TEST(Temperature, StressesOfABarBetweenWalls)
{
  // held along x, free along y (and z): sigma_x = -E alpha T, in plane strain
  // over 1 - nu
  for (const Case &c : cases)
    {
      const auto body =
        make_body(c.dim,
                  std::string("Generator = "
                              "subdivided_hyper_rectangle|"
                              "Arguments = ") +
                    (c.dim == 2 ? "3, 2 : 0, 0 : 3, 1 : true" :
                                  "3, 2, 2 : 0, 0, 0 : 3, 1, 1 : true"),
                  material(c.plane),
                  c.element);
      std::vector<unsigned int> held;
      for (unsigned int n = 0; n < body->n_nodes(); ++n)
        {
          const Point<3> x = body->position(n);
          for (unsigned int d = 0; d < c.dim; ++d)
            if (x[d] == 0 || (d == 0 && x[0] == 3))
              held.push_back(c.dim * n + d);
        }
      Eigen::VectorXd f = no_forces(*body);
      body->add(Action::initial_strains(heat()), f);
      const Eigen::VectorXd u   = solve(*body, held, f);
      const Eigen::VectorXd r   = stiffness(*body) * u - f;
      double                sum = 0;
      for (unsigned int n = 0; n < body->n_nodes(); ++n)
        if (body->position(n)[0] == 3)
          sum += r[c.dim * n];
      const bool   plane_strain = c.dim == 2 && c.plane == "strain";
      const double area         = c.dim == 2 ? 2 : 1;
      EXPECT_NEAR(sum,
                  -E * alpha * change * area *
                    (plane_strain ? (1 + nu) / (1 - nu * nu) : 1),
                  1e-12);
    }
}

TEST(Temperature, StressOutOfThePlane)
{
  ElasticMaterial steel;
  steel.young_modulus = E;
  steel.poisson_ratio = nu;
  steel.expansion     = alpha;
  using Element       = ElementFormulation<2>;
  const auto places   = [](const ElementRow<2> &row) {
    Element::Vertices x;
    // the first three vertices of the unit square are those of the triangle
    for (unsigned int v = 0; v < (row.is_simplex ? 3 : 4); ++v)
      x.push_back(dealii::GeometryInfo<2>::unit_cell_vertex(v));
    if (row.degree == 1)
      return x;
    using Edges       = std::vector<std::pair<std::size_t, std::size_t>>;
    const Edges edges = row.is_simplex ?
                            Edges{{0, 1}, {1, 2}, {2, 0}} :
                            Edges{{0, 2}, {1, 3}, {0, 1}, {2, 3}, {0, 3}};
    for (const auto &[v, w] : edges)
      x.push_back(x[v] + .5 * (x[w] - x[v]));
    return x;
  };
  const auto stresses = [&](const ElementRow<2> &row) -> Element::Strains {
    const auto             vertices = places(row);
    const auto             n = static_cast<unsigned int>(vertices.size());
    Element::Displacements u(2 * n);
    for (unsigned int v = 0; v < n; ++v)
      {
        u.segment<2>(2 * v) << .03 * vertices[v][0], .01 * vertices[v][1];
      }
    const Element::Strains heated =
      strain_components(InitialStrain{{}, change}.of(alpha), 2).replicate(1, n);
    return row.create(steel)->stresses(vertices, u, heated);
  };
  for (const auto &row : element_table<2>())
    for (unsigned int v = 0; v < places(row).size(); ++v)
      {
        steel.plane             = ElasticMaterial::Plane::strain;
        const Eigen::Vector4d s = stresses(row).col(v);
        EXPECT_NEAR(s[2], nu * (s[0] + s[1]) - E * alpha * change, 1e-14);
        steel.plane = ElasticMaterial::Plane::stress;
        EXPECT_EQ(stresses(row)(2, v), 0);
      }
}

TEST(Temperature, NothingExpandsWithoutCoefficient)
{
  const auto      body = make_body(2, "File = " + write_distorted_mesh(2, 3));
  Eigen::VectorXd f    = no_forces(*body);
  EXPECT_FALSE(body->expands());
  body->add(Action::initial_strains(heat()), f);
  EXPECT_EQ(f.norm(), 0);
}

namespace
{
  const Tensor<2, 3> all_components = [] {
    const double values[3][3] = {{.003, .001, -.002},
                                 {.001, -.001, .0005},
                                 {-.002, .0005, .002}};
    Tensor<2, 3> strain;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        strain[i][j] = values[i][j];
    return strain;
  }();

  InitialStrainField
  uniform_strain(const unsigned int dim)
  {
    Tensor<2, 3> strain = all_components;
    if (dim == 2) // nothing is held along z then
      for (unsigned int i = 0; i < 3; ++i)
        strain[i][2] = strain[2][i] = 0;
    return [strain](const Point<3> &) { return InitialStrain{strain, 0}; };
  }

  const std::string wood =
    "Young moduli = 1000, 400, 250|Poisson ratios = 0.3, 0.25, 0.35|"
    "Shear moduli = 300, 200, 120|Axes = ";
} // namespace

TEST(InitialStrain, FreeBodiesTakeItWithoutForce)
{
  for (const Case &c : cases)
    for (const std::string &of :
         {material(c.plane),
          wood + (c.dim == 2 ? "30" : "1, 2, -1, 40") + "|Plane = " + c.plane})
      {
        const auto            body   = make_body(c.dim,
                                    "File = " + write_distorted_mesh(c.dim, 3),
                                    of,
                                    c.element);
        const auto            field  = uniform_strain(c.dim);
        const Tensor<2, 3>    strain = field(Point<3>()).strain;
        const Eigen::VectorXd u =
          interpolate(*body, [&](const Point<3> &x) { return strain * x; });
        Eigen::VectorXd f = no_forces(*body);
        EXPECT_TRUE(body->add(Action::initial_strains(field), f));
        EXPECT_LE((stiffness(*body) * u - f).cwiseAbs().maxCoeff(),
                  1e-13 * f.cwiseAbs().maxCoeff())
          << c.element << ", " << c.plane;
      }
}

TEST(InitialStrain, HeldBodiesHaveItsStressAndNoStrain)
{
  for (const auto &row : element_table<3>())
    {
      if (row.is_simplex)
        continue;
      const auto            body  = make_body(3,
                                  "File = " + write_distorted_mesh(3, 2),
                                  wood + "1, 2, -1, 40",
                                  row.name);
      const Eigen::VectorXd u     = Eigen::VectorXd::Zero(body->n_dofs());
      const VtuGrid         drawn = body->drawing(
        u, u, {{Action::Kind::initial_strain, {}, {}, {}, uniform_strain(3)}});
      ElasticMaterial material;
      material.orthotropy =
        Orthotropy{{1000, 400, 250}, {.3, .25, .35}, {300, 200, 120}};
      const auto Q = rotation_about(dealii::Tensor<1, 3>({1., 2., -1.}), 40);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          material.orthotropy->axes(i, j) = Q[i][j];
      const Eigen::VectorXd s =
        -material.elasticity(3) * strain_components(all_components, 3);
      const double expected[9] = {
        s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]};
      for (const VtuField &field : drawn.point_fields)
        for (std::size_t k = 0; k < field.values.size(); ++k)
          {
            if (field.name == "stress")
              {
                EXPECT_NEAR(field.values[k], expected[k % 9], 1e-12);
              }
            else if (field.name == "strain")
              {
                EXPECT_NEAR(field.values[k], 0, 1e-15);
              }
          }
    }
}
