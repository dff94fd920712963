// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/file_mesh.h"
#include "conetact/contact/pieces.h"

#include <gtest/gtest.h>

#include "body_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::test;

namespace
{
  const std::string square = "Generator = hyper_cube|Arguments = 0:1:true";

  /** Two squares beside each other, lines 7 (bottom left) and 8 (right). */
  const char *const gmsh_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
7
1 0 0 0
2 2 0 0
3 2 1 0
4 0 1 0
5 1 0 0
6 1 1 0
9 7 7 0
$EndNodes
$Elements
4
1 1 2 7 1 1 5
2 1 2 8 2 2 3
3 3 2 1 1 1 5 6 4
4 3 2 1 1 5 2 3 6
$EndElements
)";
  const char *const gmsh_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 2 1 0
1 0 0 0 1 0 0 1 7 0
2 2 0 0 2 1 0 1 8 0
1 0 0 0 2 1 0 1 1 0
$EndEntities
$Nodes
1 6 1 6
2 1 0 6
1
2
3
4
5
6
0 0 0
2 0 0
2 1 0
0 1 0
1 0 0
1 1 0
$EndNodes
$Elements
3 4 1 4
1 1 1 1
1 1 5
1 2 1 1
2 2 3
2 1 3 2
3 1 5 6 4
4 5 2 3 6
$EndElements
)";

  /** The sentence that refuses these entries; "" if they are taken. */
  std::string
  refusal(const unsigned int dim,
          const std::string &mesh,
          const std::string &material = "Young modulus = 5|"
                                        "Poisson ratio = 0.3")
  {
    try
      {
        make_body(dim, mesh, material);
        return "";
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
      }
  }

  void
  expect_refusal(const std::string &sentence,
                 const std::string &entry,
                 const std::string &fault)
  {
    EXPECT_EQ(sentence.find("Body 'block', " + entry), 0) << sentence;
    EXPECT_NE(sentence.find(fault), std::string::npos) << sentence;
  }
} // namespace

TEST(MeshInput, GmshFilesGiveBoundaryIds)
{
  for (const char *text : {gmsh_2, gmsh_4})
    {
      const auto body = make_body(2, "File = " + write_file("two.msh", text));
      EXPECT_EQ(body->n_nodes(), 6);
      EXPECT_EQ(body->boundary_ids(), (BoundaryIds{0, 7, 8}));
      const Surface bottom = body->surface({7});
      ASSERT_EQ(bottom.nodes.size(), 2);
      for (const SurfaceNode &node : bottom.nodes)
        {
          EXPECT_EQ(node.position[1], 0);
          EXPECT_LE(node.position[0], 1);
        }
    }
}

TEST(MeshInput, GroupsOfAFileHaveNames)
{
  // two squares beside each other, a line between them; the left line twice
  const std::string file = write_file(
    "groups.msh",
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n"
    "1 7 \"floor\"\n1 8 \"between\"\n1 9 \"outside\"\n2 3 \"steel\"\n"
    "2 4 \"rubber\"\n$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 2 0 0\n"
    "3 2 1 0\n4 0 1 0\n5 1 0 0\n6 1 1 0\n$EndNodes\n$Elements\n6\n"
    "1 1 2 7 1 1 5\n2 1 2 8 2 5 6\n3 1 2 9 1 1 5\n4 1 2 9 1 4 1\n"
    "5 3 2 3 1 1 5 6 4\n6 3 2 4 1 5 2 3 6\n$EndElements\n");
  const std::string both = "Poisson ratio = 0|Young modulus = 5 ; 20|"
                           "Material group = rubber ; steel";

  const auto whole  = make_body(2, "File = " + file, both);
  const auto groups = whole->boundary_groups();
  EXPECT_EQ(groups.count("between"), 0); // no boundary of it
  EXPECT_EQ(groups.at("floor"), (BoundaryIds{own_numbers})); // a new id
  EXPECT_EQ(groups.at("outside"), (BoundaryIds{9, own_numbers}));
  EXPECT_EQ(groups.at("7"), (BoundaryIds{own_numbers}));
  EXPECT_EQ(groups.at("floor & outside"), (BoundaryIds{own_numbers}));
  EXPECT_EQ(whole->boundary_ids(), (BoundaryIds{0, 9, own_numbers}));
  // conditions: a number of a group is part of it, others are new
  const auto tagged =
    make_body(2, "File = " + file + "|Boundary ids = 9: x > 1.99 ; 10: y > .9");
  EXPECT_EQ(tagged->boundary_groups().at("outside"),
            (BoundaryIds{9, own_numbers}));
  EXPECT_EQ(tagged->surface({10}).faces.size(), 2);
  const auto moved =
    make_body(2, "File = " + file + "|Boundary ids = 7: y < .1");
  EXPECT_EQ(moved->boundary_groups().at("floor"), (BoundaryIds{7}));
  // shear of a square: energy G / 2
  const Eigen::VectorXd u = interpolate(*whole, [](const Point<3> &p) {
    return Tensor<1, 3>({p[1], 0., 0.});
  });
  EXPECT_NEAR(u.dot(stiffness(*whole) * u), 2.5 + 10, 1e-13);

  const auto part = make_body(2, "File = " + file + "|Group = 'rubber'");
  EXPECT_EQ(part->n_nodes(), 4);
  EXPECT_EQ(part->boundary_groups().at("between"), (BoundaryIds{8}));

  expect_refusal(refusal(2, "File = " + file + "|Group = copper"),
                 "Mesh/Group",
                 "has the groups rubber, steel");
  expect_refusal(refusal(2, "File = " + file + "|Group = 5"),
                 "Mesh/Group",
                 "no cell");
}

