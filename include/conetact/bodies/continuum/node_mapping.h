// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_node_mapping_h
#define conetact_bodies_continuum_node_mapping_h

#include <deal.II/base/point.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/tria.h>

#include <memory>
#include <vector>

namespace conetact::bodies
{
  /**
   * Maps the unit cell to where the nodes stand that it is told, by the shape
   * functions of displacements (isoparametric cells). With it FEValues works on
   * any cell of a ContinuumMesh:
   *
   *     fe_values.reinit(mapping.cell_at(mesh.vertices(cell)));
   *
   * FEValues needs a cell of a Triangulation. That of a large body takes more
   * memory than all else the body has, and is forgotten; one cell stands for
   * all. Far from the origin it computes with places relative to the first
   * node: gradients are as exact there as near it.
   */
  template <int dim>
  class NodeMapping : public dealii::MappingFE<dim>
  {
  public:
    using Cell    = typename dealii::Triangulation<dim>::cell_iterator;
    using Support = std::vector<dealii::Point<dim>>;

    /** Of an element with one component, in whose order nodes come. */
    explicit NodeMapping(const dealii::FiniteElement<dim> &element);
    std::unique_ptr<dealii::Mapping<dim>>
    clone() const override;

    const dealii::FiniteElement<dim> &
    element() const
    {
      return *this->fe;
    }
    /** The cell; its nodes stand there until the next call. */
    const Cell &
    cell_at(const Support &nodes);

  private:
    using Data = typename dealii::Mapping<dim>::InternalDataBase;
    using Output =
      dealii::internal::FEValuesImplementation::MappingRelatedData<dim, dim>;

    Support
    compute_mapping_support_points(const Cell &) const override
    {
      Support relative = support;
      for (dealii::Point<dim> &node : relative)
        node -= origin;
      return relative;
    }
    dealii::CellSimilarity::Similarity
    fill_fe_values(const Cell                              &cell,
                   const dealii::CellSimilarity::Similarity similarity,
                   const dealii::Quadrature<dim>           &quadrature,
                   const Data                              &data,
                   Output &output) const override;
    using dealii::MappingFE<dim>::fill_fe_face_values;
    void
    fill_fe_face_values(const Cell                             &cell,
                        const unsigned int                      face,
                        const dealii::hp::QCollection<dim - 1> &quadrature,
                        const Data                             &data,
                        Output &output) const override;

    dealii::Triangulation<dim> one_cell;
    Cell                       cell;
    Support                    support;
    dealii::Point<dim>         origin; ///< or the first node
  };
} // namespace conetact::bodies

#endif
