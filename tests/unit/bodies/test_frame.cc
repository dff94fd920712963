// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/diagrams.h"

#include "frame_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::test;

namespace
{
  const char *const beam    = "Young modulus = 200|Area = 3|"
                              "Moment of inertia = 5|"
                              "Expansion coefficient = 0.01|Width = 2";
  const char *const beam_3d = "Young modulus = 200|Area = 3|"
                              "Moment of inertia = 5, 7|"
                              "Torsion constant = 11|Shear modulus = 80|"
                              "Expansion coefficient = 0.01";
  const char *const rod     = "Young modulus = 200|Area = 3";
  constexpr double  E = 200, A = 3, I = 5, L = 4;

  /** A portal: two columns of height 4, a beam of length 6. */
  const char *const portal = "Nodes = 1: 0, 0 ; 2: 0, 4 ; 3: 6, 4 ; 4: 6, 0|"
                             "Members = 1-2-3-4: s|"
                             "Boundary ids = 5: y > 3.9";

  std::vector<std::unique_ptr<Frame>>
  frames()
  {
    std::vector<std::unique_ptr<Frame>> all;
    all.push_back(make_frame(2, portal, beam));
    all.push_back(make_frame(2,
                             "Nodes = a: 0, 0 ; b: 3, 1 ; c: 2, 4|"
                             "Members = a-b: s, hinge end ; b-c: s, hinges ; "
                             "c-a: s, elements 3 ; b-a: bar",
                             beam));
    all.push_back(make_frame(3,
                             "Nodes = a: 0, 0, 0 ; b: 3, 1, 2 ; c: 2, 4, -1 ; "
                             "d: 1, 1, 5|Members = a-b-c: s ; "
                             "c-a: s, hinge start ; b-d-a: bar ; c-d: bar",
                             beam_3d));
    all.push_back(make_frame(
      3, "Generator = double layer grid|Arguments = 3 : 2, 3 : 2", rod));
    return all;
  }

  /** Displacement of a rigid motion, with rotations. */
  Eigen::VectorXd
  rigid_motion(const Frame &frame, const unsigned int dim)
  {
    const Tensor<1, 3> w({dim == 3 ? .3 : 0., dim == 3 ? -.7 : 0., .5});
    const unsigned int n = frame.n_components();
    Eigen::VectorXd    u(frame.n_dofs());
    for (unsigned int i = 0; i < frame.n_nodes(); ++i)
      {
        const auto v = Tensor<1, 3>({1, 2, 3}) +
                       cross_product_3d(w, Tensor<1, 3>(frame.position(i)));
        for (unsigned int c = 0; c < n; ++c)
          u[n * i + c] = !frame.has_dof(i, c) ? 0 :
                         c < dim              ? v[c] :
                         dim == 2             ? w[2] :
                                                w[c - 3];
      }
    return u;
  }

  MemberSection
  cut(const Frame           &frame,
      const Eigen::VectorXd &u,
      const Actions         &actions,
      const unsigned int     member,
      const double           place)
  {
    const Member        &m    = frame.all_members()[member];
    const Member::Vector ends = frame.elements().displacements(m, u);
    return member_sections(m,
                           ends,
                           ends,
                           frame.member_loads(actions)[member],
                           8)[static_cast<std::size_t>(8 * place + .5)];
  }

  /** From the origin along x, with its ends tagged 4. */
  std::unique_ptr<Frame>
  one_member(const std::string &more = "")
  {
    return make_frame(
      2, "Nodes = 1: 0, 0 : 4 ; 2: 4, 0 : 4|Members = 1-2: s" + more, beam);
  }
} // namespace

TEST(Frame, RigidMotionsMeetNoForce)
{
  for (const auto &frame : frames())
    {
      const unsigned int dim =
        frame->n_components() == 3 &&
            frame->position(frame->n_nodes() - 1)[2] == 0 ?
          2 :
          3;
      const Eigen::MatrixXd k = stiffness(*frame);
      EXPECT_EQ((k - k.transpose()).cwiseAbs().maxCoeff(), 0);
      EXPECT_LE((k * rigid_motion(*frame, dim)).cwiseAbs().maxCoeff(),
                3e-14 * k.diagonal().maxCoeff())
        << frame->description();
    }
}