TEST(MeshInput, MeshIsScaledThenRotatedThenMoved)
{
  const auto body =
    make_body(2, square + "|Scale = 2|Rotation = 90|Translation = 10, sqrt(4)");
  double sum = 0;
  for (const SurfaceNode &node : body->surface({1}).nodes) // x = 1 before
    {
      EXPECT_EQ(node.position[1], 4);
      sum += node.position[0];
    }
  EXPECT_EQ(sum, 18);

  const auto cube = make_body(3,
                              "Generator = hyper_cube|Arguments = 0:1:true|"
                              "Rotation = 0, 0, 5, 90|Translation = 0, 0, 7");
  for (const SurfaceNode &node : cube->surface({1}).nodes)
    EXPECT_EQ(node.position[1], 1);
}

/** Of cells per direction, refined from fewer: quadrants have their own
 * materials, and so have the two cells that the x axis would cut. */
void
expect_block(const std::vector<int>    &n,
             const std::vector<double> &sides,
             const double               energy)
{
  const auto text = [](const auto a, const auto b) {
    return std::to_string(a) + ", " + std::to_string(b);
  };
  const auto body =
    make_body(2,
              "Generator = subdivided_hyper_rectangle|Arguments = " +
                text(n[0], n[1]) + " : " + text(sides[0], sides[1]) + " : " +
                text(sides[2], sides[3]) + " : true",
              "Poisson ratio = 0|Young modulus = 2 ; 4 ; 8 ; 16|"
              "Material group = 0 ; 1 ; 2 ; 3");
  const std::size_t n_x = static_cast<std::size_t>(n[0]) + 1,
                    n_y = static_cast<std::size_t>(n[1]) + 1;
  EXPECT_EQ(body->n_nodes(), n_x * n_y);
  EXPECT_EQ(body->elements().count().elements, (n_x - 1) * (n_y - 1));
  std::set<std::pair<long, long>> places;
  for (unsigned int i = 0; i < body->n_nodes(); ++i)
    {
      const Point<3> p = body->position(i);
      const double   k = (p[0] - sides[0]) / (sides[2] - sides[0]) * n[0],
                   l   = (p[1] - sides[1]) / (sides[3] - sides[1]) * n[1];
      EXPECT_NEAR(k, std::round(k), 1e-10);
      EXPECT_NEAR(l, std::round(l), 1e-10);
      places.emplace(std::lround(k), std::lround(l));
    }
  EXPECT_EQ(places.size(), body->n_nodes());
  EXPECT_EQ(body->boundary_ids(), (BoundaryIds{0, 1, 2, 3}));
  for (unsigned int id = 0; id < 4; ++id)
    EXPECT_EQ(body->surface({id}).nodes.size(), id < 2 ? n_y : n_x);
  // shear strains of 1 have an energy of E / 4 for each unit of area
  const Eigen::VectorXd u = interpolate(*body, [](const Point<3> &p) {
    return Tensor<1, 3>({p[1], 0., 0.});
  });
  Eigen::VectorXd       f = Eigen::VectorXd::Zero(u.size());
  body->elements().add_forces(u, f);
  EXPECT_NEAR(u.dot(f) / 2, energy, 1e-10);
}

