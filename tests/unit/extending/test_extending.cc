// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The examples of doc/extending.md: each class and each row as it would stand
// in its table, made and used through the row. The page shows what stands
// between the marks [...].

#include "conetact/base/atomic_file.h"
#include "conetact/base/text.h"
#include "conetact/bodies/body_table.h"
#include "conetact/bodies/continuum/continuum.h"
#include "conetact/condensed/condenser.h"
#include "conetact/output/output_table.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/solvers/solver_table.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "body_fixture.h"

using namespace conetact;
using namespace conetact::condensed;
using namespace conetact::bodies;
using namespace conetact::output;
using namespace conetact::pairing;
using namespace conetact::solvers;

namespace
{
  //! [obstacle]
  /** A ramp: flat up to its edge, then it climbs with a slope. 2D. */
  class Ramp : public ObstacleShape
  {
  public:
    Ramp(const double e, const double s)
      : edge(e)
      , slope(s)
    {}
    Closest
    closest(const Point<3> &p, const double /*spacing*/) const override
    {
      if (p[0] <= edge)
        return {p[1], Tensor<1, 3>({0, 1, 0})};
      Tensor<1, 3> n({-slope, 1, 0});
      n /= n.norm();
      return {(p - Point<3>(edge, 0, 0)) * n, n};
    }
    static void
    declare(dealii::ParameterHandler &prm)
    {
      prm.declare_entry("Edge",
                        "0",
                        dealii::Patterns::Double(),
                        "ramp: where it begins to climb. [length]");
      prm.declare_entry("Slope",
                        "1",
                        dealii::Patterns::Double(0),
                        "ramp: height over length of the climb. [-]");
    }
    static std::unique_ptr<ObstacleShape>
    create(dealii::ParameterHandler &prm,
           const unsigned int /*dim*/,
           const std::string & /*in*/)
    {
      return std::make_unique<Ramp>(prm.get_double("Edge"),
                                    prm.get_double("Slope"));
    }

  private:
    double edge, slope;
  };
  //! [obstacle]

  //! [obstacle row]
  const ObstacleRow ramp_row = {"ramp",
                                "flat, then climbing (Edge, Slope)",
                                Ramp::declare,
                                Ramp::create};
  //! [obstacle row]



  //! [element]
  /** Q1 with the strains of its centre everywhere: soft, has hourglasses. */
  template <int dim>
  class ConstantStrain : public DLinearElement<dim>
  {
  public:
    using DLinearElement<dim>::DLinearElement;

  private:
    using Base = DLinearElement<dim>;

    bool
    is_improved() const override
    {
      return true;
    }
    void
    improve(const typename Base::Vertices & /*vertices*/,
            typename Base::StrainField &strains) const override
    {
      typename Base::Columns mean   = 0 * strains.at_points.front();
      double                 volume = 0;
      for (std::size_t q = 0; q < strains.weights.size(); ++q)
        {
          mean += strains.weights[q] * strains.at_points[q];
          volume += strains.weights[q];
        }
      for (auto *columns : {&strains.at_points, &strains.at_vertices})
        for (typename Base::Columns &e : *columns)
          e = mean / volume;
    }
  };
  //! [element]

  //! [element row]
  template <int dim>
  std::unique_ptr<ElementFormulation<dim>>
  create_constant_strain(const ElasticMaterial &material)
  {
    return std::make_unique<ConstantStrain<dim>>(material);
  }

  template <int dim>
  const ElementRow<dim> constant_strain_row = {"Q1 constant strain",
                                               false, // quadrilaterals
                                               "Q1 with one strain a cell",
                                               &create_constant_strain<dim>};
  //! [element row]



  //! [solver]
  /** Gives everything to another method, and a second chance where it fails. */
  class SecondChance : public ContactSolver
  {
  public:
    explicit SecondChance(SolverOptions options)
    {
      options.method = "active set";
      first          = make_solver(options);
      options.method = "smoothing";
      second         = make_solver(options);
    }
    SolverReport
    solve(const ContactProblem &problem, ContactState &state) override
    {
      const ContactState start  = state;
      SolverReport       report = first->solve(problem, state);
      if (report.converged)
        return report;
      state = start; // of no use after a failure
      return second->solve(problem, state);
    }

