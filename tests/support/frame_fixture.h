// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_frame_fixture_h
#define conetact_tests_frame_fixture_h

#include "conetact/bodies/frame/frame.h"

#include <Eigen/Dense>

#include "body_fixture.h"

/** Frames from the text of a scene, loaded and held without contact. */
namespace conetact::test
{
  using namespace bodies;

  /** Entries of subsections Frame and Section s, separated by '|'. */
  inline std::unique_ptr<Frame>
  make_frame(const unsigned int dim,
             const std::string &geometry,
             const std::string &section)
  {
    dealii::ParameterHandler prm;
    declare_body(prm);
    prm.parse_input_from_string(
      "set Kind = frame\nset Sections = s, bar\nsubsection Frame\n" +
      lines(geometry) + "\nend\nsubsection Section s\n" + lines(section) +
      "\nend\nsubsection Section bar\nset Young modulus = 100\n"
      "set Area = 2\nend\n");
    auto body = create_body(prm, dim, folder(), "frame");
    return std::unique_ptr<Frame>(dynamic_cast<Frame *>(body.release()));
  }

  /** K u = f with some dofs held at zero; dofs of no element stay zero. */
  inline Eigen::VectorXd
  solve(const Structure                 &body,
        const std::vector<unsigned int> &held,
        const Eigen::VectorXd           &f)
  {
    Eigen::MatrixXd    k    = stiffness(body);
    Eigen::VectorXd    g    = f;
    const unsigned int n    = body.n_components();
    const auto         hold = [&](const unsigned int i) {
      k.row(i).setZero();
      k.col(i).setZero();
      k(i, i) = 1;
      g[i]    = 0;
    };
    for (const unsigned int i : held)
      hold(i);
    for (unsigned int i = 0; i < body.n_nodes(); ++i)
      for (unsigned int c = 0; c < n; ++c)
        if (!body.has_dof(i, c))
          hold(n * i + c);
    return k.fullPivLu().solve(g);
  }

  inline Eigen::VectorXd
  no_forces(const Structure &body)
  {
    return Eigen::VectorXd::Zero(body.n_dofs());
  }

  inline SurfaceField
  uniform(const double x, const double y, const double z = 0)
  {
    return [=](const Point<3> &, const Tensor<1, 3> &) {
      return Tensor<1, 3>({x, y, z});
    };
  }
} // namespace conetact::test

#endif