TEST(MeshInput, LargeBlocksAreWhatTheirArgumentsSay)
{
  // E / 4 is .5, 1, 2, 4 in the quadrants
  expect_block({240, 220}, {-1, -1, 1, 1}, 7.5);
  // x = 0 after 80 of 240 cells, y = 0 after 55 of 220
  expect_block({240, 220}, {-1, -.5, 2, 1.5}, .5 * .5 + 1 + 1.5 * 2 + 3 * 4);
}

TEST(MeshInput, LaterBoundaryIdsWin)
{
  const auto body =
    make_body(2,
              square + "|Global refinements = 2|Translation = 5, 0|"
                       "Boundary ids = 7: x > 5.9 ; 8: y > 0.99 && x < 5.5 ; "
                       "9: (x > 5.9) && (y < 0.2)");
  EXPECT_EQ(body->boundary_ids(), (BoundaryIds{0, 2, 3, 7, 8, 9}));
  EXPECT_EQ(body->surface({7}).faces.size(), 3);
  EXPECT_EQ(body->surface({8}).faces.size(), 2);
  EXPECT_EQ(body->surface({9}).faces.size(), 1);
  EXPECT_EQ(body->surface({3}).faces.size(), 2);
}

TEST(MeshInput, CurvedBodiesAreRefinedOnTheirShape)
{
  const auto body =
    make_body(2,
              "Generator = hyper_ball|Arguments = 0, 0 : 1 : false|"
              "Global refinements = 3|Scale = 3|Translation = 0, 3");
  for (const SurfaceNode &node : body->surface({0}).nodes)
    EXPECT_NEAR(node.position.distance(Point<3>(0, 3, 0)), 3, 1e-14);
}

/* Inside, its manifold belongs to the mesh of quadrilaterals. */
TEST(MeshInput, PlatesWithHolesAreDividedIntoTriangles)
{
  const auto body  = make_body(2,
                              "Generator = plate_with_a_hole|"
                               "Arguments = 0.4 : 1 : 0.5 : 0.5 : 0.5 : 0.5 : "
                               "3, 1 : 0 : 1 : 1 : 2 : true|"
                               "Global refinements = 1",
                              "Young modulus = 5|Poisson ratio = 0.3",
                              "P1");
  const auto nodes = body->surface({4}).nodes;
  EXPECT_EQ(nodes.size(), 32u);
  for (const SurfaceNode &node : nodes)
    EXPECT_NEAR(node.position.distance(Point<3>(3, 1, 0)), .4, 1e-12);
}

TEST(MeshInput, BoxesRefineWhatTheyReachInto)
{
  const std::string mesh  = square + "|Global refinements = 1|Scale = 8|";
  const auto        count = [&](const std::string &boxes) {
    const auto body = make_body(2, mesh + "Refinement boxes = " + boxes);
    return body->description();
  };
  EXPECT_EQ(count("0, 0 : 4, 4 : 1"), "7 cells Q1, 14 nodes (2 hanging)");
  EXPECT_EQ(count("4, 4 : 0, 0 : 0"), "4 cells Q1, 9 nodes");
  EXPECT_EQ(count("0, 0 : 5, 5 : 1"), "16 cells Q1, 25 nodes");
  EXPECT_EQ(count("0, 0 : 5, 5 : 1 ; 0, 0 : 1, 1 : 2"),
            "19 cells Q1, 30 nodes (2 hanging)");
  // in either order, and where they only overlap
  EXPECT_EQ(count("0, 0 : 1, 1 : 2 ; 0, 0 : 5, 5 : 1"),
            "19 cells Q1, 30 nodes (2 hanging)");
  EXPECT_EQ(count("0, 0 : 1, 1 : 1 ; 0, 0 : 4, .5 : 1"),
            "7 cells Q1, 14 nodes (2 hanging)");
}