  private:
    std::unique_ptr<ContactSolver> first, second;
  };
  //! [solver]

  //! [solver row]
  std::unique_ptr<ContactSolver>
  make_second_chance(const SolverOptions &options)
  {
    return std::make_unique<SecondChance>(options);
  }

  const SolverRow second_chance_row = {"second chance",
                                       "active set, then smoothing",
                                       &make_second_chance};
  //! [solver row]



  //! [body]
  /** A peg: node 1 on a spring [force/length] to node 0, along each axis. */
  class Peg : public Structure, private Elements
  {
  public:
    Peg(const unsigned int d, const double k)
      : Elements(d)
      , dim(d)
      , spring(k)
    {}
    unsigned int
    n_nodes() const override
    {
      return 2;
    }
    unsigned int
    n_components() const override
    {
      return dim;
    }
    Point<3>
    position(const unsigned int node) const override
    {
      return Point<3>(0, node == 0 ? 1 : 0, 0);
    }
    const std::vector<HangingNode> &
    hanging_nodes() const override
    {
      return none;
    }
    const Elements &
    elements() const override
    {
      return *this;
    }
    void
    for_each(const ElementVisitor &visit) const override
    {
      const double k[] = {spring, -spring, -spring, spring};
      for (unsigned int c = 0; c < dim; ++c)
        visit({c, dim + c}, k);
    }
    void
    add_forces(const Eigen::VectorXd &u, Eigen::VectorXd &f) const override
    {
      const Eigen::VectorXd pull = spring * (u.tail(dim) - u.head(dim));
      f.head(dim) -= pull;
      f.tail(dim) += pull;
    }
    BoundaryIds
    boundary_ids() const override
    {
      return {0, 1}; // of the node that is held and of the one that touches
    }
    Surface
    surface(const BoundaryIds &ids) const override
    {
      Surface surface;
      for (const unsigned int id : ids)
        {
          const Tensor<1, 3> n({0, id == 0 ? 1. : -1., 0});
          surface.nodes.push_back({id, position(id), 1, n, {n}});
        }
      return surface;
    }
    bool
    add(const Action &action, Eigen::VectorXd &f) const override
    {
      const auto add_to = [&](const unsigned int node, const Tensor<1, 3> &p) {
        for (unsigned int c = 0; c < dim; ++c)
          f[node * dim + c] += p[c];
      };
      if (action.kind == Action::Kind::traction)
        for (const SurfaceNode &node : surface(action.ids).nodes)
          add_to(node.node,
                 node.area * action.force(node.position, node.normal));
      else if (action.kind == Action::Kind::point_force)
        add_to(action.point[1] > .5 ? 0 : 1, action.force(action.point, {}));
      return true; // it has no volume that others act on
    }
    void
    visit_springs(const BoundaryIds & /*ids*/,
                  const SurfaceTensorField & /*stiffness*/,
                  const ElementVisitor & /*visit*/) const override
    {} // no foundation
    VtuGrid
    drawing(const Eigen::VectorXd & /*u*/,
            const Eigen::VectorXd & /*w*/,
            const Actions & /*actions*/) const override
    {
      return {};
    }
    std::string
    description() const override
    {
      return "a peg";
    }

  private:
    unsigned int             dim;
    double                   spring;
    std::vector<HangingNode> none;
  };
  //! [body]

