// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/gmsh_file.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace conetact::test
{
  namespace
  {
    const std::string names = "$PhysicalNames\n2\n1 7 \"floor of it\"\n"
                              "2 3 \"steel\"\n$EndPhysicalNames\n";
    const std::string old_text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
      "$Nodes\n3\n1 0 0 0\n5 1 0 0\n9 0 1 0\n$EndNodes\n"
      "$Elements\n4\n1 15 2 0 1 1\n2 1 2 7 1 1 5\n3 1 2 8 1 5 1\n"
      "4 2 3 3 1 0 1 5 9\n$EndElements\n";
    const std::string new_text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\nof no use\n"
      "$EndComments\n" +
      names +
      "$Entities\n1 1 1 0\n1 0 0 0 0\n4 0 0 0 1 0 0 2 7 -8 2 1 -2\n"
      "6 0 0 0 1 1 0 1 3 1 4\n$EndEntities\n"
      "$Nodes\n2 3 1 9\n1 4 1 2\n1\n5\n0 0 0 0\n1 0 0 1\n2 6 0 1\n9\n0 1 0\n"
      "$EndNodes\n$Elements\n3 3 1 3\n0 1 15 1\n1 1\n1 4 1 1\n2 1 5\n"
      "2 6 2 1\n3 1 5 9\n$EndElements\n";

    /** Numbers as they stand in memory. */
    struct Bytes
    {
      std::string text;
      template <class Number>
      Bytes &
      put(const std::initializer_list<double> &values)
      {
        for (const double value : values)
          {
            const auto number = static_cast<Number>(value);
            text.append(reinterpret_cast<const char *>(&number),
                        sizeof(Number));
          }
        return *this;
      }
      Bytes &
      operator+=(const std::string &more)
      {
        text += more;
        return *this;
      }
    };

    std::string
    old_binary()
    {
      Bytes b{"$MeshFormat\n2.2 1 8\n"};
      b.put<std::int32_t>({1}) += "\n$EndMeshFormat\n" + names + "$Nodes\n3\n";
      b.put<std::int32_t>({1}).put<double>({0, 0, 0});
      b.put<std::int32_t>({5}).put<double>({1, 0, 0});
      b.put<std::int32_t>({9}).put<double>({0, 1, 0});
      b += "\n$EndNodes\n$Elements\n4\n";
      b.put<std::int32_t>({15, 1, 2, 1, 0, 1, 1});
      b.put<std::int32_t>({1, 2, 2, 2, 7, 1, 1, 5, 3, 8, 1, 5, 1});
      b.put<std::int32_t>({2, 1, 3, 4, 3, 1, 0, 1, 5, 9});
      b += "\n$EndElements\n";
      return b.text;
    }

    std::string
    new_binary()
    {
      Bytes b{"$MeshFormat\n4.1 1 8\n"};
      b.put<std::int32_t>({1}) += "\n$EndMeshFormat\n" + names + "$Entities\n";
      b.put<std::uint64_t>({0, 1, 1, 0});
      b.put<std::int32_t>({4}).put<double>({0, 0, 0, 1, 0, 0});
      b.put<std::uint64_t>({2}).put<std::int32_t>({7, -8});
      b.put<std::uint64_t>({2}).put<std::int32_t>({1, -2});
      b.put<std::int32_t>({6}).put<double>({0, 0, 0, 1, 1, 0});
      b.put<std::uint64_t>({1}).put<std::int32_t>({3});
      b.put<std::uint64_t>({1}).put<std::int32_t>({4});
      b += "\n$EndEntities\n$Nodes\n";
      b.put<std::uint64_t>({1, 3, 1, 9});
      b.put<std::int32_t>({2, 6, 0}).put<std::uint64_t>({3, 1, 5, 9});
      b.put<double>({0, 0, 0, 1, 0, 0, 0, 1, 0});
      b += "\n$EndNodes\n$Elements\n";
      b.put<std::uint64_t>({2, 2, 1, 2});
      b.put<std::int32_t>({1, 4, 1}).put<std::uint64_t>({1, 2, 1, 5});
      b.put<std::int32_t>({2, 6, 2}).put<std::uint64_t>({1, 3, 1, 5, 9});
      b += "\n$EndElements\n";
      return b.text;
    }

    std::string
    fault_of(const std::string &contents)
    {
      try
        {
          read_gmsh(contents);
        }
      catch (const FileFault &fault)
        {
          return fault.why;
        }
      return "";
    }

    std::string
    replaced(std::string text, const std::string &part, const std::string &by)
    {
      return text.replace(text.find(part), part.size(), by);
    }
  } // namespace

  TEST(GmshFile, AllFormatsSayTheSame)
  {
    for (const std::string &contents :
         {old_text, new_text, old_binary(), new_binary()})
      {
        const FileMesh mesh = read_gmsh(contents);
        ASSERT_EQ(mesh.points.size(), 3);
        EXPECT_EQ(mesh.points[1], Point<3>(1, 0, 0));
        EXPECT_EQ(mesh.points[2], Point<3>(0, 1, 0));
        ASSERT_EQ(mesh.elements.size(), 2);
        EXPECT_EQ(mesh.elements[0].dim, 1);
        EXPECT_EQ(mesh.elements[0].nodes, (std::vector<unsigned int>{0, 1}));
        // in two groups
        EXPECT_EQ(mesh.elements[0].groups, (std::set<unsigned int>{7, 8}));
        EXPECT_EQ(mesh.elements[1].nodes, (std::vector<unsigned int>{0, 1, 2}));
        EXPECT_EQ(mesh.elements[1].groups, (std::set<unsigned int>{3}));
        EXPECT_EQ(mesh.names.at({1, 7}), "floor of it");
        EXPECT_EQ(mesh.names.at({2, 3}), "steel");
      }
    EXPECT_EQ(gmsh_version(old_binary()), 2.2);
    EXPECT_EQ(gmsh_version(new_text), 4.1);
    EXPECT_EQ(gmsh_version("$NOD\n"), 1);
  }

  TEST(GmshFile, CornersOfSecondOrderAreTaken)
  {
    const FileMesh mesh = read_gmsh(
      replaced(old_text, "4 2 3 3 1 0 1 5 9", "4 9 3 3 1 0 1 5 9 5 9 1"));
    EXPECT_EQ(mesh.elements.back().nodes, (std::vector<unsigned int>{0, 1, 2}));
    EXPECT_EQ(mesh.elements.back().groups, std::set<unsigned int>{3});
  }

  TEST(GmshFile, WhatIsCutOffIsNoMesh)
  {
    for (const std::string &contents :
         {old_text, new_text, old_binary(), new_binary()})
      for (std::size_t n = 1; n + 1 < contents.size(); ++n)
        EXPECT_NE(fault_of(contents.substr(0, n)), "") << n;
  }

  TEST(GmshFile, FaultsAreSaid)
  {
    const auto expect = [](const std::string &contents,
                           const std::string &part) {
      EXPECT_NE(fault_of(contents).find(part), std::string::npos)
        << fault_of(contents);
    };
    expect(replaced(old_text, "2.2 0 8", "4.0 0 8"), "of version 4. Save it");
    expect(replaced(old_text, "4 2 3 3 1 0 1 5 9", "4 21 3 3 1 0 1 5 9 1 5 9"),
           "'Mesh.ElementOrder = 1;'");
    expect(replaced(old_text, "1 0 1 5 9", "1 0 1 5 8"),
           "names a node that is not there");
    expect(replaced(old_text, "9 0 1 0", "5 0 1 0"), "stands there twice");
    expect(replaced(old_text, "9 0 1 0", "9 0 nan 0"), "not a finite number");
    expect(replaced(old_text, "9 0 1 0", "9 0 one 0"), "'one' stands there");
    expect(replaced(old_text, "$Nodes\n3", "$Nodes\n-3"), "from 0 on");
    expect(replaced(new_text, "$Entities", "$PartitionedEntities"),
           "divided into partitions");
    std::string other_machine = old_binary();
    std::swap(other_machine[20], other_machine[23]);
    expect(other_machine, "another kind of machine");
    expect("", "no elements");
  }
} // namespace conetact::test
