// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/continuum.h"

#include <deal.II/grid/tria.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "body_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::test;

namespace
{
  const char *const square = "Generator = subdivided_hyper_rectangle|"
                             "Arguments = 3, 2 : 0, 0 : 3, 1 : true";
  const char *const brick  = "Generator = subdivided_hyper_rectangle|"
                             "Arguments = 3, 2, 2 : 0, 0, 0 : 3, 1, 1 : true";
  const char *const ball   = "Generator = hyper_ball|"
                             "Arguments = 0, 0, 0 : 1 : false|"
                             "Global refinements = 1|"
                             "Refinement boxes = -1, -1, -1 : 0, 0, -0.7 : 2";
  const char *const disk   = "Generator = hyper_ball|"
                             "Arguments = 0, 0 : 1 : false|"
                             "Global refinements = 2|"
                             "Refinement boxes = -1, -1 : 1, -0.8 : 2";

  /**
   * Bodies of all sorts: congruent, distorted, curved, with hanging nodes, of
   * all elements, in plane strain and plane stress.
   */
  std::vector<std::unique_ptr<Structure>>
  all_bodies()
  {
    const std::vector<std::pair<unsigned int, std::string>> meshes = {
      {2, square},
      {3, brick},
      {2, "File = " + write_distorted_mesh(2, 4)},
      {3, "File = " + write_distorted_mesh(3, 3)},
      {2, disk},
      {3, ball}};
    std::vector<std::unique_ptr<Structure>> all;
    for (const auto &row : element_table<2>())
      for (const auto &[dim, mesh] : meshes)
        for (const std::string plane : {"strain", "stress"})
          if ((dim == 2 || plane == "strain") &&
              (!row.is_simplex || (mesh.find("boxes") == std::string::npos &&
                                   (dim == 2 || row.degree == 1))))
            all.push_back(
              make_body(dim,
                        mesh,
                        "Young modulus = 5|Poisson ratio = 0.3|Plane = " +
                          plane,
                        row.name));
    return all;
  }

  std::set<unsigned int>
  boundary_nodes(const Structure &body)
  {
    std::set<unsigned int> nodes;
    for (const SurfaceFace &face : body.surface(body.boundary_ids()).faces)
      nodes.insert(face.nodes.begin(), face.nodes.end());
    return nodes;
  }

  double
  area(const Surface &surface)
  {
    double sum = 0;
    for (const SurfaceNode &node : surface.nodes)
      sum += node.area;
    return sum;
  }
} // namespace


TEST(Continuum, ElementsOfSomeNodesAreThoseThatHaveThem)
{
  for (const auto &body : all_bodies())
    {
      SomeNodes nodes(body->n_nodes(), false);
      for (unsigned int i = 0; i < body->n_nodes(); i += 5)
        nodes[i] = true;
      using Elements = std::vector<std::vector<unsigned int>>;
      Elements   own, of_all, connections;
      const auto into = [](Elements &list) {
        return [&](const std::vector<unsigned int> &dofs, const double *) {
          list.push_back(dofs);
        };
      };
      body->elements().for_each_at(nodes, into(own));
      body->elements().Elements::for_each_at(nodes, into(of_all));
      body->elements().for_each_connection_at(nodes, [&](const auto &dofs) {
        connections.push_back(dofs);
      });
      EXPECT_EQ(own, of_all);
      EXPECT_EQ(own, connections);

      const Eigen::VectorXd u = Eigen::VectorXd::Random(body->n_dofs());
      Eigen::VectorXd       f = Eigen::VectorXd::Zero(u.size()), some = f;
      body->elements().add_forces(u, f);
      EXPECT_EQ(body->elements().add_forces_at(nodes, u, some), own.size());
      for (Eigen::Index dof = 0; dof < u.size(); ++dof)
        if (nodes[static_cast<unsigned int>(dof) / body->n_components()])
          {
            EXPECT_NEAR(some[dof], f[dof], 1e-13 * f.cwiseAbs().maxCoeff());
          }
    }
}


