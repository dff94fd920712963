// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/cell_splitting.h"
#include "conetact/base/cell_topology.h"
#include "conetact/base/joined_points.h"
#include "conetact/base/middle_nodes.h"
#include "conetact/base/vtk_middles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace conetact::test
{
  namespace
  {
    /** The corners of a cell of unit edges, in Gmsh's order. */
    std::vector<Point<3>>
    corners(const std::size_t n)
    {
      if (n == 4)
        return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      if (n == 5)
        return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
      if (n == 6)
        return {
          {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
      return {{0, 0, 0},
              {1, 0, 0},
              {1, 1, 0},
              {0, 1, 0},
              {0, 0, 1},
              {1, 0, 1},
              {1, 1, 1},
              {0, 1, 1}};
    }

    double
    volume(const FileMesh &mesh, const FileMesh::Element &t)
    {
      const Point<3> &p = mesh.points[t.nodes[0]];
      return cross_product_3d(mesh.points[t.nodes[1]] - p,
                              mesh.points[t.nodes[2]] - p) *
             (mesh.points[t.nodes[3]] - p) / 6;
    }

    std::vector<const FileMesh::Element *>
    pointers(const std::vector<FileMesh::Element> &elements)
    {
      std::vector<const FileMesh::Element *> result;
      for (const FileMesh::Element &element : elements)
        result.push_back(&element);
      return result;
    }
  } // namespace

  /* However its nodes are numbered, a cell is filled by its pieces, and each
     quadrilateral is cut through its smallest number. */
  TEST(CellSplitting, PiecesFillCells)
  {
    std::mt19937                        random(1);
    const std::map<std::size_t, double> volumes = {{4, 1. / 6},
                                                   {5, 1. / 3},
                                                   {6, 1. / 2},
                                                   {8, 1}};
    for (const auto &[n, whole] : volumes)
      for (unsigned int k = 0; k < 200; ++k)
        {
          FileMesh                  mesh;
          const auto                places = corners(n);
          std::vector<unsigned int> order(n);
          std::iota(order.begin(), order.end(), 0u);
          std::shuffle(order.begin(), order.end(), random);
          mesh.points.resize(n);
          for (unsigned int i = 0; i < n; ++i)
            mesh.points[order[i]] = places[i];
          mesh.elements = {{3, order, {7}}};
          const auto pieces =
            split_into_simplices(mesh, pointers(mesh.elements), false);
          double sum = 0;
          for (const FileMesh::Element &piece : pieces)
            {
              EXPECT_GT(volume(mesh, piece), 0);
              EXPECT_EQ(piece.groups, std::set<unsigned int>{7});
              sum += volume(mesh, piece);
            }
          EXPECT_NEAR(sum, whole, 1e-14);
          for (const auto &quad : topology_of(3, n).quads)
            {
              std::vector<unsigned int> face;
              for (const unsigned int i : quad)
                face.push_back(order[i]);
              const auto low = static_cast<std::size_t>(
                std::min_element(face.begin(), face.end()) - face.begin());
              const unsigned int a = face[(low + 1) % 4],
                                 b = face[(low + 3) % 4];
              for (const FileMesh::Element &piece : pieces)
                EXPECT_FALSE(
                  std::count(piece.nodes.begin(), piece.nodes.end(), a) &&
                  std::count(piece.nodes.begin(), piece.nodes.end(), b));
            }
        }
  }

  TEST(VtkMiddles, StandWhereTheirEdgesAndFacesAre)
  {
    FileMesh mesh;
    mesh.points   = {{0, 0, 0},
                     {2, 0, 0},
                     {2, 2, 0},
                     {0, 2, 0},
                     {0, 0, 3},
                     {2, 0, 3},
                     {2, 2, 3},
                     {0, 2, 3}};
    mesh.elements = {{3, {0, 1, 2, 3, 4, 5, 6, 7}, {}}};
    // in an order of their own, the first one off its edge
    for (const Point<3> &p : {Point<3>(1, -.2, 0),
                              Point<3>(2, 1, 0),
                              Point<3>(1, 2, 0),
                              Point<3>(0, 1, 0),
                              Point<3>(1, 0, 3),
                              Point<3>(2, 1, 3),
                              Point<3>(1, 2, 3),
                              Point<3>(0, 1, 3),
                              Point<3>(0, 0, 1.5),
                              Point<3>(2, 0, 1.5),
                              Point<3>(2, 2, 1.5),
                              Point<3>(0, 2, 1.5)})
      {
        mesh.elements[0].middles.push_back(
          static_cast<unsigned int>(mesh.points.size()));
        mesh.points.push_back(p);
      }
    arrange_middles_of_vtk(mesh);
    // Gmsh: 01 03 04 12 15 23 26 37 45 47 56 67
    EXPECT_EQ(mesh.elements[0].middles,
              (std::vector<unsigned int>{
                8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14}));
  }

  TEST(CellSplitting, FoldedCellsAreRefused)
  {
    FileMesh mesh;
    mesh.points = corners(6);
    std::swap(mesh.points[4], mesh.points[5]);
    mesh.elements = {{3, {0, 1, 2, 3, 4, 5}, {}}};
    EXPECT_TRUE(are_mixed(pointers(mesh.elements)));
    EXPECT_THROW(split_into_simplices(mesh, pointers(mesh.elements), false),
                 FileFault);
  }

  TEST(CellSplitting, HexahedraAloneStay)
  {
    FileMesh mesh;
    mesh.points   = corners(8);
    mesh.elements = {{3, {0, 1, 2, 3, 4, 5, 6, 7}, {}}};
    EXPECT_FALSE(are_mixed(pointers(mesh.elements)));
    mesh.elements.push_back({3, {0, 1, 2, 5}, {}});
    EXPECT_TRUE(are_mixed(pointers(mesh.elements)));
    mesh.elements = {{3, {0, 1, 2, 2, 4, 5, 6, 6}, {}}}; // a wedge
    EXPECT_TRUE(are_mixed(pointers(mesh.elements)));
    double sum = 0;
    for (const auto &piece :
         split_into_simplices(mesh, pointers(mesh.elements), false))
      sum += volume(mesh, piece);
    EXPECT_NEAR(sum, .5, 1e-15);
  }

  /* A field of second degree has its values at the nodes that are added. */
  TEST(MiddleNodes, HexahedraOf20NodesGetTheOthers)
  {
    FileMesh mesh;
    mesh.points = corners(8);
    FileMesh::Element cell{3, {0, 1, 2, 3, 4, 5, 6, 7}, {}, {}};
    const auto        bent = [](const Point<3> &p) {
      return Point<3>(p[0] + .1 * p[1] * p[1], p[1], p[2] - .2 * p[0] * p[2]);
    };
    for (const auto &edge : topology_of(3, 8).edges)
      {
        cell.middles.push_back(static_cast<unsigned int>(mesh.points.size()));
        mesh.points.push_back(Point<3>(
          (mesh.points[edge[0]] + Tensor<1, 3>(mesh.points[edge[1]])) / 2));
      }
    for (Point<3> &p : mesh.points)
      p = bent(p);
    mesh.elements = {cell};
    const MiddleNodes middles(mesh, pointers(mesh.elements));
    EXPECT_LT(middles.between(1, 0).distance(bent({.5, 0, 0})), 1e-15);
    EXPECT_LT(middles.between(0, 2).distance(bent({.5, .5, 0})), 1e-15);
    EXPECT_LT(middles.between(5, 2).distance(bent({1, .5, .5})), 1e-15);
    EXPECT_LT(middles.between(1, 7).distance(bent({.5, .5, .5})), 1e-15);
  }

  TEST(JoinedPoints, PointsOfOnePlaceAreOne)
  {
    FileMesh mesh;
    mesh.points   = {{0, 0, 0},
                     {1, 0, 0},
                     {0, 1, 0},
                     {1 + 1e-9, 0, 0},
                     {0, 1, 1e-9},
                     {1, 1, 0}};
    mesh.elements = {{2, {0, 1, 2}, {}}, {2, {3, 5, 4}, {}}};
    EXPECT_EQ(join_points(mesh, 1e-10), 0u);
    EXPECT_EQ(join_points(mesh, 1e-6), 2u);
    EXPECT_EQ(mesh.elements[1].nodes, (std::vector<unsigned int>{1, 5, 2}));
  }
} // namespace conetact::test
