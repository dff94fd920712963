// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/local_refinement.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/generator_arguments.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/tria.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::bodies
{
  using dealii::BoundingBox;
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Triangulation;

  namespace
  {
    /**
     * The part of the cell, where the scene puts it, that lies in the box: by
     * the boxes around cells. Nothing where they only touch.
     */
    template <class Cell>
    double
    part_inside(const Cell                &cell,
                const MeshParameters::Box &box,
                const MeshParameters      &parameters)
    {
      constexpr unsigned int dim = Cell::AccessorType::dimension;
      Point<3>               lower, upper;
      for (const unsigned int v : cell->vertex_indices())
        {
          const Point<3> p = parameters.to_scene(to_space(cell->vertex(v)));
          for (unsigned int d = 0; d < dim; ++d)
            {
              lower[d] = v == 0 ? p[d] : std::min(lower[d], p[d]);
              upper[d] = v == 0 ? p[d] : std::max(upper[d], p[d]);
            }
        }
      double part = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          // cells that only touch the box from outside stay as they are
          const double tolerance = 1e-9 * (upper[d] - lower[d]);
          if (upper[d] <= box.lower[d] + tolerance ||
              lower[d] >= box.upper[d] - tolerance)
            return 0;
          part *= (std::min(upper[d], box.upper[d]) -
                   std::max(lower[d], box.lower[d])) /
                  (upper[d] - lower[d]);
        }
      // boxes may be flat, and yet cells reach into them
      return std::max(part, std::numeric_limits<double>::min());
    }

    /**
     * Cells that a box will have at least: boxes around cells that stand askew
     * overlap, a quarter of their cells is on the safe side.
     */
    template <int dim>
    double
    cells_in(const Triangulation<dim>  &mesh,
             const MeshParameters::Box &box,
             const MeshParameters      &parameters)
    {
      double n = 0;
      for (const auto &cell : mesh.active_cell_iterators())
        n += part_inside(cell, box, parameters);
      // 2^dim children a level, less the quarter.
      return std::ldexp(n, static_cast<int>(dim * box.levels) - 2);
    }

    /** Divides the cells that are flagged, if there is room for them. */
    template <int dim>
    void
    refine(Triangulation<dim>   &mesh,
           const MeshParameters &parameters,
           const std::string    &entry)
    {
      unsigned int n_flagged = 0;
      for (const auto &cell : mesh.active_cell_iterators())
        n_flagged += cell->refine_flag_set();
      check_mesh_size(parameters,
                      dim,
                      // At least: cells beside are divided as well, so that
                      // levels differ by 1.
                      mesh.n_active_cells() + ((1 << dim) - 1.) * n_flagged,
                      entry);
      mesh.execute_coarsening_and_refinement();
    }

    template <int dim>
    void
    refine_boxes(Triangulation<dim> &mesh, const MeshParameters &parameters)
    {
      for (const MeshParameters::Box &box : parameters.boxes)
        check_mesh_size(parameters,
                        dim,
                        cells_in(mesh, box, parameters),
                        "Refinement boxes");
      const unsigned int base    = parameters.global_refinements;
      bool               changed = true;
      while (changed)
        {
          changed = false;
          for (unsigned int b = 0; b < parameters.boxes.size(); ++b)
            {
              const MeshParameters::Box &box   = parameters.boxes[b];
              bool                       empty = true;
              for (const auto &cell : mesh.active_cell_iterators())
                if (part_inside(cell, box, parameters) > 0)
                  {
                    empty = false;
                    if (static_cast<unsigned int>(cell->level()) <
                        base + box.levels)
                      {
                        cell->set_refine_flag();
                        changed = true;
                      }
                  }
              if (empty)
                throw InputError(parameters.where + "Refinement boxes: box " +
                                 std::to_string(b + 1) + " from " +
                                 to_text(Tensor<1, 3>(box.lower)) + " to " +
                                 to_text(Tensor<1, 3>(box.upper)) +
                                 " holds no cell. Boxes are in the " +
                                 "coordinates of the scene, where the mesh " +
                                 "is scaled, rotated and moved.");
            }
          if (changed)
            refine(mesh, parameters, "Refinement boxes");
        }
    }

    /** Whether the boxes are nearer than that. */
    template <int dim>
    bool
    is_near(const BoundingBox<dim> &a,
            const BoundingBox<dim> &b,
            const double            distance)
    {
      double square = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double apart = std::max({0.,
                                         a.lower_bound(d) - b.upper_bound(d),
                                         b.lower_bound(d) - a.upper_bound(d)});
          square += apart * apart;
        }
      return square < distance * distance;
    }

    /** Boxes around the faces that will have one of these ids. */
    template <int dim>
    std::vector<BoundingBox<dim>>
    boxes_of_faces(const Triangulation<dim>     &mesh,
                   const std::set<unsigned int> &ids,
                   const MeshParameters         &parameters,
                   const MeshGroups::Ids        &groups)
    {
      std::vector<BoundingBox<dim>> boxes;
      std::set<unsigned int>        known;
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary())
          {
            const Point<3> centre =
              parameters.to_scene(to_space(face->center()));
            const unsigned int id =
              parameters.boundary_id(face->boundary_id(), centre);
            known.insert(id);
            if (ids.count(id) > 0)
              boxes.push_back(face->bounding_box());
          }
      for (const unsigned int id : ids)
        if (known.count(id) == 0)
          throw InputError(parameters.where + "Refinement distance: no face " +
                           "of the mesh has id " + name_of(id, groups) +
                           ". It has: " + join_names(known, groups) +
                           "; more are tagged by Mesh/Boundary ids.");
      return boxes;
    }

    template <int dim>
    void
    refine_zone(Triangulation<dim>         &mesh,
                const MeshParameters::Zone &zone,
                const MeshParameters       &parameters,
                const MeshGroups::Ids      &groups)
    {
      namespace index  = boost::geometry::index;
      const auto boxes = boxes_of_faces(mesh, zone.ids, parameters, groups);
      const auto tree  = dealii::pack_rtree(boxes);
      // cells at the distance itself stay as they are, whatever rounding does
      const double distance =
        (1 - 1e-9) * zone.distance / parameters.placement.scale;
      const auto reaches = [&](const BoundingBox<dim> &cell) {
        // The tree finds boxes; corners of a box are further than the distance.
        BoundingBox<dim> around = cell;
        around.extend(distance);
        const auto near = [&](const BoundingBox<dim> &face) {
          return is_near(cell, face, distance);
        };
        return tree.qbegin(index::intersects(around) &&
                           index::satisfies(near)) != tree.qend();
      };
      const int finest =
        static_cast<int>(parameters.global_refinements + zone.levels);
      bool changed = true;
      while (changed)
        {
          changed = false;
          for (const auto &cell : mesh.active_cell_iterators())
            if (cell->level() < finest && reaches(cell->bounding_box()))
              {
                cell->set_refine_flag();
                changed = true;
              }
          if (changed)
            refine(mesh, parameters, "Refinement distance");
        }
    }
  } // namespace

  template <int dim>
  void
  refine_locally(Triangulation<dim>    &mesh,
                 const MeshParameters  &parameters,
                 const MeshGroups::Ids &groups)
  {
    refine_boxes(mesh, parameters);
    for (const MeshParameters::Zone &zone : parameters.zones)
      refine_zone(mesh, zone, parameters, groups);
  }

  template <int dim>
  void
  refine_elements(Triangulation<dim> &mesh, const Refinements &refinements)
  {
    for (const std::set<unsigned int> &elements : refinements)
      {
        for (const auto &cell : mesh.active_cell_iterators())
          if (elements.count(cell->active_cell_index()) > 0)
            cell->set_refine_flag();
        mesh.execute_coarsening_and_refinement();
      }
  }

  template void
  refine_locally<2>(Triangulation<2> &,
                    const MeshParameters &,
                    const MeshGroups::Ids &);
  template void
  refine_locally<3>(Triangulation<3> &,
                    const MeshParameters &,
                    const MeshGroups::Ids &);
  template void
  refine_elements<2>(Triangulation<2> &, const Refinements &);
  template void
  refine_elements<3>(Triangulation<3> &, const Refinements &);
} // namespace conetact::bodies