  //! [body row]
  void
  declare_peg(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Spring",
                      "1",
                      dealii::Patterns::Double(0),
                      "peg: stiffness along each axis. [force/length]");
  }

  std::unique_ptr<Structure>
  create_peg(dealii::ParameterHandler &prm,
             const unsigned int        dim,
             const std::filesystem::path & /*folder*/,
             const std::string & /*name*/,
             const Refinements & /*refinements*/)
  {
    return std::make_unique<Peg>(dim, prm.get_double("Spring"));
  }

  const BodyRow peg_row = {"peg",
                           "a node on a spring (Spring)",
                           &declare_peg,
                           &create_peg};
  //! [body row]



  //! [output]
  /** slipping.txt: how many nodes slip, a line for each increment. */
  class Slipping : public Output
  {
  public:
    explicit Slipping(const RunDescription &run)
      : file(run.folder / "slipping.txt")
    {}
    void
    write(const std::vector<model::IncrementRecord> &finished) override
    {
      for (const model::IncrementRecord &record : finished)
        {
          unsigned int n = 0;
          for (const model::ContactRow &row : record.rows)
            n += row.state == NodeState::slip && !row.master;
          text +=
            std::to_string(record.increment) + " " + std::to_string(n) + "\n";
        }
      write_atomically(file, text);
    }

  private:
    const std::filesystem::path file;
    std::string                 text;
  };
  //! [output]

  //! [output row]
  std::unique_ptr<Output>
  create_slipping(const RunDescription &run)
  {
    return std::make_unique<Slipping>(run);
  }

  const OutputRow slipping_row = {"slipping",
                                  "slipping.txt: number of nodes that slip",
                                  &create_slipping};
  //! [output row]


  //! [pairing]
  /** Node to node, for meshes that match: each node meets the nearest one of
   * the master, along the normal of its own surface. */
  PairedNodes
  pair_node_to_node(const Contact                        &contact,
                    const std::vector<const Structure *> &structures)
  {
    const Surface slave = structures[contact.body]->surface(contact.ids);
    const Surface master =
      structures[contact.master]->surface(contact.master_ids);
    PairedNodes found;
    for (const SurfaceNode &s : slave.nodes)
      {
        const auto distance = [&](const SurfaceNode &m) {
          return m.position.distance(s.position);
        };
        const SurfaceNode &nearest =
          *std::min_element(master.nodes.begin(),
                            master.nodes.end(),
                            [&](const SurfaceNode &a, const SurfaceNode &b) {
                              return distance(a) < distance(b);
                            });
        ContactNode node;
        node.body     = contact.body;
        node.node     = s.node;
        node.position = s.position;
        node.area     = s.area;
        node.spacing  = std::sqrt(s.area);
        node.n        = -s.normal;
        node.gap      = (s.position - nearest.position) * node.n;
        node.master   = contact.master;
        node.masters  = {{nearest.node, 1.}};
        found.nodes.push_back(std::move(node));
      }
    found.n_nodes = found.n_paired =
      static_cast<unsigned int>(found.nodes.size());
    return found;
  }
  //! [pairing]

  //! [pairing row]
  const PairingRow node_to_node_row = {
    "node to node",
    "each node meets the nearest node of the master, for meshes that match",
    pair_node_to_node,
    false};
  //! [pairing row]



  //! [backend]
  /** Condenses by a dense Cholesky factorisation: for very small bodies. */
  class DenseSchur : public SchurSolver
  {
  public:
    using Index = Eigen::Index;

    DenseSchur(const Eigen::SparseMatrix<double> &upper, const Index n_schur)
      : n(upper.cols())
      , n_f(n - n_schur)
    {
      const Eigen::MatrixXd half  = upper;
      const Eigen::MatrixXd whole = half.selfadjointView<Eigen::Upper>();
      A_FC                        = whole.topRightCorner(n_f, n_schur);
      factor.compute(whole.topLeftCorner(n_f, n_f));
      if (factor.info() != Eigen::Success)
        throw SingularMatrix(std::nullopt);
      S = whole.bottomRightCorner(n_schur, n_schur) -
          A_FC.transpose() * factor.solve(A_FC);
      done.factorizations = done.condensations = 1;
    }
    Eigen::MatrixXd
    take_schur_complement() override
    {
      return std::move(S);
    }
    Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &b) const override
    {
      done.reductions += static_cast<unsigned int>(b.cols());
      return b.bottomRows(n - n_f) -
             A_FC.transpose() * factor.solve(b.topRows(n_f));
    }
    Eigen::MatrixXd
    expand(const Eigen::MatrixXd &b, const Eigen::MatrixXd &u_C) const override
    {
      done.expansions += static_cast<unsigned int>(b.cols());
      Eigen::MatrixXd u(n, b.cols());
      u << factor.solve(b.topRows(n_f) - A_FC * u_C), u_C;
      return u;
    }
    double
    factor_bytes() const override
    {
      return 8. * static_cast<double>(n_f * n_f);
    }
    const SchurWork &
    work() const override
    {
      return done;
    }

  private:
    Index                       n, n_f;
    Eigen::LLT<Eigen::MatrixXd> factor; ///< of A_FF
    Eigen::MatrixXd             A_FC, S;
    mutable SchurWork           done;
  };
  //! [backend]

  //! [backend row]
  std::unique_ptr<SchurSolver>
  create_dense(const Eigen::SparseMatrix<double> &upper,
               const Eigen::Index                 n_schur,
               const std::vector<unsigned int> & /*node_of*/)
  {
    return std::make_unique<DenseSchur>(upper, n_schur);
  }

  FactorEstimate
  estimate_dense(const Eigen::SparseMatrix<double> &upper,
                 const Eigen::Index                 n_schur,
                 const std::vector<unsigned int> & /*node_of*/)
  {
    const auto     n = static_cast<double>(upper.cols() - n_schur);
    FactorEstimate result;
    result.factor_bytes = result.working_bytes = 8 * n * n;
    result.flops                               = n * n * n / 3;
    return result;
  }

  const Condenser dense_row = {"dense",
                               "dense Cholesky, for very small bodies",
                               &create_dense,
                               &estimate_dense};
  //! [backend row]
} // namespace

