// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_cell_matrices_h
#define conetact_bodies_continuum_cell_matrices_h

#include "conetact/bodies/continuum/cell_shapes.h"
#include "conetact/bodies/continuum/elements.h"

#include <vector>

namespace conetact::bodies
{
  /**
   * Stiffness matrices of all cells of a mesh. Cells of one material that are
   * translated copies of each other have the same: it is computed once, and
   * kept. Matrices of single cells are kept if there is room for all of them.
   */
  template <int dim>
  class CellMatrices : public Elements
  {
  public:
    using Element = ElementFormulation<dim>;

    /**
     * Mesh and phases must live longer than this object; thickness 1 in 3D.
     */
    CellMatrices(const ContinuumMesh<dim> &of_mesh,
                 const Phases<dim>        &materials,
                 const double              thickness);

    void
    for_each(const ElementVisitor &visit) const override
    {
      visit_cells(nullptr, visit);
    }
    void
    for_each_at(const SomeNodes      &nodes,
                const ElementVisitor &visit) const override
    {
      visit_cells(&nodes, visit);
    }
    void
    for_each_connection(const ConnectionVisitor &visit) const override;
    void
    for_each_connection_at(const SomeNodes         &nodes,
                           const ConnectionVisitor &visit) const override;
    /**
     * What a cell's first node moves is taken out before its matrix acts:
     * forces of cells that hardly strain keep their digits and their sum of
     * zero, however far they move. Neighbours of one shape are multiplied
     * together.
     */
    void
    add_forces(const Eigen::VectorXd &u, Eigen::VectorXd &f) const override
    {
      multiply_cells(nullptr, u, f);
    }
    std::size_t
    add_forces_at(const SomeNodes       &nodes,
                  const Eigen::VectorXd &u,
                  Eigen::VectorXd       &f) const override
    {
      return multiply_cells(&nodes, u, f);
    }
    double
    largest_stretch(const Eigen::VectorXd &u) const override;
    /** Cells that are translated copies of each other are congruent. */
    Count
    count() const override
    {
      return {mesh.n_cells(), static_cast<unsigned int>(shapes.all().size())};
    }

    const CellShapes<dim> &
    cell_shapes() const
    {
      return shapes;
    }

  private:
    using Matrix = typename Element::Matrix;
    /** A column for each cell, its vertices' values or forces. */
    using Columns = Eigen::MatrixXd;

    const ContinuumMesh<dim> &mesh;
    const Phases<dim>        &phases;
    bool                      is_ring; ///< round an axis
    double                    thickness;
    CellShapes<dim>           shapes;
    std::vector<int>          kept; ///< matrix of each shape, -1: none
    std::vector<Matrix>       matrices;

    /** Of cells that have some of these nodes; null: of all. */
    void
    visit_cells(const SomeNodes *nodes, const ElementVisitor &visit) const;
    /** Returns how many cells were multiplied. */
    std::size_t
    multiply_cells(const SomeNodes       *nodes,
                   const Eigen::VectorXd &u,
                   Eigen::VectorXd       &f) const;
    /** u of cells in a row, relative to that of their first vertices. */
    Columns
    strained(const unsigned int     first,
             const unsigned int     end,
             const Eigen::VectorXd &u) const;
    bool
    has_some(const unsigned int cell, const SomeNodes *nodes) const;
    /** Calls visit(cell, its dofs). */
    template <typename Visit>
    void
    for_each_cell(const SomeNodes *nodes, const Visit &visit) const;
    /** The same of some cells of one shape, one behind the other. */
    void
    add_forces_of_run(const unsigned int     first,
                      const unsigned int     end,
                      const Eigen::VectorXd &u,
                      Columns               &forces,
                      Eigen::VectorXd       &f) const;
    void
    keep_matrices();
    const Matrix *
    find_kept(const unsigned int cell) const;
    Matrix
    compute(const unsigned int cell) const;
  };
} // namespace conetact::bodies

#endif