TEST(MeshInput, CellsBesideABoundaryAreRefined)
{
  const std::string mesh  = square + "|Global refinements = 1|Scale = 8|";
  const auto        count = [&](const std::string &entries) {
    return make_body(2, mesh + entries)->description();
  };
  const std::string once = "10 cells Q1, 18 nodes (2 hanging)";
  EXPECT_EQ(count("Refinement distance = 2 : 1 : 1"), once);
  EXPECT_EQ(count("Refinement distance = 2 : 4 : 1"), once);
  EXPECT_EQ(count("Rotation = 30|Refinement distance = 2 : 1 : 1"), once);
  EXPECT_EQ(count("Boundary ids = 7: y < .1|Refinement distance = 7 : 1 : 1"),
            once);
  EXPECT_EQ(count("Refinement distance = 2 : 4.1 : 1"),
            "16 cells Q1, 25 nodes");
  EXPECT_EQ(count("Refinement distance = 2, 3 : 1 : 1"),
            "16 cells Q1, 25 nodes");
  EXPECT_EQ(count("Refinement distance = 2 : 1 : 2 ; 3 : 1 : 0"),
            "22 cells Q1, 35 nodes (6 hanging)");
}

TEST(MeshInput, MaterialIsChecked)
{
  const auto refuse = [](const std::string &entries) {
    return refusal(2, square, entries);
  };
  const std::string E = "Young modulus = 5|", nu = "Poisson ratio = 0.3|";
  expect_refusal(refuse("Poisson ratio = .3"),
                 "Material/Young modulus",
                 "miss");
  expect_refusal(refuse(nu + "Young modulus = -1"),
                 "Material/Young modulus",
                 "not positive");
  expect_refusal(refuse(E + "Poisson ratio = 0.5"),
                 "Material/Poisson ratio",
                 "incompressible");
  expect_refusal(refuse(E + "Poisson ratio = -1"),
                 "Material/Poisson ratio",
                 "above -1");
  expect_refusal(refuse(E + nu + "Thickness = 0"),
                 "Material/Thickness",
                 "not positive");
}

TEST(MeshInput, GeneratorsAreChecked)
{
  expect_refusal(refusal(2, "Scale = 1"), "Mesh/Generator", "no mesh");
  expect_refusal(refusal(2, "Generator = foo"), "Mesh/Generator", "'foo'");
  expect_refusal(refusal(2, "Generator = hyper_cube|Arguments = 0:1"),
                 "Mesh/Arguments",
                 "hyper_cube");
  expect_refusal(refusal(2, square + "|File = a.msh"),
                 "Mesh/Generator",
                 "both");
}

TEST(MeshInput, ArgumentsOfGeneratorsAreChecked)
{
  const auto expect = [](const unsigned int dim,
                         const std::string &generator,
                         const std::string &arguments,
                         const std::string &fault) {
    expect_refusal(
      refusal(dim, "Generator = " + generator + "|Arguments = " + arguments),
      "Mesh/Arguments",
      fault);
  };
  const std::string rectangle = "subdivided_hyper_rectangle";
  const std::string corners   = ":0,0:1,1:true";
  for (const char *cells : {"-1, 2", "1.5, 2", "1e9, 8", "0, 2", "nan, 2"})
    expect(2, rectangle, cells + corners, "number");
  expect(2, rectangle, "7" + corners, "has 1 numbers of cells");
  expect(2, rectangle, "1, 1, 1" + corners, "has 3 numbers of cells");
  expect(2, rectangle, ".5, .5 ; -1, 2" + corners, "not steps");
  expect(2, rectangle, ".5, .5 ; .5, .6" + corners, "adds up to 1.1");
  expect(2, rectangle, "40 ; 30" + corners, "adds up to 40");
  expect(2, rectangle, "99999999, 99999999" + corners, "coarser");
  expect(2, rectangle, "2, 2:0,0:1,1e200:true", "finite");
  expect(3, "hyper_ball", "0, 0, 0 : 0 : false", "not positive");
  expect(2, "hyper_shell", "0, 0 : 2 : 1 : 8 : false", "not smaller");
  expect(3, "hyper_shell", "0, 0, 0 : 1 : 2 : 7 : false", "Give one of");
  expect(2, "hyper_shell", "0, 0 : 1 : 1.0000000001 : 0 : false", "coarser");
  expect(3, "truncated_cone", "1 : 1 : 1e12", "coarser");
  expect(2, "general_cell", "0, 0 ; 1, 0 ; 0, 1 : false", "has 3 points");
  expect(2,
         "plate_with_a_hole",
         "1 : 2 : 1e15 : 0 : 0 : 0 : 0, 0 : 0 : 1 : 1 : 2 : true",
         "coarser");
}

