// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/probes.h"

#include "body_fixture.h"
#include "sentence.h"

using namespace conetact;
using namespace conetact::bodies;

namespace
{
  const std::string plate =
    "Generator = subdivided_hyper_rectangle|Arguments = 3, 2 : 0, 0 : 3, 2 : true";
  const std::string beside =
    "Generator = subdivided_hyper_rectangle|Arguments = 1, 1 : 3, 0 : 5, 2 : true";

  /** Probes in two plates that touch at x = 3. */
  struct Plates
  {
    std::unique_ptr<Structure> left  = test::make_body(2, plate);
    std::unique_ptr<Structure> right = test::make_body(2, beside);

    std::vector<Probe>
    probes(const std::string &text) const
    {
      return parse_probes(
        text, 2, {"left", "the right"}, {left.get(), right.get()}, "Probes");
    }
    std::string
    sentence(const std::string &text) const
    {
      return test::sentence_of([&] { probes(text); });
    }
  };
} // namespace



TEST(Probes, InterpolateLinearFields)
{
  const Plates plates;
  const auto   probes =
    plates.probes("tip: 0.25, 1.7 ; edge in the right : 3, 2, 0 ;");
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_EQ(probes[0].name, "tip");
  EXPECT_EQ(probes[0].body, 0u);
  EXPECT_EQ(probes[1].name, "edge");
  EXPECT_EQ(probes[1].body, 1u);
  Eigen::VectorXd u(plates.left->n_dofs());
  for (unsigned int i = 0; i < plates.left->n_nodes(); ++i)
    {
      const Point<3> p = plates.left->position(i);
      u[2 * i]         = 1 + 2 * p[0] - p[1];
      u[2 * i + 1]     = p[0] * p[1];
    }
  const Tensor<1, 3> found = probes[0].displacement(u);
  EXPECT_NEAR(found[0], 1 + .5 - 1.7, 1e-14);
  EXPECT_NEAR(found[1], .25 * 1.7, 1e-14);
  EXPECT_EQ(found[2], 0.);
}

TEST(Probes, MistakesAreSentences)
{
  const Plates                                           plates;
  const std::vector<std::pair<std::string, std::string>> cases = {
    {"1, 2", "Probes: '1, 2' is not a name, a colon and a point."},
    {": 1, 2", "Probes: ': 1, 2' is not a name, a colon and a point."},
    {"a b: 1, 2", "Probes: the name 'a b' becomes part of columns."},
    {"a: 1", "Probes, a: '1' has 1"},
    {"a: 1, 2, 3", "Probes, a: '1, 2, 3' has 3"},
    {"a: 1, x", "Probes, a: 'x' depends on position"},
    {"a: 9, 9", "Probes, a: no body holds the point (9, 9, 0)."},
    {"a in left: 4, 1", "Probes, a: no body holds the point (4, 1, 0)."},
    {"a in middle: 4, 1", "Probes, a: there is no body 'middle'."},
    {"a: 3, 1",
     "Probes, a: the bodies 'left' and 'the right' both hold the point. Say "
     "which one is meant: 'a in left: 3, 1'."},
    {"a: 1, 1 ; a: 2, 1", "Probes: 'a' stands there twice."}};
  for (const auto &[text, sentence] : cases)
    EXPECT_TRUE(test::starts(plates.sentence(text), sentence))
      << plates.sentence(text);
  EXPECT_EQ(plates.sentence(""), "accepted");
}
