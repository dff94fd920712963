// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_history.h"
#include "conetact/contact/refusal.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;

namespace
{
  /**
   * A body that stands on y = 0 from x = 0 to 2 and weighs 10, pushed by
   * `push` to the right at its point (1, 1).
   */
  class Pushed : public testing::TestWithParam<std::string>
  {
  protected:
    std::string
    sentence(const double mu, const double push)
    {
      const std::string friction =
        "|Friction coefficient = " + std::to_string(mu);
      scene = test::make_scene(GetParam() == "frame" ?
                                 test::triangle_on_floor("", "", friction) :
                                 block(friction));
      model =
        std::make_unique<ContactModel>(scene->bodies, std::vector<double>{1});
      if (GetParam() == "iterative")
        model->solve_by(iterative_row());
      EXPECT_EQ(model->condensed_form(), solvers::Form::compliance);
      const solvers::ExistenceCheck check =
        make_existence_check(*model, model->points.layout().mu);
      const solvers::Existence result =
        check.check(resultants(push), resultants(0));
      return result.admissible ? "stands" : describe(result, *model);
    }

  private:
    static std::string
    block(const std::string &friction)
    {
      return "set Dimension = 2\nset Bodies = frame\nset Obstacles = floor\n"
             "set Contacts = feet\nsubsection Body frame\n" +
             test::section("Mesh",
                           "Generator = subdivided_hyper_rectangle|"
                           "Arguments = 2, 1 : 0, 0 : 2, 1 : true") +
             test::section("Material",
                           "Young modulus = 1000|Poisson ratio = 0.3") +
             "end\n" +
             test::section("Obstacle floor",
                           "Shape = half space|Normal = 0, 1") +
             test::section("Contact feet",
                           "Body = frame|Boundary ids = 2|Obstacle = floor" +
                             friction);
    }

    Eigen::VectorXd
    resultants(const double push)
    {
      const bodies::Structure &body = *scene->bodies.structures[0];
      Eigen::VectorXd          f    = Eigen::VectorXd::Zero(body.n_dofs());
      for (unsigned int i = 0; i < body.n_nodes(); ++i)
        if (body.position(i).distance(Point<3>(1, 1, 0)) < 1e-9)
          {
            f[2 * i]     = push;
            f[2 * i + 1] = -10;
          }
      ContactHistory history(*model);
      return model->elasticity().contact_load(
        history.problem(model->load_case(f, {}, 1)));
    }

    std::unique_ptr<application::Scene> scene;
    std::unique_ptr<ContactModel>       model;
  };
} // namespace

// a stiffness with motions, rows of a continuum with balances, all its unknowns
INSTANTIATE_TEST_SUITE_P(FramesAndContinua,
                         Pushed,
                         testing::Values("frame", "rows", "iterative"));



TEST_P(Pushed, StandsWhileFrictionCarriesIt)
{
  EXPECT_EQ(sentence(.3, 2.9), "stands");
  EXPECT_EQ(sentence(2, 9.9), "stands");
}



TEST_P(Pushed, SlidesWhereThePushIsMoreThanFriction)
{
  EXPECT_EQ(sentence(.3, 5),
            "body 'frame' slides along (1, 0, 0): of this increment's load "
            "friction can carry at most 0.6");
}



// 10 at a lever of 1 holds 10 at a height of 1, however large friction is
TEST_P(Pushed, TipsOverTheFootAhead)
{
  EXPECT_EQ(sentence(5, 20),
            "body 'frame' tips over, turning about (0, 0, -1): of "
            "this increment's load contact can carry at most 0.5");
}
