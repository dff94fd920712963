// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/cell_topology.h"
#include "conetact/base/middle_nodes.h"
#include "conetact/base/unv_file.h"

#include <gtest/gtest.h>

#include <sstream>

namespace conetact::test
{
  namespace
  {
    /** An element whose nodes stand at these places, in this order. */
    std::string
    file_of(const unsigned int kind, const std::vector<Point<3>> &places)
    {
      std::ostringstream text;
      text << "    -1\n  2411\n";
      for (std::size_t i = 0; i < places.size(); ++i)
        text << i + 1 << " 1 1 11\n"
             << places[i][0] << "D0 " << places[i][1] << " " << places[i][2]
             << "\n";
      text << "    -1\n    -1\n  2412\n5 " << kind << " 2 1 7 "
           << places.size();
      for (std::size_t i = 0; i < places.size(); ++i)
        text << (i % 8 == 0 ? "\n" : " ") << i + 1;
      text << "\n    -1\n    -1\n  2467\n1 0 0 0 0 0 0 2\nbody of it\n"
              "8 5 0 0 7 1 0 0\n    -1\n";
      return text.str();
    }

    Point<3>
    middle(const Point<3> &a, const Point<3> &b)
    {
      return Point<3>((a + Tensor<1, 3>(b)) / 2);
    }
  } // namespace

  /* Round the bottom corner by middle, then up, then round the top. */
  TEST(UnvFile, MiddleNodesStandBetweenTheirCorners)
  {
    const std::vector<Point<3>> bottom = {{0, 0, 0},
                                          {2, 0, 0},
                                          {2, 1, 0},
                                          {0, 1, 0}};
    const auto up = [](const Point<3> &p) { return Point<3>(p[0], p[1], 3); };
    std::map<unsigned int, std::vector<Point<3>>> kinds;
    for (const auto &[kind, n] : {std::pair(113u, 3u), std::pair(116u, 4u)})
      {
        std::vector<Point<3>> low, between, high;
        for (unsigned int i = 0; i < n; ++i)
          {
            const Point<3> &p = bottom[i], &q = bottom[(i + 1) % n];
            low.insert(low.end(), {p, middle(p, q)});
            between.push_back(middle(p, up(p)));
            high.insert(high.end(), {up(p), middle(up(p), up(q))});
          }
        low.insert(low.end(), between.begin(), between.end());
        low.insert(low.end(), high.begin(), high.end());
        kinds[kind] = low;
      }
    const Point<3> a = bottom[0], b = bottom[1], c = bottom[2], d(0, 0, 3);
    kinds[118] = {a,
                  middle(a, b),
                  b,
                  middle(b, c),
                  c,
                  middle(c, a),
                  middle(a, d),
                  middle(b, d),
                  middle(c, d),
                  d};
    for (const auto &[kind, places] : kinds)
      {
        const FileMesh mesh = read_unv(file_of(kind, places));
        ASSERT_EQ(mesh.elements.size(), 1u);
        EXPECT_EQ(mesh.names.at({3, own_numbers}), "body of it");
        const FileMesh::Element &cell = mesh.elements[0];
        const MiddleNodes        middles(mesh, {&cell});
        for (const auto &edge : topology_of(3, cell.nodes.size()).edges)
          {
            const unsigned int i = cell.nodes[edge[0]], j = cell.nodes[edge[1]];
            EXPECT_LT(middles.between(i, j).distance(
                        middle(mesh.points[i], mesh.points[j])),
                      1e-15)
              << kind;
          }
      }
  }

  TEST(UnvFile, FaultsSayTheLine)
  {
    const std::string right =
      file_of(111, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    const auto fault_of = [&](const std::string &part, const std::string &by) {
      std::string wrong = right;
      wrong.replace(wrong.find(part), part.size(), by);
      try
        {
          read_unv(wrong);
        }
      catch (const FileFault &fault)
        {
          return fault.why;
        }
      return std::string();
    };
    EXPECT_EQ(fault_of("\n1 2 3 4\n", "\n1 2 3 9\n"),
              "line 15: the node 9 is not there");
    EXPECT_EQ(fault_of("5 111 ", "5 199 "),
              "line 15: elements of the kind 199 are not known");
    EXPECT_EQ(fault_of("8 5 0 0 ", "8 6 0 0 "),
              "line 21: the group 'body of it' has the element 6, which is not "
              "there");
  }
} // namespace conetact::test