TEST(Continuum, RigidMotionsMeetNoForce)
{
  for (const auto &body : all_bodies())
    {
      const unsigned int    dim = body->n_components();
      const Eigen::VectorXd u   = interpolate(*body, [dim](const Point<3> &x) {
        const Tensor<1, 3> w({dim == 3 ? .3 : 0., dim == 3 ? -.7 : 0., .5});
        return Tensor<1, 3>({1, 2, 3}) + cross_product_3d(w, x);
      });
      const double          scale = stiffness(*body).diagonal().maxCoeff();
      EXPECT_LE((stiffness(*body) * u).cwiseAbs().maxCoeff(), 3e-14 * scale)
        << body->description();
    }
}

TEST(Continuum, UniformStrainIsExact)
{
  for (const auto &body : all_bodies())
    {
      const Eigen::VectorXd u = interpolate(*body, [](const Point<3> &x) {
        return Tensor<1, 3>({.3 * x[0] + .1 * x[1] + .4 * x[2],
                             -.2 * x[0] + .5 * x[1],
                             .6 * x[1] - .1 * x[2]});
      });
      const Eigen::VectorXd f = internal_forces(*body, u);
      const std::set<unsigned int> outer = boundary_nodes(*body);
      double                       worst = 0;
      for (unsigned int i = 0; i < body->n_nodes(); ++i)
        if (outer.count(i) == 0)
          worst =
            std::max(worst,
                     f.segment(body->n_components() * i, body->n_components())
                       .cwiseAbs()
                       .maxCoeff());
      EXPECT_LE(worst, 1e-13 * f.cwiseAbs().maxCoeff()) << body->description();
    }
}

TEST(Continuum, ElementsAreExactlySymmetric)
{
  for (const auto &body : all_bodies())
    body->elements().for_each(
      [](const std::vector<unsigned int> &dofs, const double *matrix) {
        for (std::size_t i = 0; i < dofs.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            ASSERT_EQ(matrix[i * dofs.size() + j], matrix[j * dofs.size() + i]);
      });
}

TEST(Continuum, TranslationsMeetNoForceToTheLastBit)
{
  for (const auto &body : all_bodies())
    {
      const unsigned int dim = body->n_components();
      body->elements().for_each(
        [&](const std::vector<unsigned int> &dofs, const double *matrix) {
          for (std::size_t i = 0; i < dofs.size(); ++i)
            for (unsigned int c = 0; c < dim; ++c)
              {
                double force = 0;
                for (std::size_t j = c; j < dofs.size(); j += dim)
                  force += matrix[i * dofs.size() + j];
                ASSERT_EQ(force, 0.) << body->description();
              }
        });
    }
  for (const auto &[dim, mesh] : {std::pair{2u, square}, std::pair{3u, brick}})
    {
      const auto body = make_body(dim, mesh);
      for (unsigned int c = 0; c < dim; ++c)
        {
          const Eigen::VectorXd u = interpolate(*body, [c](const Point<3> &) {
            Tensor<1, 3> along;
            along[c] = 1;
            return along;
          });
          EXPECT_EQ((stiffness(*body) * u).cwiseAbs().maxCoeff(), 0.);
        }
    }
}

TEST(Continuum, OnlyRigidMotionsNeedNoEnergy)
{
  for (const auto &body : all_bodies())
    {
      const Eigen::Index n_rigid = body->n_components() == 2 ? 3 : 6;
      // the more modes a cell has, the further apart their energies
      const double least =
        body->description().find("P2") != std::string::npos ? 1e-4 : 1e-3;
      body->elements().for_each(
        [&](const std::vector<unsigned int> &dofs, const double *matrix) {
          const auto            n = static_cast<Eigen::Index>(dofs.size());
          const Eigen::VectorXd energies =
            Eigen::Map<const Eigen::MatrixXd>(matrix, n, n)
              .selfadjointView<Eigen::Lower>()
              .eigenvalues();
          ASSERT_LE(std::abs(energies[n_rigid - 1]), 1e-13 * energies[n - 1]);
          ASSERT_GE(energies[n_rigid], least * energies[n - 1])
            << body->description();
        });
    }
}

TEST(Continuum, StretchMeetsTheStressOfThePlane)
{
  const double E = 5, nu = .3, strain = .01, thickness = 2.5;
  const auto   pull =
    [&](const unsigned int dim, const char *mesh, const std::string &plane) {
      const auto            body = make_body(dim,
                                  mesh,
                                  "Young modulus = 5|Poisson ratio = 0.3|"
                                             "Thickness = 2.5|Plane = " +
                                    plane);
      const Eigen::VectorXd f =
        stiffness(*body) * interpolate(*body, [&](const Point<3> &x) {
          return Tensor<1, 3>({strain * x[0], 0, 0});
        });
      double force = 0;
      for (const SurfaceNode &node : body->surface({1}).nodes)
        force += f[body->n_components() * node.node];
      return force;
    };
  const double stress = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) * strain;
  EXPECT_NEAR(pull(2, square, "strain"), stress * thickness, 1e-14);
  EXPECT_NEAR(pull(2, square, "stress"),
              E / (1 - nu * nu) * strain * thickness,
              1e-14);
  EXPECT_NEAR(pull(3, brick, "strain"), stress, 1e-14);
}

