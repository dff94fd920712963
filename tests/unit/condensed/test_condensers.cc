// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/verify_condensation.h"
#include "conetact/application/scene.h"
#include "conetact/base/errors.h"
#include "conetact/condensed/super_element.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "lattice.h"

namespace
{
  using namespace conetact;
  using namespace conetact::analysis;
  using namespace conetact::application;
  using namespace conetact::condensed;
  using namespace conetact::contact;
  using Eigen::Index;
  using Eigen::MatrixXd;

  // A scene and its model, which refers to it.
  struct Model
  {
    Scene                         scene;
    std::unique_ptr<ContactModel> model;

    Model(const std::string              &file,
          const std::vector<std::string> &overrides = {},
          const std::string              &condenser = "mumps")
      : scene(line(file, overrides))
    {
      scene.build();
      model = std::make_unique<ContactModel>(scene.bodies,
                                             scene.times,
                                             condenser_named(condenser));
    }

    static CommandLine
    line(const std::string &file, const std::vector<std::string> &overrides)
    {
      CommandLine result;
      result.scene     = std::filesystem::path(CONETACT_SCENES) / file;
      result.overrides = overrides;
      return result;
    }
  };

  struct Case
  {
    std::string              file;
    std::vector<std::string> overrides;
    std::vector<std::size_t> n_bodies; // of each stiffness
  };

  // Continua in the plane and in space, a mechanism of bars, a floating body,
  // foundations, bodies in contact with each other.
  const std::vector<Case> cases = {
    {"square-greco.prm", {}, {1}},
    {"inclined-obstacle.prm", {}, {1}},
    {"block-press-shear.prm",
     {"Body block/Mesh/Arguments=8, 8, 8 : 0, 0, 0 : 1, 1, 1 : true"},
     {1}},
    {"double-layer-grid-04.prm", {}, {1}},
    {"beam-three-supports.prm", {}, {1}},
    {"floating-block.prm", {}, {1}},
    {"sheet-pile.prm", {}, {1, 1, 1}}, // sides are mirrored, no copies
    {"stacked-blocks.prm", {}, {1, 1, 1}}};

