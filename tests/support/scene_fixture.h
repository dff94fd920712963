// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_scene_fixture_h
#define conetact_tests_scene_fixture_h

#include "conetact/application/scene.h"
#include "conetact/contact/contact_points.h"

#include "body_fixture.h"

/** Scenes from their text, with frames that can be reckoned by hand. */
namespace conetact::test
{
  using namespace application;

  /** Read and built; bodies, supports and contact nodes live in it. */
  inline std::unique_ptr<Scene>
  make_scene(const std::string &text)
  {
    CommandLine line;
    line.scene = folder() / write_file("scene.prm", text);
    auto scene = std::make_unique<Scene>(line);
    scene->build();
    return scene;
  }

  /** "subsection NAME", entries separated by '|', "end". */
  inline std::string
  section(const std::string &name, const std::string &entries)
  {
    return "subsection " + name + "\n" + lines(entries) + "\nend\n";
  }

  /**
   * Three bars, E A = 100: nodes 0 (0, 0) and 1 (2, 0) are its feet with id 1,
   * node 2 (1, 1) its top with id 2. At (x, y), if it is not the only one.
   */
  inline std::string
  triangle(const std::string &name  = "frame",
           const std::string &nodes = "1: 0, 0 : 1 ; 2: 2, 0 : 1 ; "
                                      "3: 1, 1 : 2")
  {
    return "subsection Body " + name + "\nset Kind = frame\n" +
           "set Sections = bar\n" +
           section("Frame", "Nodes = " + nodes + "|Members = 1-2-3-1: bar") +
           section("Section bar", "Young modulus = 1000|Area = 0.1") + "end\n";
  }

  /** A triangle whose feet stand on a floor y = 0; `more` after the lists. */
  inline std::string
  triangle_on_floor(const std::string &lists,
                    const std::string &more,
                    const std::string &contact = "")
  {
    return "set Dimension = 2\nset Bodies = frame\nset Obstacles = floor\n"
           "set Contacts = feet\n" +
           lists + triangle() +
           section("Obstacle floor", "Shape = half space|Normal = 0, 1") +
           section("Contact feet",
                   "Body = frame|Boundary ids = 1|Obstacle = floor" + contact) +
           more;
  }

  /** The top of it held in both directions, moved by (ux, uy). */
  inline std::string
  held_top(const std::string &motion = "0")
  {
    return section("Support top",
                   "Body = frame|Boundary ids = 2|Directions = x, y|"
                   "Displacement = " +
                     motion);
  }

  inline Tensor<1, 3>
  vector(const double x, const double y, const double z = 0)
  {
    return Tensor<1, 3>({x, y, z});
  }

  inline void
  expect_near(const Tensor<1, 3> &found,
              const Tensor<1, 3> &expected,
              const double        bound = 1e-14)
  {
    EXPECT_LE((found - expected).norm(), bound)
      << found << " instead of " << expected;
  }
} // namespace conetact::test

#endif
