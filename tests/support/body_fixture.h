// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_body_fixture_h
#define conetact_tests_body_fixture_h

#include "conetact/base/errors.h"
#include "conetact/bodies/body_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "files.h"

/** Bodies from the text of a scene, and sums over them. */
namespace conetact::test
{
  using namespace bodies;

  /** Of "entry = value" separated by '|', the lines of a scene. */
  inline std::string
  lines(const std::string &entries)
  {
    std::string text = "set ";
    for (const char c : entries)
      text += c == '|' ? std::string("\nset ") : std::string(1, c);
    return text;
  }

  /** Mesh and material as entries separated by '|'. */
  inline std::unique_ptr<Structure>
  make_body(const unsigned int dim,
            const std::string &mesh,
            const std::string &material = "Young modulus = 5|"
                                          "Poisson ratio = 0.3",
            const std::string &element  = "Q1")
  {
    dealii::ParameterHandler prm;
    declare_body(prm);
    prm.parse_input_from_string(
      "set Element = " + element + "\nsubsection Mesh\n" + lines(mesh) +
      "\nend\nsubsection Material\n" + lines(material) + "\nend\n");
    return create_body(prm, dim, folder(), "block");
  }

  /** Name of a mesh file: the unit square or cube in n cells a direction. */
  inline std::string
  write_distorted_mesh(const unsigned int dim, const unsigned int n)
  {
    const unsigned int m = n + 1, layers = dim == 3 ? m : 1;
    const auto         inside = [n](const unsigned int i) {
      return i > 0 && i < n ? .25 / n : 0.;
    };
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" +
                       std::to_string(m * m * layers) + "\n";
    for (unsigned int k = 0, id = 1; k < layers; ++k)
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < m; ++i, ++id)
          text +=
            std::to_string(id) + " " +
            std::to_string(double(i) / n + inside(i) * sin(3. * id)) + " " +
            std::to_string(double(j) / n + inside(j) * cos(5. * id)) + " " +
            std::to_string(double(k) / n + inside(k) * sin(7. * id)) + "\n";
    const unsigned int n_layers = dim == 3 ? n : 1;
    text += "$EndNodes\n$Elements\n" + std::to_string(n * n * n_layers) + "\n";
    for (unsigned int k = 0, id = 1; k < n_layers; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i, ++id)
          {
            text += std::to_string(id) + (dim == 3 ? " 5" : " 3") + " 2 1 1";
            for (unsigned int l = 0; l < dim - 1; ++l)
              for (const unsigned int v : {0u, 1u, 1 + m, m})
                text += " " + std::to_string(1 + i + m * (j + m * (k + l)) + v);
            text += "\n";
          }
    return write_file("distorted" + std::to_string(dim) + ".msh",
                      text + "$EndElements\n");
  }

  using Field = std::function<Tensor<1, 3>(const Point<3> &)>;

  inline Eigen::VectorXd
  interpolate(const Structure &body, const Field &field)
  {
    Eigen::VectorXd u(body.n_dofs());
    for (unsigned int i = 0; i < body.n_nodes(); ++i)
      for (unsigned int c = 0; c < body.n_components(); ++c)
        u[body.n_components() * i + c] = field(body.position(i))[c];
    return u;
  }

  inline Eigen::MatrixXd
  stiffness(const Structure &body)
  {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(body.n_dofs(), body.n_dofs());
    body.elements().for_each(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        for (std::size_t i = 0; i < dofs.size(); ++i)
          for (std::size_t j = 0; j < dofs.size(); ++j)
            k(dofs[i], dofs[j]) += matrix[i * dofs.size() + j];
      });
    return k;
  }

  /** Forces K u; those on hanging nodes go to the nodes they follow. */
  inline Eigen::VectorXd
  internal_forces(const Structure &body, const Eigen::VectorXd &u)
  {
    const unsigned int n = body.n_components();
    Eigen::VectorXd    f = stiffness(body) * u;
    for (const HangingNode &node : body.hanging_nodes())
      {
        for (const auto &[master, weight] : node.masters)
          f.segment(n * master, n) += weight * f.segment(n * node.node, n);
        f.segment(n * node.node, n).setZero();
      }
    return f;
  }

  /** Sum of nodal forces, and of their moments about a point. */
  struct Sums
  {
    Tensor<1, 3> force, moment;
    Sums(const Structure       &body,
         const Eigen::VectorXd &f,
         const Point<3>        &about = Point<3>())
    {
      for (unsigned int i = 0; i < body.n_nodes(); ++i)
        {
          Tensor<1, 3> p;
          for (unsigned int c = 0; c < body.n_components(); ++c)
            p[c] = f[body.n_components() * i + c];
          force += p;
          moment += cross_product_3d(body.position(i) - about, p);
        }
    }
  };
} // namespace conetact::test

#endif