TEST(Frame, DofsWithoutStiffnessAreNone)
{
  for (const auto &frame : frames())
    {
      const Eigen::MatrixXd k = stiffness(*frame);
      const unsigned int    n = frame->n_components();
      for (unsigned int i = 0; i < frame->n_dofs(); ++i)
        EXPECT_EQ(k(i, i) > 0, frame->has_dof(i / n, i % n));
    }
  EXPECT_FALSE(frames()[2]->has_dof(3, 4)); // node d is touched by bars only
  EXPECT_TRUE(frames()[2]->has_dof(3, 2));
  EXPECT_EQ(frames()[3]->n_components(), 3u);
}

TEST(Frame, CantileverUnderEndForce)
{
  for (const double angle : {0., 30., 117.})
    {
      const auto   frame = make_frame(2,
                                    "Generator = line|"
                                      "Arguments = 0, 0 : 4, 0 : 3|Rotation = " +
                                      std::to_string(angle),
                                    beam);
      const double s = sin(angle * M_PI / 180), c = cos(angle * M_PI / 180);
      const unsigned int tip = 3 * (frame->n_nodes() - 1);
      Eigen::VectorXd    f   = no_forces(*frame);
      ASSERT_TRUE(frame->add(
        Action::point_force({4 * c, 4 * s, 0},
                            Tensor<1, 3>({5 * c + 2 * s, 5 * s - 2 * c, 0.})),
        f));
      const Eigen::VectorXd u = solve(*frame, {0, 1, 2}, f);
      EXPECT_NEAR(c * u[tip] + s * u[tip + 1], 5 * L / (E * A), 1e-13);
      EXPECT_NEAR(-s * u[tip] + c * u[tip + 1],
                  -2 * L * L * L / (3 * E * I),
                  1e-12);
      EXPECT_NEAR(u[tip + 2], -2 * L * L / (2 * E * I), 1e-12);
      const MemberSection at_root = cut(*frame, u, {}, 0, 0);
      EXPECT_NEAR(at_root.force[0], 5, 1e-11);
      EXPECT_NEAR(at_root.force[1], -2, 1e-11);
      EXPECT_NEAR(at_root.moment[2], -2 * L, 1e-11);
    }
}

TEST(Frame, CantileverInSpace)
{
  // along z: y = (1, 0, 0) x z = -Y, z = X
  const auto      frame = make_frame(3,
                                "Generator = line|"
                                     "Arguments = 0, 0, 0 : 0, 0, 4 : 2",
                                beam_3d);
  Eigen::VectorXd f     = no_forces(*frame);
  f.tail(6) << 3, 0, 0, 0, 0, 13;
  Eigen::VectorXd u = solve(*frame, {0, 1, 2, 3, 4, 5}, f);
  // the force along local z bends about local y, I_y = 5
  EXPECT_NEAR(u[12], 3 * L * L * L / (3 * E * 5), 1e-12);
  EXPECT_NEAR(u[16], 3 * L * L / (2 * E * 5), 1e-12);
  EXPECT_NEAR(u[17], 13 * L / (80 * 11), 1e-12);
  const MemberSection at_root = cut(*frame, u, {}, 0, 0);
  EXPECT_NEAR(at_root.force[2], 3, 1e-11);
  EXPECT_NEAR(at_root.moment[0], 13, 1e-11);
  EXPECT_NEAR(std::abs(at_root.moment[1]), 3 * L, 1e-11);
  EXPECT_NEAR(at_root.moment[2], 0, 1e-11);

  f.tail(6) << 0, 3, 0, 0, 0, 0;
  u = solve(*frame, {0, 1, 2, 3, 4, 5}, f);
  EXPECT_NEAR(u[13], 3 * L * L * L / (3 * E * 7), 1e-12);
}

TEST(Frame, OrientationTurnsTheSection)
{
  const auto frame =
    make_frame(3,
               "Generator = line|"
               "Arguments = 0, 0, 0 : 0, 0, 4 : 2",
               std::string(beam_3d) + "|Orientation = 0, 1, 0");
  Eigen::VectorXd f = no_forces(*frame);
  f.tail(6) << 3, 0, 0, 0, 0, 0;
  const Eigen::VectorXd u = solve(*frame, {0, 1, 2, 3, 4, 5}, f);
  EXPECT_NEAR(u[12], 3 * L * L * L / (3 * E * 7), 1e-12);
}

