// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Forces of loads on nodes, springs of foundations.

#include "conetact/bodies/continuum/boundary_faces.h"
#include "conetact/bodies/continuum/continuum.h"
#include "conetact/bodies/continuum/point_search.h"

#include <deal.II/fe/fe_values.h>

namespace conetact::bodies
{
  using namespace dealii;

  template <int dim>
  void
  Continuum<dim>::add_traction(const BoundaryIds  &ids,
                               const SurfaceField &traction,
                               Eigen::VectorXd    &f) const
  {
    faces->for_each(mesh, ids, [&](const auto &face, const auto &fe) {
      for (const unsigned int q : fe.quadrature_point_indices())
        distribute(
          face.nodes,
          [&](const unsigned int v) {
            return fe.shape_value(face.in_cell[v], q);
          },
          extent(fe.quadrature_point(q)) * fe.JxW(q) *
            traction(to_space(fe.quadrature_point(q)),
                     to_space(fe.normal_vector(q))),
          f);
    });
    clear_axis(f);
  }

  template <int dim>
  void
  Continuum<dim>::add_body_force(const VectorField &force,
                                 Eigen::VectorXd   &f) const
  {
    NodeMapping<dim> mapping(*element);
    FEValues<dim>    fe_values(mapping,
                            *element,
                            quadrature,
                            update_values | update_quadrature_points |
                              update_JxW_values);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        fe_values.reinit(mapping.cell_at(mesh.vertices(c)));
        for (const unsigned int q : fe_values.quadrature_point_indices())
          distribute(
            mesh.cell(c),
            [&](const unsigned int v) { return fe_values.shape_value(v, q); },
            extent(fe_values.quadrature_point(q)) * fe_values.JxW(q) *
              force(to_space(fe_values.quadrature_point(q))),
            f);
      }
    clear_axis(f);
  }

  /* By the shape functions of the cell, which keep the force and its moment
     about any point. */
  template <int dim>
  bool
  Continuum<dim>::add_point_force(const Point<3>     &point,
                                  const Tensor<1, 3> &force,
                                  Eigen::VectorXd    &f) const
  {
    Point<dim> p;
    for (unsigned int d = 0; d < dim; ++d)
      p[d] = point[d];
    if (point.distance(to_space(p)) > 0) // off the plane of a 2D body
      return false;
    const auto place = find_cell(mesh, *element, p);
    if (!place)
      return false;
    distribute(
      mesh.cell(place->cell),
      [&](const unsigned int v) { return place->shapes[v]; },
      force,
      f);
    clear_axis(f);
    return true;
  }

  template <int dim>
  void
  Continuum<dim>::visit_springs(const BoundaryIds        &ids,
                                const SurfaceTensorField &stiffness,
                                const ElementVisitor     &visit) const
  {
    faces->for_each(mesh, ids, [&](const auto &face, const auto &fe) {
      const auto      n = dim * static_cast<unsigned int>(face.nodes.size());
      Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
      for (const unsigned int q : fe.quadrature_point_indices())
        {
          const Tensor<2, 3> s = extent(fe.quadrature_point(q)) * fe.JxW(q) *
                                 stiffness(to_space(fe.quadrature_point(q)),
                                           to_space(fe.normal_vector(q)));
          const auto shape = [&](const unsigned int i) {
            return fe.shape_value(face.in_cell[i / dim], q);
          };
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j <= i; ++j)
              // int N^T s N: springs spread over the face, not set at its
              // nodes.
              k(i, j) += shape(i) * shape(j) * s[i % dim][j % dim];
        }
      // Half is computed and copied: symmetric to the last bit.
      k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();

      std::vector<unsigned int> dofs;
      for (const unsigned int node : face.nodes)
        for (unsigned int c = 0; c < dim; ++c)
          dofs.push_back(dim * node + c);
      visit(dofs, k.data());
    });
  }



  template <int dim>
  bool
  Continuum<dim>::add_initial_strain(const InitialStrainField &strain,
                                     Eigen::VectorXd          &f) const
  {
    using Element = ElementFormulation<dim>;
    std::vector<InitialStrain> at_nodes;
    for (const Point<dim> &node : mesh.nodes)
      at_nodes.push_back(strain(to_space(node)));
    const unsigned int n = mesh.n_cell_nodes;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto                cell  = mesh.cell(c);
        const Phase<dim>         &phase = phases[mesh.phase(c)];
        typename Element::Strains strains(Element::n_strains, n);
        for (unsigned int v = 0; v < n; ++v)
          strains.col(v) =
            strain_components(at_nodes[cell[v]].of(phase.material.expansion),
                              dim);
        // Forces int B^T C eps: they would strain the cell by eps if nothing
        // resisted. They sum to zero in each cell.
        const typename Element::Displacements forces =
          thickness * phase.element->forces(mesh.vertices(c), strains);
        for (unsigned int i = 0; i < dim * n; ++i)
          f[dim * cell[i / dim] + i % dim] += forces[i];
      }
    return true;
  }

  // Of members, for the class has others elsewhere.
#define CONETACT_INSTANTIATE(dim)                                              \
  template void Continuum<dim>::add_traction(const BoundaryIds &,              \
                                             const SurfaceField &,             \
                                             Eigen::VectorXd &) const;         \
  template void Continuum<dim>::add_body_force(const VectorField &,            \
                                               Eigen::VectorXd &) const;       \
  template bool Continuum<dim>::add_point_force(const Point<3> &,              \
                                                const Tensor<1, 3> &,          \
                                                Eigen::VectorXd &) const;      \
  template void Continuum<dim>::visit_springs(const BoundaryIds &,             \
                                              const SurfaceTensorField &,      \
                                              const ElementVisitor &) const;   \
  template bool Continuum<dim>::add_initial_strain(const InitialStrainField &, \
                                                   Eigen::VectorXd &) const;
  CONETACT_INSTANTIATE(2)
  CONETACT_INSTANTIATE(3)
#undef CONETACT_INSTANTIATE
} // namespace conetact::bodies
