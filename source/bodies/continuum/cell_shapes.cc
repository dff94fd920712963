// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/cell_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

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

    /** Cells one behind the other that have one shape. */
    struct Run
    {
      double       key;
      unsigned int first_cell;
      bool         is_alone = true; ///< no other run can have this shape
    };

    /** So much may the keys of equal cells differ: weights are 1 at most. */
    template <int dim>
    double
    range_of(const Outline<dim> &outline)
    {
      return outline.tolerance * (1 + outline.phase) *
             static_cast<double>(outline.x.size());
    }

    /** Sets which runs are alone: keys of no others are that close. */
    void
    find_alone(const double range, std::vector<Run> &runs)
    {
      std::vector<std::pair<double, unsigned int>> sorted;
      sorted.reserve(runs.size());
      for (unsigned int i = 0; i < runs.size(); ++i)
        sorted.emplace_back(runs[i].key, i);
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t i = 1; i < sorted.size(); ++i)
        if (!(sorted[i].first - sorted[i - 1].first > 2 * range))
          runs[sorted[i].second].is_alone =
            runs[sorted[i - 1].second].is_alone = false;
    }

    /** Most meshes either have long runs of one shape or no shape twice: cells
     * are compared with the one before, keys of runs are sorted. */
    template <typename OutlineOf>
    std::vector<Run>
    runs_of(const unsigned int n_cells, const OutlineOf &outline_of)
    {
      std::vector<Run> runs;
      double           range = 0;
      for (unsigned int first = 0, end = 0; first < n_cells; first = end)
        {
          const auto outline = outline_of(first);
          range              = std::max(range, range_of(outline));
          runs.push_back({outline.key(), first});
          for (end = first + 1;
               end < n_cells && outline_of(end).equals(outline);)
            ++end;
        }
      find_alone(range, runs);
      return runs;
    }
  } // namespace



  /* The shape of a cell is the first one that equals it. Of the runs that are
     alone no outline need be kept, nor looked for. */
  template <int dim>
  CellShapes<dim>::CellShapes(const ContinuumMesh<dim> &mesh,
                              const bool                is_ring)
  {
    const auto outline_of = [&](const unsigned int cell) {
      return Outline<dim>(mesh.vertices(cell), is_ring, mesh.phase(cell));
    };
    struct Known
    {
      Outline<dim> outline;
      unsigned int shape;
    };
    std::multimap<double, Known> known;
    const auto                   find = [&](const Run &run) {
      const auto   next = static_cast<unsigned int>(shapes.size());
      const auto   outline = outline_of(run.first_cell);
      const double range   = range_of(outline);
      const auto   end = known.upper_bound(run.key + range);
      const auto   found =
        std::find_if(known.lower_bound(run.key - range),
                     end,
                     [&](const auto &entry) {
                       return outline.equals(entry.second.outline);
                     });
      if (found != end)
        return found->second.shape;
      known.emplace(run.key, Known{outline, next});
      return next;
    };
    const std::vector<Run> runs = runs_of(mesh.n_cells(), outline_of);
    shape_of_cell.reserve(mesh.n_cells());
    for (std::size_t i = 0; i < runs.size(); ++i)
      {
        const auto         next  = static_cast<unsigned int>(shapes.size());
        const unsigned int shape = runs[i].is_alone ? next : find(runs[i]);
        if (shape == next)
          shapes.push_back({runs[i].first_cell});
        const unsigned int end =
          i + 1 < runs.size() ? runs[i + 1].first_cell : mesh.n_cells();
        shapes[shape].n_cells += end - runs[i].first_cell;
        shape_of_cell.resize(end, shape);
      }
  }

  template class CellShapes<2>;
  template class CellShapes<3>;
} // namespace conetact::bodies