TEST(MeshInput, MeshesThatHaveNoRoomAreRefused)
{
  const std::string cube = "Generator = hyper_cube|Arguments = 0:1:true|";
  expect_refusal(refusal(3, cube + "Global refinements = 12"),
                 "Mesh/Global refinements",
                 "coarser");
  expect_refusal(refusal(3, cube + "Refinement boxes = 0,0,0 : 1,1,1 : 12"),
                 "Mesh/Refinement boxes",
                 "coarser");
}

TEST(MeshInput, PlacementIsChecked)
{
  const auto refuse = [](const std::string &entries) {
    return refusal(2, square + "|" + entries);
  };
  expect_refusal(refuse("Scale = 0"), "Mesh/Scale", "not positive");
  expect_refusal(refuse("Rotation = 1, 2"), "Mesh/Rotation", "one angle");
  expect_refusal(refuse("Translation = 1"), "Mesh/Translation", "1 component");
  expect_refusal(refuse("Boundary ids = 7: y >"), "Mesh/Boundary ids", "y >");
  expect_refusal(refuse("Boundary ids = y > 1"), "Mesh/Boundary ids", "id");
  expect_refusal(refuse("Boundary ids = 7: t > 1"),
                 "Mesh/Boundary ids",
                 "time");
  expect_refusal(refuse("Boundary ids = 7: y > 1.1"),
                 "Mesh/Boundary ids",
                 "no boundary face");
  expect_refusal(refuse("Refinement boxes = 0, 0 : 1"),
                 "Mesh/Refinement boxes",
                 "not a box");
  expect_refusal(refuse("Refinement boxes = 0, 0 : 1, 1 : -1"),
                 "Mesh/Refinement boxes",
                 "levels");
  expect_refusal(refuse("Refinement boxes = 3, 3 : 4, 4 : 1"),
                 "Mesh/Refinement boxes",
                 "no cell");
  expect_refusal(refuse("Refinement boxes = 0,0 : 1,1 : 2 ; 0,0 : .5,.5 : 2"),
                 "Mesh/Refinement boxes",
                 "box 2 has no effect");
  expect_refusal(refuse("Refinement distance = 2 : 1"),
                 "Mesh/Refinement distance",
                 "not a distance");
  expect_refusal(refuse("Refinement distance = 2 : -1 : 1"),
                 "Mesh/Refinement distance",
                 "not positive");
  expect_refusal(refuse("Refinement distance = 2 : 1 : 0.5"),
                 "Mesh/Refinement distance",
                 "levels");
  expect_refusal(refuse("Refinement distance = 2, 9 : 1 : 1"),
                 "Mesh/Refinement distance",
                 "id 9");
  expect_refusal(
    refusal(3, "Generator = hyper_cube|Arguments = 0:1:true|Rotation=0,0,0,9"),
    "Mesh/Rotation",
    "length zero");
}

TEST(MeshInput, FilesAreChecked)
{
  const auto refuse = [](const unsigned int dim,
                         const std::string &name,
                         const std::string &text) {
    return refusal(dim, "File = " + write_file(name, text));
  };
  const auto replaced =
    [](std::string text, const std::string &part, const std::string &by) {
      return text.replace(text.find(part), part.size(), by);
    };
  expect_refusal(refusal(2, "File = none.msh"), "Mesh/File", "no file");
  expect_refusal(refuse(2, "a.msh", ""), "Mesh/File", "empty");
  expect_refusal(refuse(2, "a.xyz", "x"), "Mesh/File", "format");
  expect_refusal(refuse(3, "a.msh", gmsh_2), "Mesh/File", "hexahedra");
  expect_refusal(refuse(2, "a.msh", std::string(gmsh_4).substr(0, 250)),
                 "Mesh/File",
                 "does not end");
  expect_refusal(refuse(2, "a.msh", replaced(gmsh_2, "2.2 0 8", "2.2 1 8")),
                 "Mesh/File",
                 "binary");
  expect_refusal(refusal(2,
                         "Mixed cells = refuse|File = " +
                           write_file("a.msh",
                                      replaced(gmsh_2,
                                               "4 3 2 1 1 5 2 3 6",
                                               "4 2 2 1 1 5 2 3"))),
                 "Mesh/File",
                 "1 quadrilaterals, 1 triangles");
  expect_refusal(refuse(2,
                        "a.msh",
                        replaced(gmsh_2, "6 1 1 0", "6 1.9 0.05 0")),
                 "Mesh/File",
                 "distorted");
}