TEST(Extending, AnObstacle)
{
  dealii::ParameterHandler prm;
  ramp_row.declare(prm);
  prm.set("Edge", 2.);
  const auto ramp = ramp_row.create(prm, 2, "Obstacle 'ramp', ");
  EXPECT_EQ(ramp->closest({1, .5, 0}, 1).gap, .5);
  EXPECT_NEAR(ramp->closest({3, 1, 0}, 1).gap, 0, 1e-15);
  EXPECT_NEAR(ramp->gap_after({3, 1, 0}, Tensor<1, 3>({0, 1, 0}), 1),
              std::sqrt(.5),
              1e-15);
}

TEST(Extending, AnElement)
{
  auto mesh = std::make_unique<dealii::Triangulation<2>>();
  dealii::GridGenerator::subdivided_hyper_cube(*mesh, 2);
  ElasticMaterial material;
  material.young_modulus = 10;
  material.poisson_ratio = .3;
  const Continuum<2> body(std::move(mesh), material, constant_strain_row<2>);
  const Continuum<2> cell = [&] {
    auto one = std::make_unique<dealii::Triangulation<2>>();
    dealii::GridGenerator::hyper_cube(*one);
    return Continuum<2>(std::move(one), material, constant_strain_row<2>);
  }();
  EXPECT_NE(body.description().find("Q1 constant strain"), std::string::npos);
  // an hourglass of one cell meets no force, a uniform strain does
  Eigen::VectorXd u = Eigen::VectorXd::Zero(8), f = u;
  for (unsigned int i = 0; i < 4; ++i)
    u[2 * i] = (cell.position(i)[0] - .5) * (cell.position(i)[1] - .5);
  cell.elements().add_forces(u, f);
  EXPECT_LT(f.norm(), 1e-14);
  for (unsigned int i = 0; i < 4; ++i)
    u[2 * i] = cell.position(i)[0];
  cell.elements().add_forces(u, f);
  EXPECT_GT(f.norm(), 1);
}