TEST(Continuum, BilinearFieldsHaveTheirEnergy)
{
  // u_x = x y, and x y z in 3D: strains that one Gauss point would not see
  const double E = 5, nu = .3, shear = E / (2 * (1 + nu));
  const double c11    = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  const auto   energy = [](const unsigned int dim, const std::string &mesh) {
    const auto            body = make_body(dim, mesh);
    const Eigen::VectorXd u    = interpolate(*body, [dim](const Point<3> &x) {
      return Tensor<1, 3>({x[0] * x[1] * (dim == 3 ? x[2] : 1), 0, 0});
    });
    return .5 * u.dot(stiffness(*body) * u);
  };
  const std::string one = "Generator = hyper_cube|Arguments = 0:1:true";
  EXPECT_NEAR(energy(2, one), .5 * (c11 + shear) / 3, 1e-15);
  EXPECT_NEAR(energy(3, one), .5 * (c11 + 2 * shear) / 9, 1e-15);
}

TEST(Continuum, CongruentCellsShareTheirMatrix)
{
  const auto shapes = [](const unsigned int dim, const std::string &mesh) {
    return make_body(dim, mesh)->elements().count().matrices;
  };
  const std::string fine = "Generator = subdivided_hyper_rectangle|"
                           "Arguments = 80, 40 : 0, 0 : 8, 4 : true";
  EXPECT_EQ(shapes(2, fine), 1);
  EXPECT_EQ(shapes(2, fine + "|Rotation = 37|Translation = 1e3, 7"), 1);
  EXPECT_EQ(shapes(2, fine + "|Refinement boxes = 0, 0 : .9, .9 : 2"), 3);
  EXPECT_EQ(shapes(3, std::string(brick) + "|Rotation = 1, 2, 3, 40"), 1);
  EXPECT_EQ(shapes(2, "File = " + write_distorted_mesh(2, 4)), 16);
  EXPECT_EQ(shapes(3, "File = " + write_distorted_mesh(3, 3)), 27);
}

TEST(Continuum, RotatedBodyHasRotatedStiffness)
{
  const auto   body   = make_body(2, square);
  const auto   turned = make_body(2, std::string(square) + "|Rotation = 30");
  const double c = std::sqrt(.75), s = .5;

  const Eigen::Matrix2d r = (Eigen::Matrix2d() << c, -s, s, c).finished();
  Eigen::MatrixXd       k = stiffness(*body);
  for (Eigen::Index i = 0; i < k.rows(); i += 2)
    for (Eigen::Index j = 0; j < k.cols(); j += 2)
      k.block<2, 2>(i, j) = r * k.block<2, 2>(i, j) * r.transpose();
  EXPECT_LE((stiffness(*turned) - k).cwiseAbs().maxCoeff(),
            1e-14 * k.maxCoeff());
}

TEST(Continuum, HangingNodesFollowLinearFields)
{
  for (const auto &body : all_bodies())
    for (const HangingNode &node : body->hanging_nodes())
      {
        Tensor<1, 3> position;
        double       sum = 0;
        for (const auto &[master, weight] : node.masters)
          {
            position += weight * Tensor<1, 3>(body->position(master));
            sum += weight;
            for (const HangingNode &other : body->hanging_nodes())
              EXPECT_NE(master, other.node);
          }
        EXPECT_NEAR(sum, 1, 1e-15);
        EXPECT_LE((position - body->position(node.node)).norm(), 1e-15);
      }
  EXPECT_GT(make_body(2, disk)->hanging_nodes().size(), 5);
  EXPECT_GT(make_body(3, ball)->hanging_nodes().size(), 50);
}