TEST(Frame, FixedEndForces)
{
  const auto    frame = one_member();
  const Actions load = {{Action::Kind::line_load, {4}, {}, uniform(0, -6), {}}};
  Eigen::VectorXd f  = no_forces(*frame);
  ASSERT_TRUE(frame->add(Action::line_load({4}, uniform(0, -6)), f));
  EXPECT_NEAR(f[1], -6 * L / 2, 1e-13);
  EXPECT_NEAR(f[2], -6 * L * L / 12, 1e-13);
  EXPECT_NEAR(f[5], 6 * L * L / 12, 1e-13);
  const Eigen::VectorXd u = no_forces(*frame); // clamped at both ends
  EXPECT_NEAR(cut(*frame, u, load, 0, 0).moment[2], -6 * L * L / 12, 1e-12);
  EXPECT_NEAR(cut(*frame, u, load, 0, .5).moment[2], 6 * L * L / 24, 1e-12);
  EXPECT_NEAR(cut(*frame, u, load, 0, 0).force[1], -6 * L / 2, 1e-12);
  EXPECT_NEAR(cut(*frame, u, load, 0, 1).force[1], 6 * L / 2, 1e-12);
  EXPECT_NEAR(cut(*frame, u, load, 0, .5).displacement[1],
              -6 * pow(L, 4) / (384 * E * I),
              1e-14);

  // a force P at a: moments P a b^2/L^2, P a^2 b/L^2
  Eigen::VectorXd    g = no_forces(*frame);
  const Point<3>     at(1, 0, 0);
  const Tensor<1, 3> p({0., -8., 0.});
  ASSERT_TRUE(frame->add(Action::point_force(at, p), g));
  EXPECT_NEAR(g[2], -8. * 1 * 9 / 16, 1e-13);
  EXPECT_NEAR(g[5], 8. * 1 * 3 / 16, 1e-13);
  const Actions point = {
    {Action::Kind::point_force, {}, at, uniform(0, -8), {}}};
  EXPECT_NEAR(cut(*frame, u, point, 0, .25).moment[2],
              2 * 8. * 1 * 9 / 64,
              1e-12); // 2 P a^2 b^2/L^3
  EXPECT_FALSE(frame->add(Action::point_force({1, .1, 0}, p), g));
}

TEST(Frame, DeflectionsBetweenNodesAreExact)
{
  const auto    frame = one_member();
  const Actions line = {{Action::Kind::line_load, {4}, {}, uniform(3, -6), {}}};
  const auto    at = [&](const Frame &f, const double x, const Actions &load) {
    return f.deflection_between_nodes({x, 0, 0}, load);
  };
  for (const double x : {0., .3, 1., 2., 3.7, 4.})
    {
      EXPECT_NEAR(at(*frame, x, line)[1],
                  -6 * pow(x * (L - x), 2) / (24 * E * I),
                  1e-15);
      EXPECT_NEAR(at(*frame, x, line)[0], 3 * x * (L - x) / (2 * E * A), 1e-15);
    }
  const Actions point = {
    {Action::Kind::point_force, {}, {1, 0, 0}, uniform(0, -8), {}}};
  EXPECT_NEAR(at(*frame, 1, point)[1], -8. * 27 / (3 * E * I * 64), 1e-15);
  EXPECT_EQ(at(*frame, 2, {})[1], 0);
  EXPECT_EQ(frame->deflection_between_nodes({2, 1, 0}, line).norm(), 0);

  const auto hinged = one_member(", hinges");
  EXPECT_EQ(at(*hinged, 2, line)[1], 0); // a bar
  const auto propped = one_member(", hinge start");
  EXPECT_NEAR(at(*propped, 1, line)[1],
              -6 * (pow(L, 3) - 3 * L + 2) / (48 * E * I),
              1e-15);
}

