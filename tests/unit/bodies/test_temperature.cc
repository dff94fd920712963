// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/continuum.h"
#include "conetact/bodies/continuum/graphics.h"

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

  ScalarField
  heat()
  {
    return [](const Point<3> &) { return change; };
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
      EXPECT_TRUE(body->add_temperature(heat(), f));
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
      body->add_temperature(heat(), f);
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
      body->add_temperature(heat(), f);
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
      change * steel.thermal_strain(2).replicate(1, n);
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
  EXPECT_FALSE(body->add_temperature(heat(), f));
  EXPECT_EQ(f.norm(), 0);
}
