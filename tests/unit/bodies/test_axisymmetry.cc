// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Bodies of revolution.

#include <Eigen/LU>

#include "body_fixture.h"
#include "sentence.h"

namespace conetact::test
{
  namespace
  {
    const std::string material =
      "Young modulus = 5|Poisson ratio = 0.3|Plane = axisymmetric|"
      "Expansion coefficient = 0.01";

    /** Radii from r to r + 2, height 1; sides 0 inside, 1, 2 below, 3. */
    std::unique_ptr<Structure>
    ring(const std::string &r, const std::string &element)
    {
      return make_body(2,
                       "Generator = subdivided_hyper_rectangle|Arguments = "
                       "4, 2 : 0, 0 : 2, 1 : true|Translation = " +
                         r + ", 0",
                       material,
                       element);
    }

    double
    area(const Structure &body, const unsigned int id)
    {
      double sum = 0;
      for (const SurfaceNode &node : body.surface({id}).nodes)
        sum += node.area;
      return sum;
    }

    const auto elements = {"Q1", "Q1 B-bar", "P1"};

    /** 4 (lambda + G) V is twice the energy of u = (r, 0). */
    const double of_growth = 4 * .5 * 5 / (1.3 * .4);

    std::string
    refusal(const unsigned int dim,
            const std::string &mesh,
            const std::string &entries,
            const std::string &element)
    {
      return sentence_of([&] { make_body(dim, mesh, entries, element); });
    }
  } // namespace

  TEST(Axisymmetry, AreasGoRound)
  {
    for (const char *element : elements)
      {
        const auto body = ring("1", element);
        EXPECT_TRUE(body->is_axisymmetric());
        EXPECT_NEAR(area(*body, 0), 2 * M_PI, 1e-13);
        EXPECT_NEAR(area(*body, 1), 6 * M_PI, 1e-13);
        EXPECT_NEAR(area(*body, 2), 8 * M_PI, 1e-13);
      }
  }

  TEST(Axisymmetry, OnlyTheAxisMovesWithoutForce)
  {
    for (const char *element : elements)
      for (const char *r : {"0", "1"})
        {
          const auto            body = ring(r, element);
          const Eigen::MatrixXd k    = stiffness(*body);
          EXPECT_EQ((k - k.transpose()).norm(), 0);
          const Eigen::VectorXd along =
            interpolate(*body, [](const Point<3> &) {
              return Tensor<1, 3>({0., 1., 0.});
            });
          EXPECT_EQ((k * along).norm(), 0);
          Eigen::VectorXd f = Eigen::VectorXd::Zero(k.rows());
          body->elements().add_forces(1e6 * along, f);
          EXPECT_EQ(f.norm(), 0);
          // as many motions without force as nodes on the axis, and one
          const Eigen::FullPivLU<Eigen::MatrixXd> lu(k);
          Eigen::Index                            on_axis = 0;
          for (unsigned int i = 0; i < body->n_nodes(); ++i)
            on_axis += body->position(i)[0] == 0;
          EXPECT_EQ(lu.dimensionOfKernel(), 1 + on_axis);
        }
  }

  TEST(Axisymmetry, GrowthStrainsAlongAndRound)
  {
    for (const char *element : elements)
      for (const double r : {0., 1.})
        {
          const auto            body = ring(std::to_string(r), element);
          const Eigen::VectorXd u = interpolate(*body, [](const Point<3> &p) {
            return Tensor<1, 3>({p[0], 0., 0.});
          });
          const double          volume = M_PI * ((r + 2) * (r + 2) - r * r);
          EXPECT_NEAR(u.dot(stiffness(*body) * u),
                      of_growth * volume,
                      1e-12 * volume * of_growth);
        }
  }

  TEST(Axisymmetry, HeatActsRoundAsWell)
  {
    for (const char *element : elements)
      for (const char *r : {"0", "1"})
        {
          const auto            body = ring(r, element);
          const Eigen::VectorXd u = interpolate(*body, [](const Point<3> &p) {
            return .01 * Tensor<1, 3>({p[0], p[1], 0.});
          });
          Eigen::VectorXd       f = Eigen::VectorXd::Zero(u.size());
          body->add(Action::initial_strains([](const Point<3> &) {
                      return InitialStrain{{}, 1.};
                    }),
                    f);
          EXPECT_LT((f - stiffness(*body) * u).norm(), 1e-13 * f.norm());
        }
  }

  TEST(Axisymmetry, RoundingPutsNothingBesideTheAxis)
  {
    const auto body =
      make_body(2,
                "Generator = quarter_hyper_ball|Arguments = 0, 0 : 3|Rotation "
                "= -90|Translation = 0, 3|Global refinements = 1",
                material);
    unsigned int on_axis = 0;
    for (unsigned int i = 0; i < body->n_nodes(); ++i)
      {
        EXPECT_GE(body->position(i)[0], 0);
        on_axis += body->position(i)[0] == 0;
      }
    EXPECT_EQ(on_axis, 5);
  }

  TEST(Axisymmetry, WhatMakesNoSenseIsRefused)
  {
    const std::string square = "Generator = hyper_cube|Arguments = 0:1:true";
    const auto        expect = [](const std::string &sentence,
                           const std::string &part) {
      EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    };
    expect(refusal(2, square, material, "Q1 incompatible modes"),
           "Element: Q1 incompatible modes is not for bodies of revolution");
    expect(refusal(3, square, material, "Q1"), "is for Dimension = 2");
    expect(refusal(2, square + "|Translation = -0.5, 0", material, "Q1"),
           "has a node at (-0.5, 0, 0). Give the half with x >= 0 only.");
    expect(refusal(2, square, material + "|Thickness = 2", "Q1"),
           "has none, its forces are those of the whole circumference");
  }
} // namespace conetact::test