TEST(Frame, DeflectionsAreThoseOfPictures)
{
  const auto all = frames();
  for (const unsigned int f : {1u, 2u})
    {
      const Actions load = {
        {Action::Kind::body_force, {}, {}, uniform(2, -3, f == 2 ? 4 : 0), {}},
        {Action::Kind::initial_strain, {}, {}, {}, [](const Point<3> &) {
           InitialStrain strain;
           strain.temperature = 5;
           return strain;
         }}};
      const Eigen::VectorXd u = no_forces(*all[f]);
      for (unsigned int m = 0; m < all[f]->all_members().size(); ++m)
        for (const double place : {.25, .5, .75})
          {
            const Point<3> p = all[f]->all_members()[m].point(place);
            if (f == 1 && (m == 0 || m == 5))
              continue; // the beam a-b and the bar b-a are in one place
            const auto found = all[f]->deflection_between_nodes(p, load);
            const auto drawn = cut(*all[f], u, load, m, place).displacement;
            for (unsigned int c = 0; c < 3; ++c)
              EXPECT_NEAR(found[c], drawn[c], 1e-13) << f << ' ' << m;
          }
    }
}

TEST(Frame, LinearLineLoadIsExact)
{
  const auto frame =
    make_frame(2, "Nodes = 1: 0, 0 ; 2: 4, 0|Members = 1-2: s", beam);
  Eigen::VectorXd f = no_forces(*frame);
  frame->add(Action::line_load({0},
                               [](const Point<3> &x, const Tensor<1, 3> &) {
                                 return Tensor<1, 3>({0., -x[0], 0.});
                               }),
             f);
  // cantilever, triangular load with its largest value q L at the tip
  const Eigen::VectorXd u = solve(*frame, {0, 1, 2}, f);
  EXPECT_NEAR(u[4], -11 * L * pow(L, 4) / (120 * E * I), 1e-12);
}

TEST(Frame, HingesPassNoMoment)
{
  // propped cantilever: reaction 3/8 q L, moment q L^2/8
  const auto    frame = make_frame(2,
                                "Nodes = 1: 0, 0 ; 2: 4, 0|"
                                   "Members = 1-2: s, hinge end",
                                beam);
  const Actions load = {{Action::Kind::line_load, {0}, {}, uniform(0, -6), {}}};
  Eigen::VectorXd f  = no_forces(*frame);
  frame->add(Action::line_load({0}, uniform(0, -6)), f);
  EXPECT_FALSE(frame->has_dof(1, 2));
  const Eigen::VectorXd u = solve(*frame, {0, 1, 2, 3, 4}, f);
  EXPECT_NEAR(f[4], -3 * 6 * L / 8, 1e-12);
  EXPECT_NEAR(cut(*frame, u, load, 0, 0).moment[2], -6 * L * L / 8, 1e-12);
  EXPECT_NEAR(cut(*frame, u, load, 0, 1).moment[2], 0, 1e-12);
  // w(x) = -q/(48 EI) (2 x^4 - 5 L x^3 + 3 L^2 x^2)
  const double x = 2;
  EXPECT_NEAR(cut(*frame, u, load, 0, .5).displacement[1],
              -6. / (48 * E * I) *
                (2 * pow(x, 4) - 5 * L * pow(x, 3) + 3 * L * L * x * x),
              1e-14);

  // a bar carries its own load as a simple beam
  const auto bar =
    make_frame(2, "Nodes = 1: 0, 0 ; 2: 4, 0|Members = 1-2: bar", beam);
  Eigen::VectorXd g = no_forces(*bar);
  bar->add(Action::line_load({0}, uniform(0, -6)), g);
  EXPECT_NEAR(g[1], -6 * L / 2, 1e-13);
  EXPECT_NEAR(cut(*bar, no_forces(*bar), load, 0, .5).moment[2],
              6 * L * L / 8,
              1e-12);
}

TEST(Frame, PortalUnderSideLoad)
{
  // Clamped columns (h = 4), beam (l = 6), the same section, E A large against
  // E I: H at the top gives the foot a moment H h/2 (3 k + 1)/(6 k + 1),
  // k = (I_b/I_c) (h/l).
  const auto      frame   = make_frame(2,
                                portal,
                                "Young modulus = 200|Area = 1e7|"
                                       "Moment of inertia = 5");
  Eigen::VectorXd f       = no_forces(*frame);
  f[3]                    = 12;
  const Eigen::VectorXd u = solve(*frame, {0, 1, 2, 9, 10, 11}, f);
  const double          k = 4. / 6;
  EXPECT_NEAR(std::abs(cut(*frame, u, {}, 0, 0).moment[2]),
              12 * 4 / 2. * (3 * k + 1) / (6 * k + 1),
              1e-5);
}

