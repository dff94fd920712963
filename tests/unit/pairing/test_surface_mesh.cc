// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/errors.h"
#include "conetact/pairing/surface_files.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>

#include "files.h"
#include "obstacle_fixture.h"

using namespace conetact;
using namespace conetact::pairing;

namespace
{
  /** A tetrahedron with its corners at the origin and 1 along each axis. */
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                  "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

  const std::string cube =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5/1 6/2 8/3 7/4\nf 1 2 6 5 # front\nf -6 -2 8 4\n";

  std::string
  path(const std::string &name, const std::string &text)
  {
    return (test::folder() / test::write_file(name, text)).string();
  }

  Obstacle
  mesh(const std::string &name, const std::string &text, const unsigned dim = 3)
  {
    return make_obstacle("Shape = surface mesh|File = " + path(name, text),
                         dim);
  }

  std::string
  refused(const std::string &name,
          const std::string &text,
          const unsigned     dim = 3)
  {
    try
      {
        mesh(name, text, dim);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  void
  expect_says(const std::string &sentence, const std::string &part)
  {
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  }

  std::string
  msh_of_square(const std::string &lines)
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n"
           "2 1 0 0\n7 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n5\n"
           "1 15 2 0 1 1\n" +
           lines + "$EndElements\n";
  }
} // namespace



TEST(SurfaceMesh, IsTheSolidInside)
{
  const Obstacle solid = mesh("solid.obj", tetrahedron);
  const auto     below = solid.shape->closest({.2, .2, -.5}, 1);
  EXPECT_NEAR(below.gap, .5, 1e-15);
  EXPECT_NEAR(below.normal[2], -1, 1e-15);
  const auto inside = solid.shape->closest({.2, .3, .05}, 1);
  EXPECT_NEAR(inside.gap, -.05, 1e-15);
  EXPECT_NEAR(inside.normal[2], -1, 1e-15);
  // a corner and an edge: the direction to the node
  const auto corner = solid.shape->closest({3, 0, -2}, 1);
  EXPECT_NEAR(corner.gap, std::sqrt(8.), 1e-14);
  EXPECT_NEAR(corner.normal[0], std::sqrt(.5), 1e-14);
  const auto edge = solid.shape->closest({.5, -.3, -.4}, 1);
  EXPECT_NEAR(edge.gap, .5, 1e-15);
  EXPECT_NEAR(edge.normal[1], -.6, 1e-14);
  // on them: between the faces
  const auto on = solid.shape->closest({.5, 0, 0}, 1);
  EXPECT_EQ(on.gap, 0);
  EXPECT_NEAR(on.normal[1], -std::sqrt(.5), 1e-14);
}



TEST(SurfaceMesh, OfQuadrilateralsIsABox)
{
  const Obstacle faces =
    mesh("cube.obj", cube + "f 1 5 7 3\nf 2 4 8 6\n# v 1\n");
  const Obstacle box =
    make_obstacle("Shape = box|Center = 0.5, 0.5, 0.5|Sizes = 1, 1, 1", 3);
  std::mt19937                           engine(1);
  std::uniform_real_distribution<double> x(-1, 2);
  for (unsigned int i = 0; i < 500; ++i)
    {
      const Point<3> p(x(engine), x(engine), x(engine));
      const auto     a = faces.shape->closest(p, 1);
      const auto     b = box.shape->closest(p, 1);
      EXPECT_NEAR(a.gap, b.gap, 1e-13) << p;
      EXPECT_LE((a.normal - b.normal).norm(), 1e-12) << p;
    }
}



TEST(SurfaceMesh, InThePlaneIsOfLines)
{
  const Obstacle square =
    mesh("square.msh",
         msh_of_square(
           "2 1 2 0 1 1 2\n3 1 2 0 1 2 7\n4 1 2 0 1 7 4\n5 1 2 0 1 4 1\n"),
         2);
  EXPECT_NEAR(square.shape->closest({.3, -2, 0}, 1).gap, 2, 1e-15);
  EXPECT_NEAR(square.shape->closest({.3, .2, 0}, 1).gap, -.2, 1e-15);
  EXPECT_NEAR(square.shape->closest({4, 5, 0}, 1).normal[1], .8, 1e-15);
  const std::string inward = msh_of_square(
    "2 1 2 0 1 2 1\n3 1 2 0 1 7 2\n4 1 2 0 1 4 7\n5 1 2 0 1 1 4\n");
  expect_says(refused("inward.msh", inward, 2), "has its normals inside out");
  expect_says(refused("rim.msh",
                      msh_of_square("2 1 2 0 1 1 2\n3 1 2 0 1 2 7\n"
                                    "4 1 2 0 1 7 4\n5 15 2 0 1 4\n"),
                      2),
              "is open: it has a rim at (0, ");
  expect_says(refused("twisted.msh",
                      msh_of_square("2 1 2 0 1 1 2\n3 1 2 0 1 7 2\n"
                                    "4 1 2 0 1 7 4\n5 1 2 0 1 4 1\n"),
                      2),
              "run in opposite senses");
  expect_says(refused("solid.obj", tetrahedron, 2), "has points outside");
}



TEST(SurfaceMesh, ReadsBothKindsOfStl)
{
  const std::array<std::array<float, 9>, 4> facets = {
    {{{0, 0, 0, 0, 1, 0, 1, 0, 0}},
     {{0, 0, 0, 1, 0, 0, 0, 0, 1}},
     {{0, 0, 0, 0, 0, 1, 0, 1, 0}},
     {{1, 0, 0, 0, 1, 0, 0, 0, 1}}}};
  std::string binary = "solid by its first word" + std::string(57, ' ');
  std::string ascii  = "solid\n";
  binary += std::string("\4\0\0\0", 4);
  for (const auto &x : facets)
    {
      std::string facet(50, '\0');
      std::memcpy(&facet[12], x.data(), sizeof(x));
      binary += facet;
      ascii += "facet normal 0 0 0\nouter loop\n";
      for (unsigned int i = 0; i < 3; ++i)
        ascii += "vertex " + std::to_string(x.at(3 * i)) + " " +
                 std::to_string(x.at(3 * i + 1)) + " " +
                 std::to_string(x.at(3 * i + 2)) + "\n";
      ascii += "endloop\nendfacet\n";
    }
  for (const std::string &text : {binary, ascii + "endsolid\n"})
    {
      const SurfaceFaces faces =
        read_surface(path("both.stl", text), 3, "File");
      EXPECT_EQ(faces.points.size(), 4u);
      EXPECT_EQ(faces.faces.size(), 4u);
      EXPECT_NEAR(mesh("both.stl", text).shape->closest({.1, .1, -3}, 1).gap,
                  3,
                  1e-15);
    }
  binary.pop_back();
  binary[0] = 'S';
  expect_says(refused("short.stl", binary), "neither begins with 'solid' nor");
  expect_says(refused("text.stl", ascii + "facet\nvertex 0 0 nan\n"),
              "it ends in the middle of a facet");
  expect_says(refused("nan.stl",
                      ascii + "facet\nvertex 0 0 nan\nvertex 0 1 0\n"
                              "vertex 1 0 0\nendfacet\n"),
              "is not a finite number");
  expect_says(refused("word.stl", ascii + "vertex 0 zero 0\n"),
              "'zero' stands there instead of a number");
}



TEST(SurfaceMesh, RefusesWhatHasNoInside)
{
  const auto without_last = [](const std::string &text) {
    return text.substr(0, text.rfind("f "));
  };
  expect_says(refused("open.obj", without_last(tetrahedron)),
              "is open: it has a rim at ");
  expect_says(refused("twisted.obj", without_last(tetrahedron) + "f 2 4 3\n"),
              "corners run in opposite senses at ");
  expect_says(refused("three.obj", tetrahedron + "v 1 1 1\nf 2 3 5\n"),
              "has more than two faces that meet at ");
  std::string inward = tetrahedron;
  for (std::size_t f = inward.find("f "); f != std::string::npos;
       f             = inward.find("f ", f + 1))
    std::swap(inward[f + 4], inward[f + 6]);
  expect_says(refused("inward.obj", inward), "has its normals inside out");
  expect_says(refused("needle.obj", tetrahedron + "v 2 0 0\nf 1 2 5\n"),
              "has a face without area at ");
  expect_says(refused("empty.obj", ""), "it is empty or cannot be read");
  expect_says(refused("points.obj", "v 0 0 0\n"),
              "it has no triangles or quadrilaterals");
  expect_says(refused("far.obj", tetrahedron + "f 1 2 9\n"),
              "a face names the vertex '9', one of 4");
  expect_says(refused("binary.msh", "$MeshFormat\n2.2 1 8\n"),
              "section 'MeshFormat' does not end");
  expect_says(refused("cut.msh",
                      msh_of_square("2 1 2 0 1 1 2\n").substr(0, 130)),
              "a surface: ");
}
