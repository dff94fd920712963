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

  namespace
  {
    /** f += N^T value, at a point where the nodes have these shape values. */
    template <int dim, class Nodes, class Shape>
    void
    distribute(const Nodes        &nodes,
               const Shape        &shape,
               const Tensor<1, 3> &value,
               Eigen::VectorXd    &f)
    {
      for (unsigned int v = 0; v < nodes.size(); ++v)
        for (unsigned int c = 0; c < dim; ++c)
          f[dim * nodes[v] + c] += shape(v) * value[c];
    }

    template <int dim>
    void
    add_traction(const ContinuumMesh<dim> &mesh,
                 const BoundaryFaces<dim> &faces,
                 const Extent<dim>        &extent,
                 const Action             &action,
                 Eigen::VectorXd          &f)
    {
      faces.for_each(mesh, action.ids, [&](const auto &face, const auto &fe) {
        for (const unsigned int q : fe.quadrature_point_indices())
          distribute<dim>(
            face.nodes,
            [&](const unsigned int v) {
              return fe.shape_value(face.in_cell[v], q);
            },
            extent(fe.quadrature_point(q)) * fe.JxW(q) *
              action.force(to_space(fe.quadrature_point(q)),
                           to_space(fe.normal_vector(q))),
            f);
      });
    }

    template <int dim>
    void
    add_body_force(const ContinuumMesh<dim>              &mesh,
                   const dealii::FiniteElement<dim, dim> &element,
                   const dealii::Quadrature<dim>         &quadrature,
                   const Extent<dim>                     &extent,
                   const Action                          &action,
                   Eigen::VectorXd                       &f)
    {
      NodeMapping<dim> mapping(element);
      FEValues<dim>    fe_values(mapping,
                              element,
                              quadrature,
                              update_values | update_quadrature_points |
                                update_JxW_values);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          fe_values.reinit(mapping.cell_at(mesh.vertices(c)));
          for (const unsigned int q : fe_values.quadrature_point_indices())
            distribute<dim>(
              mesh.cell(c),
              [&](const unsigned int v) { return fe_values.shape_value(v, q); },
              extent(fe_values.quadrature_point(q)) * fe_values.JxW(q) *
                action.force(to_space(fe_values.quadrature_point(q)), {}),
              f);
        }
    }

    /* By the shape functions of the cell, which keep the force and its moment
       about any point. */
    template <int dim>
    bool
    add_point_force(const ContinuumMesh<dim>              &mesh,
                    const dealii::FiniteElement<dim, dim> &element,
                    const Action                          &action,
                    Eigen::VectorXd                       &f)
    {
      const Point<3> &point = action.point;
      Point<dim>      p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = point[d];
      if (point.distance(to_space(p)) > 0) // off the plane of a 2D body
        return false;
      const auto place = find_cell(mesh, element, p);
      if (!place)
        return false;
      distribute<dim>(
        mesh.cell(place->cell),
        [&](const unsigned int v) { return place->shapes[v]; },
        action.force(point, {}),
        f);
      return true;
    }

    template <int dim>
    void
    add_initial_strain(const ContinuumMesh<dim> &mesh,
                       const Phases<dim>        &phases,
                       const double              thickness,
                       const InitialStrainField &strain,
                       Eigen::VectorXd          &f)
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
    }
  } // namespace

  template <int dim>
  bool
  Continuum<dim>::add(const Action &action, Eigen::VectorXd &f) const
  {
    switch (action.kind)
      {
        case Action::Kind::traction:
          add_traction(mesh, *faces, extent, action, f);
          break;
        case Action::Kind::body_force:
          add_body_force(mesh, *element, quadrature, extent, action, f);
          break;
        case Action::Kind::point_force:
          if (!add_point_force(mesh, *element, action, f))
            return false;
          break;
        case Action::Kind::initial_strain:
          add_initial_strain(mesh, phases, extent.thickness, action.strain, f);
          return true;
        default: // there are no members
          return false;
      }
    // Nodes on the axis do not move radially: no force acts on them there.
    for (std::size_t i = 0; extent.is_ring && i < mesh.nodes.size(); ++i)
      if (mesh.nodes[i][0] == 0)
        f[static_cast<Eigen::Index>(dim * i)] = 0;
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


  // Of members, for the class has others elsewhere.
#define CONETACT_INSTANTIATE(dim)                                             \
  template bool Continuum<dim>::add(const Action &, Eigen::VectorXd &) const; \
  template void Continuum<dim>::visit_springs(const BoundaryIds &,            \
                                              const SurfaceTensorField &,     \
                                              const ElementVisitor &) const;
  CONETACT_INSTANTIATE(2)
  CONETACT_INSTANTIATE(3)
#undef CONETACT_INSTANTIATE
} // namespace conetact::bodies