TEST(Frame, TrussOfTwoBars)
{
  // 45 degrees each, pulled down by P: N = P/sqrt(2)
  const auto      frame = make_frame(2,
                                "Nodes = 1: 0, 0 ; 2: 2, -2 ; 3: 4, 0|"
                                     "Members = 1-2-3: bar",
                                beam);
  Eigen::VectorXd f     = no_forces(*frame);
  EXPECT_EQ(frame->n_components(), 2u);
  frame->add(Action::point_force({2, -2, 0}, Tensor<1, 3>({0., -10., 0.})), f);
  const Eigen::VectorXd u = solve(*frame, {0, 1, 4, 5}, f);
  EXPECT_NEAR(cut(*frame, u, {}, 0, .5).force[0], 10 / sqrt(2.), 1e-12);
  EXPECT_NEAR(u[3], -10 * sqrt(8.) / (100 * 2), 1e-13);
}

TEST(Frame, WeightIsPerVolume)
{
  for (const auto &frame : frames())
    {
      Eigen::VectorXd f      = no_forces(*frame);
      double          volume = 0;
      for (const Member &member : frame->all_members())
        volume += member.section().area * member.length();
      const unsigned int n = frame->n_components();
      frame->add(Action::body_force([](const Point<3> &) {
                   return Tensor<1, 3>({0., -3., 0.});
                 }),
                 f);
      double sum = 0;
      for (unsigned int i = 0; i < frame->n_nodes(); ++i)
        sum += f[n * i + 1];
      EXPECT_NEAR(sum, -3 * volume, 1e-12 * volume);
    }
}

TEST(Frame, DoubleLayerGrids)
{
  const std::vector<std::pair<unsigned int, std::size_t>> bars = {{4, 128},
                                                                  {7, 392},
                                                                  {10, 800},
                                                                  {12, 1152}};
  for (const auto &[n, count] : bars)
    {
      const auto frame =
        make_frame(3,
                   "Generator = double layer grid|Arguments = " +
                     std::to_string(n) + " : 2, 3 : 2",
                   rod);
      EXPECT_EQ(frame->all_members().size(), count);
      const Surface lower = frame->surface({1}), upper = frame->surface({2});
      EXPECT_EQ(lower.nodes.size(), n * n);
      EXPECT_EQ(upper.nodes.size(), (n + 1) * (n + 1));
      EXPECT_EQ(lower.faces.size(), 2 * n * (n - 1));
      EXPECT_EQ(lower.nodes[0].normal[2], -1);
      EXPECT_EQ(upper.nodes[0].area, 1.5);
      EXPECT_EQ(upper.nodes[1].area, 3);
      EXPECT_EQ(upper.nodes[n + 2].area, 6);
      Point<3> centre;
      for (const SurfaceNode &node : lower.nodes)
        centre += Tensor<1, 3>(node.position);
      EXPECT_NEAR(centre.norm(), 0, 1e-12);

      Eigen::VectorXd f = no_forces(*frame);
      frame->add(Action::traction({2}, uniform(0, 0, -2)), f);
      EXPECT_NEAR(f.sum(), -2. * 6 * n * n, 1e-11);
      EXPECT_EQ(f[3 * upper.nodes[1].node + 2], -6);
    }
}

TEST(Frame, SurfacesAndTheirLoads)
{
  const auto    frame = make_frame(2, portal, beam);
  const Surface top   = frame->surface({5});
  ASSERT_EQ(top.nodes.size(), 2u);
  EXPECT_TRUE(top.two_sided);
  EXPECT_EQ(top.faces.size(), 1u);
  EXPECT_NEAR(top.nodes[0].area, 6 / 2. * 2, 1e-14);
  EXPECT_NEAR(top.nodes[0].normal[1], 1, 1e-14); // left of 2-3
  EXPECT_EQ(frame->boundary_ids(), (BoundaryIds{0, 5}));

  Eigen::VectorXd f = no_forces(*frame), g = f;
  frame->add(Action::traction({5}, uniform(0, -1)), f);
  frame->add(Action::line_load({5}, uniform(0, -2)), g);
  EXPECT_NEAR((f - g).norm(), 0, 1e-13);
  EXPECT_NE(f[5], 0); // fixed-end moment

  // a single node has half of its members' length
  const auto foot =
    make_frame(2, "Nodes = 1: 0, 0 : 7 ; 2: 0, 4|Members = 1-2: s", beam);
  EXPECT_NEAR(foot->surface({7}).nodes.at(0).area, 2 * 2, 1e-14);
  EXPECT_FALSE(foot->add(Action::line_load({7}, uniform(1, 0)), f));
}

