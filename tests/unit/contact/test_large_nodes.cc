// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_model.h"
#include "conetact/contact/large_nodes.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;
using test::section;

namespace
{
  std::string
  block(const std::string &name,
        const std::string &corners,
        const std::string &material)
  {
    return "subsection Body " + name + "\n" +
           section("Mesh",
                   "Generator = subdivided_hyper_rectangle|"
                   "Arguments = 2, 2 : " +
                     corners + " : true") +
           section("Material", material) + "end\n";
  }

  /** A slave on a softer master, its fibres along an axis. */
  double
  hardness(const std::string &moduli)
  {
    const auto scene = test::make_scene(
      "set Dimension = 2\nset Bodies = low, high\nset Contacts = joint\n"
      "set Supports = ground, top\n" +
      block("low", "0, 0 : 1, 1", "Young modulus = 1|Poisson ratio = 0") +
      block("high",
            "0, 1 : 1, 2",
            "Young moduli = " + moduli +
              "|Poisson ratios = 0, 0, 0|Shear moduli = 1, 1, 1") +
      section("Contact joint",
              "Body = high|Boundary ids = 2|Master body = low|"
              "Master boundary ids = 3|Pairing = node to face") +
      section("Support ground", "Body = low|Boundary ids = 2") +
      section("Support top", "Body = high|Boundary ids = 3"));
    const ContactModel model(scene->bodies, {1});
    return hardest_slave(model.elastic, model.coordinates, model.points);
  }
} // namespace



TEST(LargeNodes, AreAsHardAlongAnyAxis)
{
  const double along_x = hardness("100, 1, 1");
  EXPECT_GT(along_x, 20);
  EXPECT_NEAR(hardness("1, 100, 1"), along_x, 1e-10 * along_x);
}