TEST(Continuum, SurfacesHaveAreasAndNormals)
{
  const auto box =
    make_body(3, std::string(brick) + "|Rotation = 1, 1, 1, 120|Scale = 2");
  const Surface top = box->surface({5}); // z = 1, turned to x = 2
  EXPECT_NEAR(area(top), 12, 1e-13);
  EXPECT_EQ(top.nodes.size(), 12);
  EXPECT_EQ(top.faces.size(), 6);
  for (const SurfaceNode &node : top.nodes)
    {
      EXPECT_NEAR(node.normal[0], 1, 1e-14);
      EXPECT_NEAR(node.position[0], 2, 1e-14);
      EXPECT_NEAR(box->position(node.node).distance(node.position), 0, 0);
    }
  // the nodes of an edge stand for two faces
  const Surface corner = box->surface({1, 5});
  EXPECT_NEAR(area(corner), 16, 1e-13);
  EXPECT_EQ(corner.nodes.size(), 12 + 9 - 3);

  const auto plate =
    make_body(2, square, "Young modulus=1|Poisson ratio=0|Thickness = 3");
  EXPECT_NEAR(area(plate->surface({2})), 9, 1e-14);
  EXPECT_NEAR(plate->surface({2}).nodes[0].area, 1.5, 1e-14);
  EXPECT_NEAR(plate->surface({2}).nodes[0].normal[1], -1, 1e-15);
}

TEST(Continuum, SurfaceOfBallWithHangingNodes)
{
  const auto             body    = make_body(3, ball);
  const Surface          surface = body->surface(body->boundary_ids());
  std::set<unsigned int> hanging;
  for (const HangingNode &node : body->hanging_nodes())
    hanging.insert(node.node);

  Eigen::VectorXd f = Eigen::VectorXd::Zero(body->n_dofs());
  body->add(Action::traction(body->boundary_ids(),
                             [&](const Point<3> &, const Tensor<1, 3> &) {
                               return Tensor<1, 3>({1, 0, 0});
                             }),
            f);
  const double exact = Sums(*body, f).force[0]; // of the straight-edged faces
  EXPECT_NEAR(area(surface), exact, 1e-13 * exact);
  EXPECT_NEAR(exact, 4 * dealii::numbers::PI, 1.5);
  for (const SurfaceNode &node : surface.nodes)
    {
      EXPECT_EQ(hanging.count(node.node), 0);
      EXPECT_GT(node.area, 0);
      EXPECT_NEAR(node.normal.norm(), 1, 1e-14);
      EXPECT_GT(node.normal * node.position, .9);
    }
}

TEST(Continuum, TractionsHaveTheirResultants)
{
  for (const auto &body : all_bodies())
    {
      // pressure all around, constant or of depth: Archimedes
      const unsigned int dim = body->n_components();
      const auto         all = body->boundary_ids();
      Eigen::VectorXd    f = Eigen::VectorXd::Zero(body->n_dofs()), g = f;
      body->add(Action::traction(
                  all, [](const auto &, const auto &n) { return -2. * n; }),
                f);
      EXPECT_LE(Sums(*body, f).force.norm(), 1e-13);
      EXPECT_LE(Sums(*body, f).moment.norm(), 1e-13);

      f.setZero();
      body->add(Action::traction(
                  all, [](const auto &x, const auto &n) { return x[1] * n; }),
                f);
      body->add(Action::body_force([](const auto &) {
                  return Tensor<1, 3>({0, 1, 0});
                }),
                g);
      EXPECT_LE((Sums(*body, f).force - Sums(*body, g).force).norm(), 1e-13);
      EXPECT_LE((Sums(*body, f).moment - Sums(*body, g).moment).norm(),
                dim == 2 ? 1e-13 : 1e-2); // faces of the ball are warped
    }
}

TEST(Continuum, LoadsCountTheThickness)
{
  const auto body =
    make_body(2, square, "Young modulus=1|Poisson ratio=0|Thickness = 3");
  Eigen::VectorXd f = Eigen::VectorXd::Zero(body->n_dofs());
  body->add(Action::traction({3},
                             [](const auto &x, const auto &) {
                               return Tensor<1, 3>({1, x[0] * x[0], 0});
                             }),
            f);
  EXPECT_NEAR(Sums(*body, f).force[0], 9, 1e-14);
  EXPECT_NEAR(Sums(*body, f).force[1], 27, 1e-13);
  EXPECT_NEAR(Sums(*body, f).moment[2], 81 * .75 - 9, 1e-13);
  f.setZero();
  body->add(Action::body_force([](const auto &x) {
              return Tensor<1, 3>({x[0], 0, 0});
            }),
            f);
  EXPECT_NEAR(Sums(*body, f).force[0], 13.5, 1e-13);
}

