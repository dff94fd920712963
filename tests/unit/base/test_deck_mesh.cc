// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/deck_elements.h"
#include "conetact/base/deck_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace conetact::test
{
  namespace
  {
    const std::string cube =
      "*NODE\n1,0,0,0\n2,1.D0,0,0\n3,1,1,0\n4,0,1,\n5,0,0,1\n6,1,0,1\n"
      "7,1,1,1\n8,0,1,1\n*Element, type=C3D8R, elset=Solid\n"
      "1, 1,2,3,4,\n5,6,7,8\n";

    /** Corners of the faces of a group, by coordinates. */
    std::vector<std::set<std::vector<double>>>
    faces_of(const FileMesh &mesh, const std::string &name)
    {
      std::vector<std::set<std::vector<double>>> faces;
      for (const auto &[key, known] : mesh.names)
        if (known == name)
          for (const FileMesh::Element &element : mesh.elements)
            if (element.dim == key.first && element.groups.count(key.second))
              {
                faces.emplace_back();
                for (const unsigned int i : element.nodes)
                  faces.back().insert(
                    {mesh.points[i][0], mesh.points[i][1], mesh.points[i][2]});
              }
      return faces;
    }

    std::string
    fault_of(const std::string &deck)
    {
      try
        {
          read_deck(deck, "deck.inp");
        }
      catch (const FileFault &fault)
        {
          return fault.why;
        }
      return "";
    }
  } // namespace

  TEST(DeckMesh, SidesOfElementsAndSetsOfNodesAreFaces)
  {
    const FileMesh mesh = read_deck(
      "** a cube\n*Heading\n" + cube +
        "*NSET, NSET=top, GENERATE\n5, 8, 1\n*NSET,NSET=all\ntop,1,2,3,4\n"
        "*SURFACE, NAME=left\nsolid, S6\n*SURFACE, TYPE=NODE, NAME=above\n"
        "TOP\n*SURFACE, NAME=\"a skin\"\nSolid\n*Step\n*End Step\n",
      "deck.inp");
    ASSERT_EQ(mesh.points.size(), 8u);
    EXPECT_EQ(mesh.elements[0].nodes,
              (std::vector<unsigned int>{0, 1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(mesh.names.at({3, *mesh.elements[0].groups.begin()}), "Solid");
    for (const char *name : {"top", "above"})
      {
        const auto faces = faces_of(mesh, name);
        ASSERT_EQ(faces.size(), 1u) << name;
        for (const auto &corner : faces[0])
          EXPECT_EQ(corner[2], 1);
      }
    const auto left = faces_of(mesh, "left");
    ASSERT_EQ(left.size(), 1u);
    for (const auto &corner : left[0])
      EXPECT_EQ(corner[0], 0);
    EXPECT_EQ(faces_of(mesh, "a skin").size(), 6u);
    EXPECT_EQ(faces_of(mesh, "all").size(), 6u);
    ASSERT_EQ(mesh.notes.size(), 1u);
    EXPECT_NE(mesh.notes[0].find("*STEP"), std::string::npos);
  }

  TEST(DeckMesh, InstancesOfAPartStandWhereTheyAreSaid)
  {
    const FileMesh mesh =
      read_deck("*PART, NAME=Cube\n" + cube +
                  "*SURFACE, NAME=low\n1, S1\n*END PART\n*ASSEMBLY, NAME=a\n"
                  "*INSTANCE, NAME=one, PART=cube\n*END INSTANCE\n"
                  "*INSTANCE, NAME=two, PART=Cube\n2, 0, 0\n2,0,0, 2,0,1, 90\n"
                  "*END INSTANCE\n*NSET, NSET=ends, INSTANCE=two\n1,4,5,8\n"
                  "*ELSET, ELSET=both\none.1, two.SOLID\n*END ASSEMBLY\n",
                "deck.inp");
    ASSERT_EQ(mesh.elements.size(), 5u); // two cells, two faces, ends
    EXPECT_EQ(faces_of(mesh, "low").size(), 2u);
    EXPECT_EQ(faces_of(mesh, "one.low").size(), 1u);
    EXPECT_EQ(faces_of(mesh, "both").size(), 2u);
    // turned about the line x = 2, y = 0: (x, y) to (2 - y, x - 2)
    const auto ends = faces_of(mesh, "ends");
    ASSERT_EQ(ends.size(), 1u);
    for (const auto &corner : ends[0])
      {
        EXPECT_NEAR(corner[1], 0, 1e-15);
        EXPECT_TRUE(std::abs(corner[0] - 2) < 1e-15 ||
                    std::abs(corner[0] - 1) < 1e-15);
      }
    const auto cells = faces_of(mesh, "two");
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_EQ(cells[0].size(), 8u);
  }

  TEST(DeckMesh, ElementsAreKnownByTheirNames)
  {
    const auto expect = [](const char *type, unsigned int dim, std::size_t n) {
      const auto kind = deck_kind(type);
      ASSERT_TRUE(kind) << type;
      EXPECT_EQ(kind->dim, dim) << type;
      EXPECT_EQ(kind->n_nodes, n) << type;
    };
    expect("C3D4", 3, 4);
    expect("C3D6", 3, 6);
    expect("C3D8I", 3, 8);
    expect("C3D10MH", 3, 10);
    expect("C3D15", 3, 15);
    expect("C3D20R", 3, 20);
    expect("CPS3", 2, 3);
    expect("CPE4RH", 2, 4);
    expect("CAX8R", 2, 8);
    expect("CPS6", 2, 6);
    expect("S4R", 2, 4);
    expect("S8R5", 2, 8);
    expect("STRI65", 2, 6);
    expect("B31", 1, 2);
    expect("B32R", 1, 3);
    expect("T2D2", 1, 2);
    expect("SPRINGA", 0, 0);
    EXPECT_FALSE(deck_kind("C3D9"));
    EXPECT_FALSE(deck_kind("CPX4"));
  }

  TEST(DeckMesh, FaultsSayTheLine)
  {
    EXPECT_EQ(fault_of("1, 2\n"),
              "line 1: a keyword such as *NODE must come first");
    EXPECT_EQ(fault_of(cube + "*ELEMENT, TYPE=C3D4\n2, 1, 2, 3\n"),
              "line 13: the element 2 has 3 nodes, but a C3D4 has 4");
    EXPECT_EQ(fault_of(cube + "*SURFACE, NAME=a\n1, S7\n"),
              "line 13: 'S7' is no side of such an element. Sides are called "
              "S1, S2 and so on");
  }
} // namespace conetact::test