TEST(Extending, ASolver)
{
  auto system    = std::make_shared<ContactSystem>();
  system->first  = {0, 2};
  system->mu     = Eigen::VectorXd::Constant(1, .3);
  system->matrix = 100 * Eigen::Matrix2d::Identity();
  ContactProblem problem;
  problem.system = system;
  problem.gap    = Eigen::VectorXd::Zero(1);
  problem.load   = Eigen::Vector2d(5, -10);
  ContactState state;
  state.v = state.r = Eigen::VectorXd::Zero(2);
  const SolverReport report =
    second_chance_row.create({})->solve(problem, state);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_NEAR(state.r[0], -3, 1e-12);
  EXPECT_NEAR(state.v[0], .02, 1e-14);
}

TEST(Extending, ABody)
{
  dealii::ParameterHandler prm;
  peg_row.declare(prm);
  prm.set("Spring", 7.);
  const auto      peg = peg_row.create(prm, 2, {}, "peg", {});
  Eigen::VectorXd u(4), f = Eigen::VectorXd::Zero(4), g = f;
  u << 0, 0, 1, -2;
  peg->elements().add_forces(u, f);
  peg->elements().for_each(
    [&](const std::vector<unsigned int> &dofs, const double *k) {
      for (std::size_t i = 0; i < dofs.size(); ++i)
        for (std::size_t j = 0; j < dofs.size(); ++j)
          g[dofs[i]] += k[i * dofs.size() + j] * u[dofs[j]];
    });
  EXPECT_EQ(f, g);
  EXPECT_EQ(f, Eigen::Vector4d(-7, 14, 7, -14));
}

TEST(Extending, AnOutput)
{
  RunDescription run;
  run.folder = std::filesystem::temp_directory_path();
  model::IncrementRecord record;
  record.increment = 1;
  record.rows.resize(3);
  record.rows[1].state = NodeState::slip;
  slipping_row.create(run)->write({record});
  std::ifstream file(run.folder / "slipping.txt");
  std::string   line;
  std::getline(file, line);
  EXPECT_EQ(line, "1 1");
  std::filesystem::remove(run.folder / "slipping.txt");
}

TEST(Extending, ABackend)
{
  // three springs of 2 in a row, the last node is kept
  Eigen::SparseMatrix<double> upper(3, 3);
  upper.insert(0, 0) = upper.insert(1, 1) = 4;
  upper.insert(0, 1) = upper.insert(1, 2) = -2;
  upper.insert(2, 2)                      = 2;
  const auto solver = dense_row.create(upper, 1, {0, 1, 2});
  EXPECT_NEAR(solver->take_schur_complement()(0, 0), 2. / 3, 1e-15);
  const Eigen::Vector3d b(0, 3, 0);
  EXPECT_NEAR(solver->reduce(b)(0, 0), 2, 1e-15);
  const Eigen::Vector3d u =
    solver->expand(b, Eigen::MatrixXd::Constant(1, 1, 3));
  EXPECT_LT((u - Eigen::Vector3d(1.5, 3, 3)).norm(), 1e-14);
  EXPECT_EQ(dense_row.estimate(upper, 1, {}).factor_bytes, 32);
}

TEST(Extending, APairing)
{
  const std::string mesh =
    "Generator = subdivided_hyper_rectangle|Arguments = ";
  const auto low  = test::make_body(2, mesh + "3, 1 : 0, 0 : 3, 1 : true");
  const auto high = test::make_body(2, mesh + "3, 1 : 0, 1.5 : 3, 2 : true");
  Contact    contact;
  contact.ids        = {2};
  contact.master     = 1;
  contact.master_ids = {3};
  const PairedNodes found =
    node_to_node_row.pair(contact, {high.get(), low.get()});
  ASSERT_EQ(found.nodes.size(), 4u);
  for (const ContactNode &node : found.nodes)
    {
      EXPECT_EQ(node.gap, .5);
      EXPECT_EQ(node.n[1], 1);
      ASSERT_EQ(node.masters.size(), 1u);
      EXPECT_EQ(low->position(node.masters[0].first)[0], node.position[0]);
    }
}