TEST(Frame, DividedMembersAreLoadedWholeOrNot)
{
  const auto loaded = [](const std::string &ids) {
    const auto frame =
      make_frame(2,
                 "Nodes = 1: 0, 0 ; 2: 4, 0 ; 3: 8, 0|"
                 "Members = 1-2-3: s, elements 4|Boundary ids = " +
                   ids,
                 beam);
    Eigen::VectorXd f = no_forces(*frame);
    frame->add(Action::line_load({0}, uniform(0, -1)), f);
    double sum = 0;
    for (unsigned int i = 0; i < frame->n_nodes(); ++i)
      sum += f[frame->n_components() * i + 1];
    return sum;
  };
  EXPECT_NEAR(loaded("1: x < 1"), -4, 1e-13);
  EXPECT_NEAR(loaded("1: x < 1 ; 2: x > 7"), 0, 0);
  EXPECT_NEAR(loaded("1: x < 1 ; 2: abs(x - 4) < .1 ; 3: x > 7"), 0, 0);
  EXPECT_NEAR(loaded("1: abs(x - 6) < .1"), -8, 1e-13);
}

TEST(Frame, TemperatureWithoutForce)
{
  for (const auto &frame : frames())
    {
      if (frame->all_members()[0].section().expansion == 0)
        continue;
      Eigen::VectorXd f = no_forces(*frame);
      EXPECT_TRUE(frame->add(Action::initial_strains([](const Point<3> &) {
                               return InitialStrain{{}, 30.};
                             }),
                             f));
    }
  // a bar that is free expands, one that is held is pressed
  const auto bar =
    make_frame(2, "Generator = line|Arguments = 0, 0 : 4, 0 : 2", beam);
  const Actions heat = {
    {Action::Kind::initial_strain, {}, {}, {}, [](const Point<3> &x) {
       return InitialStrain{{}, 15 * x[0]};
     }}};
  Eigen::VectorXd f = no_forces(*bar);
  bar->add(Action::initial_strains(heat[0].strain), f);
  const Eigen::VectorXd u = solve(*bar, {0, 1, 2}, f);
  EXPECT_NEAR(u[6], .01 * 30 * 4, 1e-12);
  for (const double s : {0., .5, 1.})
    EXPECT_NEAR(cut(*bar, u, heat, 1, s).force[0], 0, 1e-11);
  const Eigen::VectorXd held = solve(*bar, {0, 1, 2, 6, 7, 8}, f);
  EXPECT_NEAR(cut(*bar, held, heat, 0, 1).force[0], -E * A * .01 * 30, 1e-11);
}

TEST(Frame, InitialStrainCountsAlongMembers)
{
  const auto bar =
    make_frame(2, "Generator = line|Arguments = 0, 0 : 3, 4 : 1", beam);
  Tensor<2, 3> strain;
  strain[0][0] = .02;
  strain[1][1] = -.01;
  strain[0][1] = strain[1][0] = .005;
  const double  along         = .36 * .02 - .64 * .01 + 2 * .48 * .005;
  const Actions swelling      = {
         {Action::Kind::initial_strain, {}, {}, {}, [strain](const Point<3> &) {
       return InitialStrain{strain, 0};
     }}};
  Eigen::VectorXd f = no_forces(*bar);
  EXPECT_TRUE(bar->add(Action::initial_strains(swelling[0].strain), f));
  const Eigen::VectorXd held = no_forces(*bar);
  EXPECT_NEAR(cut(*bar, held, swelling, 0, .5).force[0], -E * A * along, 1e-11);
  EXPECT_NEAR(f[3], .6 * E * A * along, 1e-11);
  EXPECT_NEAR(f[4], .8 * E * A * along, 1e-11);
}