TEST(MeshInput, PiecesThatNoElementJoinsAreCounted)
{
  EXPECT_EQ(contact::n_pieces(
              *make_body(2, "File = " + write_file("one.msh", gmsh_2))),
            1);
  // nodes of the right square beside those of the left one
  std::string two = gmsh_2;
  two.replace(two.find("Nodes\n7"), 7, "Nodes\n8");
  two.replace(two.find("9 7 7 0"), 7, "9 1 0 0\n10 1 1 0");
  two.replace(two.find("1 1 5 2 3 6"), 11, "1 1 9 2 3 10");
  EXPECT_EQ(contact::n_pieces(
              *make_body(2, "File = " + write_file("two.msh", two))),
            2);
  EXPECT_EQ(contact::n_pieces(
              *make_body(2,
                         square + "|Global refinements = 1|"
                                  "Refinement boxes = 0, 0 : .5, .5 : 1")),
            1);
}

TEST(MeshInput, VtkOfBothVersionsIsRead)
{
  const std::string grid = "\nsquare\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                           "POINTS 4 double\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  for (const std::string version : {"2.0", "3.0"})
    {
      const std::string head = "# vtk DataFile Version " + version + grid;
      const auto        body =
        make_body(2,
                  "File = " + write_file("square.vtk",
                                         head + "CELLS 1 5\n4 0 1 2 3\n"
                                                "CELL_TYPES 1\n9\n"));
      EXPECT_EQ(body->n_nodes(), 4);
      // Gmsh adds cells of its points
      const auto with_points =
        make_body(2,
                  "File = " + write_file("points.vtk",
                                         head + "CELLS 2 7\n1 0\n4 0 1 2 3\n"
                                                "CELL_TYPES 2\n1\n9\n"));
      EXPECT_EQ(with_points->n_nodes(), 4);
    }
}

TEST(MeshInput, AbaqusFilesOfGmshAreRead)
{
  testing::internal::CaptureStderr();
  const auto body =
    make_body(2,
              "File = " +
                write_file("lines.inp",
                           "*Heading\n a\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n"
                           "3, 1, 1, 0\n4, 0, 1, 0\n"
                           "******* E L E M E N T S *************\n"
                           "*ELEMENT, type=T3D2, ELSET=Line1\n1, 1, 2\n"
                           "*ELEMENT, type=CPS4, ELSET=Surface1\n"
                           "2, 1, 2, 3, 4\n"));
  EXPECT_EQ(body->n_nodes(), 4);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(MeshInput, AnEdgeOfThreeCellsIsRefused)
{
  // a third square on the edge from (1, 0) to (1, 1)
  std::string gmsh = gmsh_2;
  gmsh.replace(gmsh.find("9 7 7 0"), 7, "9 2 .5 0");
  gmsh.replace(gmsh.find("Elements\n4"), 10, "Elements\n5");
  gmsh.replace(gmsh.find("$EndElements"), 0, "5 3 2 1 1 5 9 3 6\n");
  const std::string ucd = "7 3 0 0 0\n1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n"
                          "5 1 0 0\n6 1 1 0\n7 2 .5 0\n1 1 quad 1 5 6 4\n"
                          "2 1 quad 5 2 3 6\n3 1 quad 5 7 3 6\n";
  for (const auto &[name, text] :
       {std::pair("three.msh", gmsh), std::pair("three.ucd", ucd)})
    {
      const std::string sentence =
        refusal(2, "File = " + write_file(name, text));
      expect_refusal(sentence, "Mesh/File", name);
      expect_refusal(sentence,
                     "Mesh/File",
                     "3 cells share the edge at (1, 0.5, 0)");
    }
}
