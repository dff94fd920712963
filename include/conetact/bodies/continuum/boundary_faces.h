// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_boundary_faces_h
#define conetact_bodies_continuum_boundary_faces_h

#include "conetact/bodies/continuum/discretization.h"

#include <deal.II/fe/fe_values.h>

#include <memory>

namespace conetact::bodies
{
  /**
   * The faces of a body's boundary, with the cells behind them and no others:
   * what surfaces and their loads need of a mesh, which is a small part of it.
   */
  template <int dim>
  class BoundaryFaces
  {
  public:
    struct Face
    {
      unsigned int              cell;   ///< number among the cells kept here
      unsigned int              number; ///< of the face in its cell
      unsigned int              id;     ///< boundary id
      std::vector<unsigned int> nodes;  ///< in deal.II's order
      std::vector<unsigned int> shapes; ///< of the nodes, first component
    };

    explicit BoundaryFaces(const Discretization<dim> &body);

    BoundaryIds
    ids() const;

    /** Calls visit(face, FEFaceValues) for each face that has one of the ids.
     */
    template <class Visitor>
    void
    for_each(const BoundaryIds &wanted, const Visitor &visit) const
    {
      dealii::FEFaceValues<dim> values(mapping,
                                       *fe,
                                       quadrature,
                                       dealii::update_values |
                                         dealii::update_quadrature_points |
                                         dealii::update_normal_vectors |
                                         dealii::update_JxW_values);
      for (const Face &face : faces)
        if (wanted.count(face.id) > 0)
          {
            values.reinit(cell(face), face.number);
            visit(face, values);
          }
    }

  private:
    typename dealii::Triangulation<dim>::cell_iterator
    cell(const Face &face) const
    {
      return {&cells, 0, static_cast<int>(face.cell)};
    }
    Face
    make_face(const Discretization<dim>                        &body,
              const typename Discretization<dim>::CellIterator &cell,
              const unsigned int                                number) const;
    void
    keep_cells(
      const std::vector<typename Discretization<dim>::CellIterator> &kept);

    const dealii::Mapping<dim>                             &mapping;
    const std::unique_ptr<const dealii::FiniteElement<dim>> fe;
    dealii::Quadrature<dim - 1> quadrature; ///< 4th degree
    dealii::Triangulation<dim>  cells;
    std::vector<Face>           faces;
  };
} // namespace conetact::bodies

#endif
