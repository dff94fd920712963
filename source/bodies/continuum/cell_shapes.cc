// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/cell_shapes.h"

#include <cmath>
#include <limits>
#include <map>

namespace conetact::bodies
{
  namespace
  {
    /** Nodes relative to the first one, and how exactly they are known. */
    template <int dim>
    struct Outline
    {
      std::vector<double> x;
      double              tolerance;
      unsigned int        phase;

      Outline(const std::vector<Point<dim>> &vertices,
              const bool                     is_ring,
              const unsigned int             material)
        : x(dim * (vertices.size() - 1))
        , phase(material)
      {
        double size = 0, distance = 0;
        for (unsigned int i = 0; i < x.size(); ++i)
          {
            x[i]     = vertices[1 + i / dim][i % dim] - vertices[0][i % dim];
            size     = std::max(size, std::abs(x[i]));
            distance = std::max(distance, std::abs(vertices[0][i % dim]));
          }
        // round-off of the coordinates themselves
        tolerance =
          1e-12 * size + 8 * std::numeric_limits<double>::epsilon() * distance;
        if (is_ring) // only those that are moved along the axis are alike
          x.push_back(vertices[0][0]);
      }

      /** A number that is (nearly) equal for congruent cells only. */
      double
      key() const
      {
        double key = 0;
        for (unsigned int i = 0; i < x.size(); ++i)
          // Weights without any relation: other shapes hardly have the same
          // sum.
          key += x[i] * std::cos(1. + 3. * static_cast<double>(i));
        return key * (1 + phase);
      }

      bool
      equals(const Outline &other) const
      {
        for (unsigned int i = 0; i < x.size(); ++i)
          if (!(std::abs(x[i] - other.x[i]) <= tolerance))
            return false;
        return phase == other.phase;
      }
    };
  } // namespace



  template <int dim>
  CellShapes<dim>::CellShapes(const ContinuumMesh<dim> &mesh,
                              const bool                is_ring)
  {
    std::vector<Outline<dim>>           known;
    std::multimap<double, unsigned int> by_key;
    shape_of_cell.reserve(mesh.n_cells());
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const Outline<dim> outline(mesh.vertices(cell),
                                   is_ring,
                                   mesh.phase(cell));
        // Most meshes have long runs of one shape.
        unsigned int shape = cell > 0 ? shape_of_cell.back() : 0;
        if (known.empty() || !outline.equals(known[shape]))
          {
            const double key = outline.key();
            // Weights are 1 at most: so much may the keys of equal cells
            // differ.
            const double range = outline.tolerance * (1 + outline.phase) *
                                 static_cast<double>(outline.x.size());
            const auto end = by_key.upper_bound(key + range);
            const auto found =
              std::find_if(by_key.lower_bound(key - range),
                           end,
                           [&](const auto &entry) {
                             return outline.equals(known[entry.second]);
                           });
            shape = found != end ? found->second :
                                   static_cast<unsigned int>(shapes.size());
            if (found == end)
              {
                known.push_back(outline);
                shapes.push_back({cell});
                by_key.emplace(key, shape);
              }
          }
        shape_of_cell.push_back(shape);
        ++shapes[shape].n_cells;
      }
  }

  template class CellShapes<2>;
  template class CellShapes<3>;
} // namespace conetact::bodies
