// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_discretization_h
#define conetact_bodies_continuum_discretization_h

#include "conetact/bodies/continuum/cell_nodes.h"
#include "conetact/bodies/structure.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <vector>

namespace conetact::bodies
{
  /**
   * Displacements of first or second degree on a mesh of quadrilaterals or
   * hexahedra (FE_Q) or of triangles or tetrahedra (FE_SimplexP): each node
   * (vertex, middle of an edge, face or cell) has all components, and dof
   * `dim * i + c` is component c of node i. Nodes at vertices alone, none of
   * which hangs, are numbered as deal.II numbers them, but without its
   * DoFHandler, which takes a third of the memory of the mesh.
   */
  template <int dim>
  struct Discretization
  {
    using CellIterator =
      typename dealii::Triangulation<dim>::active_cell_iterator;

    /** Of a finished mesh, whose cells are all of one kind. */
    explicit Discretization(
      std::unique_ptr<dealii::Triangulation<dim>> finished_mesh,
      const unsigned int                          degree = 1,
      const CellNodes<dim>                       &nodes  = {});

    bool
    has_simplices() const
    {
      return !triangulation->all_reference_cells_are_hyper_cube();
    }
    unsigned int
    n_nodes() const;
    /** Of a cell, in deal.II's order. */
    std::vector<unsigned int>
    nodes_of(const CellIterator &cell) const;
    /** Of one of its faces, in the order of the face. */
    std::vector<unsigned int>
    nodes_of_face(const CellIterator &cell, const unsigned int face) const;
    /** Where they stand; without nodes given of second degree, edges are
     * straight. */
    std::vector<dealii::Point<dim>>
    places_of(const CellIterator &cell) const;
    /** Nodes that follow others; none of those hangs itself. */
    std::vector<HangingNode>
    hanging_nodes() const;

    std::unique_ptr<dealii::Triangulation<dim>> triangulation;
    const dealii::Mapping<dim>                 &mapping; ///< of straight cells
    dealii::FESystem<dim>                       fe;
    /** Without dofs where vertices are all nodes. */
    dealii::DoFHandler<dim>           dof_handler;
    dealii::AffineConstraints<double> constraints; ///< hanging nodes
    dealii::Quadrature<dim>           quadrature;  ///< degree + 1 points
    CellNodes<dim> given; ///< places of nodes, if edges are bent

  private:
    void
    number_vertices();
    /** The same cell, with its dofs. */
    typename dealii::DoFHandler<dim>::active_cell_iterator
    with_dofs(const CellIterator &cell) const;

    std::vector<unsigned int> node_of_vertex; ///< empty: dof_handler knows
    unsigned int              n_vertices = 0; ///< that cells have
  };
} // namespace conetact::bodies

#endif
