// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/adaptive_refinement.h"

#include <gtest/gtest.h>

#include <numeric>

#include "body_fixture.h"

using namespace conetact;
using namespace conetact::analysis;
using namespace conetact::bodies;
using namespace conetact::test;

namespace
{
  /** A unit square or cube of cells that will be refined. */
  std::unique_ptr<Structure>
  cube(const unsigned int dim)
  {
    dealii::ParameterHandler prm;
    declare_body(prm);
    prm.parse_input_from_string(
      "subsection Mesh\n" +
      lines("Generator = hyper_cube|Arguments = 0:1:true|"
            "Global refinements = 2") +
      "\nend\nsubsection Material\n" +
      lines("Young modulus = 5|Poisson ratio = 0.3|Thickness = 3") + "\nend\n");
    return create_body(prm, dim, "", "block", Refinements(1));
  }

  Field
  kink(const double at)
  {
    return [at](const Point<3> &p) {
      return Tensor<1, 3>({std::abs(p[0] - at), 0, 0});
    };
  }
} // namespace

TEST(Refinement, ElementsWithTheLargestErrorsAreChosen)
{
  using Chosen = std::vector<std::set<unsigned int>>;
  const std::vector<std::vector<double>> errors = {{1, 5, 3}, {}, {4, 0, 2, 1}};
  EXPECT_EQ(worst_elements(errors, .3), (Chosen{{1, 2}, {}, {0}}));
  EXPECT_EQ(worst_elements(errors, .01), (Chosen{{1}, {}, {}}));
  EXPECT_EQ(worst_elements(errors, 1), (Chosen{{0, 1, 2}, {}, {0, 2, 3}}));
  // those that are as bad as the last one come along
  EXPECT_EQ(worst_elements({{2, 1, 1 + 1e-7, 1}}, .5), (Chosen{{0, 1, 2, 3}}));
  EXPECT_EQ(worst_elements({{0, 0}}, .5), (Chosen{{}}));
}

TEST(Refinement, ErrorsAreJumpsOfTheGradient)
{
  for (const unsigned int dim : {2, 3})
    {
      const auto  body   = cube(dim);
      const Field linear = [](const Point<3> &p) {
        return Tensor<1, 3>({p[0] + p[1], 2 * p[1], p[0]});
      };
      for (const double error :
           body->element_errors(interpolate(*body, linear)))
        EXPECT_LT(error, 1e-12);

      // a jump of 2 on one face of area (1/4)^(dim - 1) of half of the cells
      const std::vector<double> errors =
        body->element_errors(interpolate(*body, kink(.5)));
      const double h = .25 * std::sqrt(double(dim));
      const double n = std::pow(4, dim) / 2;
      const double exact =
        n * h / 24 * 4 * std::pow(.25, dim - 1) * 5 * (dim == 2 ? 3 : 1);
      EXPECT_NEAR(std::accumulate(errors.begin(), errors.end(), 0.),
                  exact,
                  1e-5 * exact);
      EXPECT_EQ(std::count_if(errors.begin(),
                              errors.end(),
                              [](const double e) { return e > 1e-12; }),
                n);
    }
}

TEST(Refinement, DividedCellsPassTheirIdsAndTheirShapeOn)
{
  const auto make = [](const Refinements &refinements) {
    dealii::ParameterHandler prm;
    declare_body(prm);
    prm.parse_input_from_string(
      "subsection Mesh\nset Generator = hyper_ball\n"
      "set Arguments = 0, 0 : 1 : false\nset Global refinements = 1\n"
      "set Translation = 0, 3\nset Boundary ids = 7: y < 2.2\nend\n"
      "subsection Material\nset Young modulus = 5\nset Poisson ratio = 0.3\nend\n");
    return create_body(prm, 2, folder(), "ball", refinements);
  };
  const auto tagged  = make({})->surface({7}).faces.size();
  const auto refined = make(
    {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19},
     {0, 1, 2, 3}});
  EXPECT_GE(refined->surface({7}).faces.size(), 2 * tagged);
  EXPECT_FALSE(refined->hanging_nodes().empty());
  for (const SurfaceNode &node : refined->surface({0, 7}).nodes)
    EXPECT_NEAR(node.position.distance(Point<3>(0, 3, 0)), 1, 1e-14);
}
