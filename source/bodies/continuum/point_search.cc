// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/point_search.h"

#include "conetact/bodies/continuum/node_mapping.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>

namespace conetact::bodies
{
  using dealii::BoundingBox;
  using dealii::Point;

  namespace
  {
    /** How far outside its cell, in cell sizes, a point may be by round-off. */
    constexpr double cell_tolerance = 1e-6;
    /** How far bent edges reach beyond the box around the nodes, in its size.
     */
    constexpr double bulge = .25;

    /** The coordinates of p in the unit cell of straight edges, nothing where
     * there are none: far outside of a distorted cell. */
    template <int dim>
    std::optional<Point<dim>>
    in_straight_cell(const dealii::FiniteElement<dim>      &element,
                     const typename NodeMapping<dim>::Cell &cell,
                     const Point<dim>                      &p)
    {
      try
        {
          return element.reference_cell()
            .template get_default_linear_mapping<dim>()
            .transform_real_to_unit_cell(cell, p);
        }
      catch (const typename dealii::Mapping<dim>::ExcTransformationFailed &)
        {
          return {};
        }
    }

    /** The same of bent edges, by Newton's method from there: that of MappingFE
     * misses points on edges. */
    template <int dim>
    std::optional<Point<dim>>
    in_bent_cell(const dealii::FiniteElement<dim> &element,
                 const std::vector<Point<dim>>    &nodes,
                 Point<dim>                        at,
                 const Point<dim>                 &p)
    {
      constexpr unsigned int n_steps   = 20;
      constexpr double       round_off = 1e-12, far = 4; // in unit cells
      for (unsigned int step = 0; step < n_steps && at.norm() < far; ++step)
        {
          dealii::Tensor<1, dim> miss = p;
          dealii::Tensor<2, dim> slope;
          for (unsigned int v = 0; v < nodes.size(); ++v)
            {
              miss -= element.shape_value(v, at) * nodes[v];
              slope += outer_product(nodes[v], element.shape_grad(v, at));
            }
          const dealii::Tensor<1, dim> move = invert(slope) * miss;
          at += move;
          if (move.norm() < round_off)
            return at;
        }
      return {};
    }

    /** Of a cell of any kind. */
    template <int dim>
    std::optional<Point<dim>>
    in_unit_cell(NodeMapping<dim>              &mapping,
                 const std::vector<Point<dim>> &nodes,
                 const BoundingBox<dim>        &box,
                 const Point<dim>              &p)
    {
      // deal.II stops at a residual that depends on the unit of length: the
      // cell is looked at from its own corner, in its own size.
      const Point<dim> &corner = box.get_boundary_points().first;
      double            size   = 0;
      for (unsigned int d = 0; d < dim; ++d)
        size = std::max(size, box.side_length(d));
      std::vector<Point<dim>> scaled;
      for (const Point<dim> &node : nodes)
        scaled.emplace_back((node - corner) / size);
      const Point<dim> there((p - corner) / size);
      const auto      &element = mapping.element();
      const auto at = in_straight_cell(element, mapping.cell_at(scaled), there);
      return !at || element.degree == 1 ?
               at :
               in_bent_cell(element, scaled, *at, there);
    }
  } // namespace

  /* A plain loop: trees of cells take longer to make than a point to find.
     Between cells round-off may put a point outside of all of them. */
  template <int dim>
  std::optional<PlaceInCell>
  find_cell(const ContinuumMesh<dim>         &mesh,
            const dealii::FiniteElement<dim> &element,
            const Point<dim>                 &p)
  {
    NodeMapping<dim>           mapping(element);
    std::optional<PlaceInCell> found;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const std::vector<Point<dim>> nodes = mesh.vertices(cell);
        const BoundingBox<dim>        box(nodes);
        if (!box.point_inside(p, element.degree == 1 ? cell_tolerance : bulge))
          continue;
        const auto unit = in_unit_cell(mapping, nodes, box, p);
        if (!unit ||
            !element.reference_cell().contains_point(*unit, cell_tolerance))
          continue;
        const bool is_inside = element.reference_cell().contains_point(*unit);
        if (found && !is_inside)
          continue;
        found = PlaceInCell{cell, {}};
        for (unsigned int v = 0; v < element.n_dofs_per_cell(); ++v)
          found->shapes.push_back(element.shape_value(v, *unit));
        if (is_inside)
          return found;
      }
    return found;
  }

  template std::optional<PlaceInCell>
  find_cell(const ContinuumMesh<2> &,
            const dealii::FiniteElement<2> &,
            const Point<2> &);
  template std::optional<PlaceInCell>
  find_cell(const ContinuumMesh<3> &,
            const dealii::FiniteElement<3> &,
            const Point<3> &);
} // namespace conetact::bodies