  void
  expect_same_stiffness(Model                          &own,
                        const Condenser                &other,
                        const std::vector<std::size_t> &n_bodies)
  {
    const auto found = own.model->compare_stiffness(other);
    ASSERT_EQ(found.size(), n_bodies.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      {
        EXPECT_EQ(found[i].bodies.size(), n_bodies[i]);
        EXPECT_LT(found[i].relative, 1e-12) << other.name;
        EXPECT_GE(found[i].relative, 0) << other.name;
      }
  }

  // The stiffness of MUMPS, wrong in its tenth digit.
  class Wrong : public SchurSolver
  {
  public:
    explicit Wrong(std::unique_ptr<SchurSolver> s)
      : solver(std::move(s))
    {}
    MatrixXd
    take_schur_complement() override
    {
      return (1 + 1e-9) * solver->take_schur_complement();
    }
    MatrixXd
    reduce(const MatrixXd &b) const override
    {
      return solver->reduce(b);
    }
    MatrixXd
    expand(const MatrixXd &b, const MatrixXd &u_C) const override
    {
      return solver->expand(b, u_C);
    }
    double
    factor_bytes() const override
    {
      return 0;
    }
    const SchurWork &
    work() const override
    {
      return solver->work();
    }

  private:
    std::unique_ptr<SchurSolver> solver;
  };

  const Condenser wrong = {"wrong",
                           "",
                           [](const Eigen::SparseMatrix<double> &upper,
                              const Index                        n_schur,
                              const std::vector<unsigned int>   &node_of)
                             -> std::unique_ptr<SchurSolver> {
                             return std::make_unique<Wrong>(
                               default_condenser().create(upper,
                                                          n_schur,
                                                          node_of));
                           },
                           nullptr};
} // namespace



TEST(Condensers, AgreeOnTheStiffnessOfScenes)
{
  for (const Case &c : cases)
    {
      SCOPED_TRACE(c.file);
      Model own(c.file, c.overrides);
      for (const Condenser &other : condenser_table())
        expect_same_stiffness(own, other, c.n_bodies);
    }
}



// The whole way: relation of the contact unknowns, load cases, displacements.
TEST(Condensers, MakeTheSameBackend)
{
  for (const Case &c : cases)
    for (const char *name : {"amesos_klu", "amesos_mumps", "amesos_lapack"})
      {
        SCOPED_TRACE(c.file + " " + name);
        Model        one(c.file, c.overrides), two(c.file, c.overrides, name);
        Elasticity  &a    = one.model->elasticity();
        Elasticity  &b    = two.model->elasticity();
        const double t    = one.scene.times.front();
        const MatrixXd &A = a.system()->matrix, &B = b.system()->matrix;
        EXPECT_LT((A - B).cwiseAbs().maxCoeff(),
                  1e-11 * A.cwiseAbs().maxCoeff());

        const Eigen::VectorXd forces = one.scene.nodal_loads().at(t);
        const Eigen::VectorXd held   = one.model->coordinates.prescribed(t);
        const LoadCase f = a.reduce(forces, held), g = b.reduce(forces, held);
        EXPECT_LE((f.f - g.f).norm(), 1e-10 * f.f.norm());
        const Eigen::VectorXd primal = Eigen::VectorXd::Ones(A.rows());
        const Eigen::VectorXd u      = a.expand({&f}, {primal}).front(),
                              v      = b.expand({&g}, {primal}).front();
        EXPECT_LT((u - v).norm(), 1e-10 * u.norm());
      }
}



TEST(Condensers, VerificationNamesTheBody)
{
  for (const std::string file : {"square-greco.prm", "stacked-blocks.prm"})
    {
      Model own(file);
      Log   log(/*quiet=*/true, /*verbose=*/false);
      EXPECT_NO_THROW(verify_condensation(*own.model,
                                          default_condenser(),
                                          independent_of(default_condenser()),
                                          log));
      try
        {
          verify_condensation(*own.model, default_condenser(), wrong, log);
          ADD_FAILURE();
        }
      catch (const AnalysisError &error)
        {
          EXPECT_NE(std::string(error.what())
                      .find("body '" + own.scene.bodies.names[0] + "'"),
                    std::string::npos)
            << error.what();
        }
    }
}



TEST(Condensers, EachIsComparedWithAnotherMethod)
{
  for (const Condenser &condenser : condenser_table())
    {
      const std::string other = independent_of(condenser).name;
      EXPECT_EQ(other,
                condenser.name == std::string("mumps") ? "amesos_klu" :
                                                         "mumps");
    }
  EXPECT_THROW(condenser_named("superlu"), std::invalid_argument);
}



TEST(Condensers, DenseOneRefusesLargeBodies)
{
  const System     system = Lattice{{55, 56}}.assemble();
  const Condenser &lapack = condenser_named("amesos_lapack");
  for (const auto &call : {+[](const Condenser &c, const System &s) {
                             c.create(s.upper, 110, s.node_of);
                           },
                           +[](const Condenser &c, const System &s) {
                             c.estimate(s.upper, 110, s.node_of);
                           }})
    try
      {
        call(lapack, system);
        ADD_FAILURE();
      }
    catch (const InputError &error)
      {
        const std::string why = error.what();
        EXPECT_NE(why.find("Solver/Condensation: amesos_lapack"),
                  std::string::npos);
        EXPECT_NE(why.find("6050"), std::string::npos) << why;
      }
}



TEST(Condensers, EstimateWhatBothTrianglesTake)
{
  const System system = Lattice{{8, 8, 8}}.assemble();
  const Index  n      = 3 * 64;
  const double mumps =
    default_condenser().estimate(system.upper, n, system.node_of).factor_bytes;
  for (const char *name : {"amesos_klu", "amesos_mumps", "amesos_lapack"})
    {
      const FactorEstimate estimate =
        condenser_named(name).estimate(system.upper, n, system.node_of);
      EXPECT_GT(estimate.factor_bytes, mumps) << name;
      EXPECT_GT(estimate.flops, 0) << name;
      EXPECT_GE(estimate.working_bytes, estimate.factor_bytes) << name;
    }
}