TEST(Frame, FileAndListAreTheSame)
{
  const std::string file = write_file("frame.csv",
                                      "# a portal\n"
                                      "node, 1, 0, 0\nnode, 2, 0, 4, 5\n"
                                      "node, 3, 6, 4, 5, 6  # head\n\n"
                                      "node, 4, 6, 0\n"
                                      "member, 1, 2, s\nmember, 2, 3, s\n"
                                      "member, 3, 4, s, hinge end, group 9\n");
  const auto        a    = make_frame(2, "File = " + file, beam);
  const auto        b    = make_frame(2,
                            "Nodes = 1: 0, 0 ; 2: 0, 4 : 5 ; 3: 6, 4 : 5, 6 ; "
                                      "4: 6, 0 ;|Members = 1-2-3: s ; "
                                      "3-4: s, group 9, hinge end",
                            beam);
  EXPECT_EQ(stiffness(*a), stiffness(*b));
  EXPECT_EQ(a->boundary_ids(), (BoundaryIds{0, 5, 6, 9}));
  EXPECT_EQ(a->surface({9}).faces.size(), 1u);
}

TEST(Frame, WrongInputIsASentence)
{
  const std::string nodes = "Nodes = 1: 0, 0 ; 2: 4, 0 ; 3: 0, 0|";
  struct Case
  {
    std::string geometry, section, expected;
  };
  const std::vector<Case> cases = {
    {"Members = 1-2: s", beam, "there is no frame"},
    {nodes + "Members = 1-7: s", beam, "there is no node '7'"},
    {nodes + "Members = 1-3: s", beam, "has no length"},
    {nodes + "Members = 1-2: t", beam, "there is no section 't'"},
    {nodes + "Members = 1-2:", beam, "section is missing"},
    {nodes + "Members =", beam, "there are none"},
    {nodes + "Members = 1-2: s", beam, "node '3' belongs to no member"},
    {nodes + "Members = 1-2-3: s, stiff", beam, "'stiff' is no option"},
    {"Nodes = 1: 0, 0 ; 1: 4, 0", beam, "node '1' is defined twice"},
    {"Nodes = 1: 0, 0, 0", beam, "Give 2 numbers"},
    {"Generator = cube", beam, "there is no 'cube'"},
    {"Generator = line|Arguments = 0, 0 : 1, 0", beam, "'line' takes"},
    {"Generator = double layer grid", beam, "needs Dimension = 3"},
    {portal, "Young modulus = 0|Area = 1", "Young modulus: 0 is not positive"},
    {portal, "Young modulus = 1|Area = -1", "Area: -1 is not positive"},
    {portal,
     "Young modulus = 1|Area = 1|Moment of inertia = 0",
     "Moment of inertia: 0 is not positive"},
    {std::string(portal) + " ; 6: y > 9", beam, "no node satisfies 'y > 9'"}};
  for (const auto &[geometry, section, expected] : cases)
    try
      {
        make_frame(2, geometry, section);
        ADD_FAILURE() << geometry;
      }
    catch (const InputError &error)
      {
        EXPECT_NE(std::string(error.what()).find(expected), std::string::npos)
          << error.what();
      }
}

TEST(Frame, NodesOfBarsInLineAreNamed)
{
  const auto chain =
    make_frame(2,
               "Nodes = 1: 0, 0 ; 2: 1, 0 ; 3: 2, 0|Members = 1-2-3: bar",
               beam);
  EXPECT_NE(chain->weakness(1).find("in one line"), std::string::npos);
  const auto plate = make_frame(3,
                                "Nodes = 1: 0, 0, 0 ; 2: 1, 0, 0 ; 3: 0, 1, 0|"
                                "Members = 1-2-3-1: bar",
                                beam);
  EXPECT_NE(plate->weakness(1).find("in one plane"), std::string::npos);
  EXPECT_EQ(make_frame(2, portal, beam)->weakness(1), "");
}

TEST(Frame, PicturesAreWritten)
{
  for (const auto &frame : frames())
    {
      const auto file = folder() / "frame.vtu";
      write_graphics(*frame, no_forces(*frame), 2., file);
      EXPECT_GT(std::filesystem::file_size(file), 500u);
    }
}
