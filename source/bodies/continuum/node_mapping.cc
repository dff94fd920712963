// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/node_mapping.h"

#include <deal.II/grid/grid_generator.h>

namespace conetact::bodies
{
  template <int dim>
  NodeMapping<dim>::NodeMapping(const dealii::FiniteElement<dim> &element)
    : dealii::MappingFE<dim>(element)
    , support(element.get_unit_support_points())
  {
    dealii::GridGenerator::reference_cell(one_cell, element.reference_cell());
    cell = one_cell.begin();
  }

  template <int dim>
  std::unique_ptr<dealii::Mapping<dim>>
  NodeMapping<dim>::clone() const
  {
    auto copy = std::make_unique<NodeMapping<dim>>(element());
    copy->cell_at(support);
    return copy;
  }

  template <int dim>
  const typename NodeMapping<dim>::Cell &
  NodeMapping<dim>::cell_at(const Support &nodes)
  {
    AssertDimension(nodes.size(), support.size());
    support              = nodes;
    constexpr double far = 1e3; // from the origin, in sizes of the cell
    const bool       is_far =
      nodes.front().norm() > far * nodes.front().distance(nodes.back());
    origin = is_far ? nodes.front() : dealii::Point<dim>();
    // deal.II measures by its vertices how large the cell is.
    for (const unsigned int v : cell->vertex_indices())
      cell->vertex(v) = nodes[v];
    return cell;
  }

  /* FEValues takes the same cell for one that has not changed. */
  template <int dim>
  dealii::CellSimilarity::Similarity
  NodeMapping<dim>::fill_fe_values(const Cell &here,
                                   const dealii::CellSimilarity::Similarity,
                                   const dealii::Quadrature<dim> &quadrature,
                                   const Data                    &data,
                                   Output                        &output) const
  {
    const auto similarity = dealii::MappingFE<dim>::fill_fe_values(
      here, dealii::CellSimilarity::none, quadrature, data, output);
    for (dealii::Point<dim> &point : output.quadrature_points)
      point += origin;
    return similarity;
  }

  /* MappingFE reads the nodes of a face's cell once, unless it has none. */
  template <int dim>
  void
  NodeMapping<dim>::fill_fe_face_values(
    const Cell                             &here,
    const unsigned int                      face,
    const dealii::hp::QCollection<dim - 1> &quadrature,
    const Data                             &data,
    Output                                 &output) const
  {
    using Kept = typename dealii::MappingFE<dim>::InternalData;
    Assert(dynamic_cast<const Kept *>(&data) != nullptr,
           dealii::ExcInternalError());
    static_cast<const Kept &>(data).mapping_support_points.clear();
    dealii::MappingFE<dim>::fill_fe_face_values(
      here, face, quadrature, data, output);
    for (dealii::Point<dim> &point : output.quadrature_points)
      point += origin;
  }

  template class NodeMapping<2>;
  template class NodeMapping<3>;
} // namespace conetact::bodies