TEST(Continuum, PointForcesKeepForceAndMoment)
{
  const auto check = [](const Structure &body, const Point<3> &p) {
    Eigen::VectorXd    f = Eigen::VectorXd::Zero(body.n_dofs());
    const Tensor<1, 3> force({2, -3, body.n_components() == 3 ? 5. : 0.});
    EXPECT_TRUE(body.add(Action::point_force(p, force), f)) << p;
    EXPECT_LE((Sums(body, f).force - force).norm(), 1e-13) << p;
    EXPECT_LE(Sums(body, f, p).moment.norm(), 1e-11) << p;
  };
  const auto   plate = make_body(2, std::string(square) + "|Rotation = 30");
  const double c = std::sqrt(.75), s = .5;
  // inside, on an edge, at a vertex, on the boundary, at a corner
  for (const auto &[x, y] : std::vector<std::pair<double, double>>{
         {.3, .2}, {1.5, .5}, {2, .5}, {3, .7}, {1.2, 0}, {3, 1}, {0, 0}})
    check(*plate, Point<3>(c * x - s * y, s * x + c * y, 0));
  const auto cube = make_body(3, "File = " + write_distorted_mesh(3, 3));
  for (const double x : {0., .1, .5, 1.})
    check(*cube, Point<3>(x, .4, 1 - x));
  const auto sphere = make_body(3, ball);
  check(*sphere, Point<3>(0, 0, -1));
  check(*sphere, Point<3>(.1, .2, -.3));

  Eigen::VectorXd f = Eigen::VectorXd::Zero(plate->n_dofs());
  EXPECT_FALSE(plate->add(Action::point_force(Point<3>(9, 9, 0), {}), f));
  EXPECT_FALSE(plate->add(Action::point_force(Point<3>(.5, .5, 1), {}), f));
  EXPECT_FALSE(plate->add(Action::point_force(Point<3>(-.01, 0, 0), {}), f));
}

TEST(Continuum, SpringsResistTranslation)
{
  const auto body =
    make_body(2, square, "Young modulus=1|Poisson ratio=0|Thickness = 2");
  Eigen::VectorXd u       = interpolate(*body, [](const Point<3> &) {
    return Tensor<1, 3>({.1, .2, 0});
  });
  Eigen::VectorXd f       = Eigen::VectorXd::Zero(body->n_dofs());
  unsigned int    n_faces = 0;
  body->visit_springs(
    {2},
    [](const Point<3> &x, const Tensor<1, 3> &n) {
      return x[0] * outer_product(n, n);
    },
    [&](const std::vector<unsigned int> &dofs, const double *k) {
      ++n_faces;
      for (std::size_t i = 0; i < dofs.size(); ++i)
        for (std::size_t j = 0; j < dofs.size(); ++j)
          {
            f[dofs[i]] += k[i * dofs.size() + j] * u[dofs[j]];
            EXPECT_EQ(k[i * dofs.size() + j], k[j * dofs.size() + i]);
          }
    });
  EXPECT_EQ(n_faces, 3);
  EXPECT_NEAR(Sums(*body, f).force[0], 0, 0);
  EXPECT_NEAR(Sums(*body, f).force[1], .2 * 4.5 * 2, 1e-14);
}

TEST(Continuum, GraphicsAreWrittenOrRefused)
{
  const auto            body = make_body(2, disk);
  const Eigen::VectorXd u    = Eigen::VectorXd::Ones(body->n_dofs());
  write_graphics(*body, u, 2., folder() / "disk.vtu");
  std::ifstream     stream(folder() / "disk.vtu");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  for (const char *name : {"displacement", "stress", "von_mises", "TIME"})
    EXPECT_NE(text.find("\"" + std::string(name) + "\""), std::string::npos);
  EXPECT_THROW(write_graphics(*body, u, 2., folder() / "none" / "disk.vtu"),
               WriteError);
}
