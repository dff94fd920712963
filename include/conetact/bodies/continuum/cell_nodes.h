// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_cell_nodes_h
#define conetact_bodies_continuum_cell_nodes_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <functional>
#include <vector>

namespace conetact::bodies
{
  /**
   * Where a mesh file of second order has the nodes of its cells, which
   * deal.II's Triangulation does not keep. make_mesh() fills it; `of_cell(c)`
   * are then the places of the nodes of an active cell c in the scene, which
   * make its curved geometry.
   */
  template <int dim>
  struct CellNodes
  {
    using Cell  = typename dealii::Triangulation<dim>::cell_iterator;
    using Nodes = std::vector<dealii::Point<dim>>;

    /**
     * By the index of a coarse cell, in the order of the support points of
     * FE_Q(2) or FE_SimplexP(2): vertices, middles of lines, of faces, of the
     * cell. Empty: the file is of first order, or there is none.
     */
    std::vector<Nodes> coarse;
    /** By the index of an active cell, of a generated mesh: on its curved
     * geometry (manifold_nodes.h). Empty: the same. */
    std::vector<Nodes> active;

    bool
    empty() const
    {
      return coarse.empty() && active.empty();
    }

    /**
     * Of a cell, in that order. A refined cell has them on the curve of its
     * coarse cell, which must have nodes.
     */
    Nodes
    of_cell(const Cell &cell) const;

    /** Moves all nodes. */
    void
    transform(
      const std::function<dealii::Point<dim>(const dealii::Point<dim> &)>
        &move);
  };

  /**
   * The nodes of a mesh that is not refined. `middle` is told the numbers of
   * two vertices and gives the place of the node halfway between them: on an
   * edge, or on the diagonal of a face or of a cell.
   */
  template <int dim>
  CellNodes<dim>
  make_cell_nodes(
    const dealii::Triangulation<dim>                            &mesh,
    const std::function<dealii::Point<dim>(const unsigned int,
                                           const unsigned int)> &middle);

  /** Puts the vertices of refined cells onto the curves of their coarse cells.
   */
  template <int dim>
  void
  bend_refined_cells(const CellNodes<dim>       &nodes,
                     dealii::Triangulation<dim> &mesh);
} // namespace conetact::bodies

#endif
