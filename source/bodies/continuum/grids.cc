// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/grids.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/generator_arguments.h"
#include "conetact/bodies/continuum/grid_sources.h"
#include "conetact/bodies/continuum/local_refinement.h"
#include "conetact/bodies/continuum/manifold_nodes.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace conetact::bodies
{
  using dealii::GeometryInfo;
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Triangulation;

  namespace
  {
    /**
     * Refinement puts hanging vertices onto a curved shape, but the d-linear
     * coarser neighbour has them on its straight edges. There they must lie,
     * or not even rigid motions would be free of strain.
     */
    template <int dim>
    void
    straighten_hanging_vertices(Triangulation<dim> &mesh)
    {
      for (unsigned int level = 0; level < mesh.n_levels(); ++level)
        for (const auto &cell : mesh.active_cell_iterators_on_level(level))
          {
            for (unsigned int l = 0; l < cell->n_lines(); ++l)
              if (cell->line(l)->has_children())
                cell->line(l)->child(0)->vertex(1) = cell->line(l)->center();
            if constexpr (dim == 3)
              for (const unsigned int f : cell->face_indices())
                if (cell->face(f)->has_children())
                  cell->face(f)->child(0)->vertex(3) = cell->face(f)->center();
          }
    }

    template <int dim>
    void
    place(Triangulation<dim>   &mesh,
          CellNodes<dim>       &nodes,
          const MeshParameters &parameters)
    {
      const auto to_scene = [&](const Point<dim> &given) {
        return from_space<dim>(parameters.to_scene(to_space(given)));
      };
      nodes.transform(to_scene);
      std::vector<bool> done(mesh.n_vertices(), false);
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          if (!done[cell->vertex_index(v)])
            {
              cell->vertex(v)             = to_scene(cell->vertex(v));
              done[cell->vertex_index(v)] = true;
            }
      // the curved geometry has not moved along
      mesh.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
      mesh.reset_all_manifolds();
    }

    /** What rounding put beside the axis of a half section lies on it. */
    template <int dim>
    void
    put_on_axis(Triangulation<dim> &mesh, const MeshParameters &parameters)
    {
      constexpr double round_off = 1e-10;

      double size = 0;
      for (const Point<dim> &p : mesh.get_vertices())
        size = std::max(size, p.norm());
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          if (double &r = cell->vertex(v)[0]; std::abs(r) <= round_off * size)
            r = 0;
          else if (r < 0)
            throw InputError(
              parameters.where +
              (parameters.file.empty() ? "Generator: " : "File: ") +
              "the mesh of a body of revolution (Plane = axisymmetric) is " +
              "half its section, where x is the radius, and has a node at " +
              to_text(Tensor<1, 3>(to_space(cell->vertex(v)))) +
              ". Give the half with x >= 0 only.");
    }

    /** Of the edges that leave each vertex; a simplex has one for all. */
    template <int dim, class Cell>
    std::vector<double>
    volumes_at_vertices(const Cell &cell)
    {
      constexpr unsigned int n = GeometryInfo<dim>::vertices_per_cell;
      Point<dim>             x[n];
      for (const unsigned int v : cell.vertex_indices())
        x[v] = cell.vertex(v);
      if (cell.reference_cell().is_simplex())
        {
          Tensor<2, dim> edges;
          for (unsigned int d = 0; d < dim; ++d)
            edges[d] = x[d + 1] - x[0];
          return {determinant(edges)};
        }
      Tensor<0, dim> volumes[n];
      GeometryInfo<dim>::alternating_form_at_vertices(x, volumes);
      return {volumes, volumes + n};
    }

    template <int dim>
    void
    refuse_distorted(const Triangulation<dim> &mesh,
                     const MeshParameters     &parameters)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        {
          const auto   volumes = volumes_at_vertices<dim>(*cell);
          const double limit   = 1e-12 * std::pow(cell->diameter(), dim);
          for (unsigned int v = 0; v < volumes.size(); ++v)
            if (!(volumes[v] > limit))
              throw InputError(
                parameters.where +
                (parameters.file.empty() ? "Generator: " : "File: ") +
                "the cell at " +
                to_text(Tensor<1, 3>(to_space(cell->center()))) +
                " is distorted: it is folded or flat at its corner " +
                to_text(Tensor<1, 3>(to_space(cell->vertex(v)))) +
                ". Give convex cells, or check that the mesh has dimension " +
                std::to_string(dim) + ".");
        }
    }

    /** How many of the faces that it will be condition holds for, by their
     * centres. */
    template <class Face>
    unsigned int
    n_parts_with(const BoundaryTag    &tag,
                 const Face           &face,
                 const MeshParameters &parameters)
    {
      const auto holds = [&](const auto &centre) {
        return tag.condition(parameters.to_scene(to_space(centre))) != 0;
      };
      if (!parameters.is_to_be_halved)
        return holds(face->center());
      unsigned int n = 0;
      for (const unsigned int v : face->vertex_indices())
        n += holds(face->vertex(v) + .5 * (face->center() - face->vertex(v)));
      return n;
    }

    template <int dim>
    void
    tag(Triangulation<dim> &mesh, const MeshParameters &parameters)
    {
      for (const BoundaryTag &tag : parameters.tags)
        {
          bool found = false;
          for (const auto &face : mesh.active_face_iterators())
            if (face->at_boundary() && n_parts_with(tag, face, parameters) > 0)
              {
                face->set_boundary_id(tag.id);
                found = true;
              }
          if (!found)
            throw InputError(parameters.where +
                             "Boundary ids: no boundary face has a centre " +
                             "with '" + tag.text + "' (id " +
                             std::to_string(tag.id) +
                             "). Check the condition against the mesh's " +
                             "coordinates in the scene.");
        }
    }

    /** Groups by the ids that faces have when they are tagged: of all that a
     * file has, conditions leave some without a face. */
    template <int dim>
    MeshGroups::Ids
    kept_groups(const Triangulation<dim> &mesh,
                const MeshParameters     &parameters,
                const MeshGroups::Ids    &groups)
    {
      BoundaryIds known;
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary())
          known.insert(parameters.boundary_id(face->boundary_id(),
                                              parameters.to_scene(
                                                to_space(face->center()))));
      MeshGroups::Ids kept;
      for (const auto &[name, ids] : groups)
        {
          BoundaryIds &of_name = kept[name];
          std::set_intersection(ids.begin(),
                                ids.end(),
                                known.begin(),
                                known.end(),
                                std::inserter(of_name, of_name.end()));
        }
      return kept;
    }

    /** deal.II has no nodes that hang between triangles or tetrahedra. */
    template <int dim>
    void
    refuse_local_refinement(const Triangulation<dim> &mesh,
                            const MeshParameters     &parameters)
    {
      if (mesh.all_reference_cells_are_hyper_cube())
        return;
      for (const auto &[asked, entry] :
           {std::pair(!parameters.boxes.empty(), "Refinement boxes"),
            std::pair(!parameters.zones.empty(), "Refinement distance")})
        if (asked)
          throw InputError(parameters.where + entry + ": triangles and " +
                           "tetrahedra are refined everywhere only. Use " +
                           "Global refinements, or a mesh that is finer " +
                           "where it matters.");
    }

    /** Edges that are opposite are equal. */
    template <class Cell>
    bool
    has_parallel_sides(const Cell &cell)
    {
      constexpr double round_off = 1e-12; // of the size of the cell
      for (unsigned int v = 1; v < cell.n_vertices(); ++v)
        {
          auto corner = cell.vertex(0);
          for (unsigned int axis = 1; axis < cell.n_vertices(); axis *= 2)
            if ((v & axis) != 0)
              corner += cell.vertex(axis) - cell.vertex(0);
          if (corner.distance(cell.vertex(v)) > round_off * cell.diameter())
            return false;
        }
      return true;
    }

    /** Whether new nodes of all cells are in the middle of old ones, and nobody
     * asks deal.II for these cells. */
    template <int dim>
    bool
    can_be_halved(const Triangulation<dim> &mesh,
                  const MeshParameters     &parameters)
    {
      if (!parameters.file.empty() || !parameters.refinements.empty() ||
          !parameters.boxes.empty() || !parameters.zones.empty() ||
          parameters.second_order || parameters.global_refinements == 0 ||
          !mesh.all_reference_cells_are_hyper_cube())
        return false;
      for (const auto id : mesh.get_manifold_ids())
        if (id != dealii::numbers::flat_manifold_id)
          return false;
      for (const auto &cell : mesh.active_cell_iterators())
        if (!has_parallel_sides(*cell))
          return false;
      return true;
    }

    /** Conditions may hold for parts of faces: then these must be faces. */
    template <int dim>
    bool
    have_parts_apart(const Triangulation<dim> &mesh,
                     const MeshParameters     &parameters)
    {
      constexpr unsigned int all = GeometryInfo<dim>::vertices_per_face;
      for (const BoundaryTag &tag : parameters.tags)
        for (const auto &face : mesh.active_face_iterators())
          if (face->at_boundary() &&
              n_parts_with(tag, face, parameters) % all != 0)
            return true;
      return false;
    }

    template <int dim>
    void
    refine_globally(Triangulation<dim> &mesh, MeshParameters &parameters)
    {
      check_mesh_size(parameters,
                      dim,
                      std::ldexp(mesh.n_active_cells(),
                                 static_cast<int>(
                                   dim * parameters.global_refinements)),
                      "Global refinements");
      parameters.is_to_be_halved = can_be_halved(mesh, parameters);
      mesh.refine_global(parameters.global_refinements -
                         (parameters.is_to_be_halved ? 1 : 0));
      if (parameters.is_to_be_halved && have_parts_apart(mesh, parameters))
        {
          parameters.is_to_be_halved = false;
          mesh.refine_global(1);
        }
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Triangulation<dim>>
  make_mesh(MeshParameters &parameters,
            MeshGroups     &groups,
            CellNodes<dim> &nodes)
  {
    auto mesh = generate_or_read<dim>(parameters, groups, nodes);
    const MeshGroups::Ids kept = kept_groups(*mesh, parameters, groups.faces);
    for (MeshParameters::Zone &zone : parameters.zones)
      zone.ids = to_ids(zone.text,
                        kept,
                        "a boundary id",
                        parameters.where + "Refinement distance");
    refine_globally(*mesh, parameters);
    refuse_local_refinement(*mesh, parameters);
    refine_locally(*mesh, parameters, kept);
    tag(*mesh, parameters);
    groups.faces = kept_groups(*mesh, parameters, groups.faces);
    refine_elements(*mesh, parameters.refinements);
    if (!nodes.coarse.empty())
      bend_refined_cells(nodes, *mesh);
    else if (parameters.second_order)
      nodes = nodes_on_manifolds(*mesh);
    if (mesh->has_hanging_nodes())
      straighten_hanging_vertices(*mesh);
    place(*mesh, nodes, parameters);
    if (parameters.on_axis)
      put_on_axis(*mesh, parameters);
    refuse_distorted(*mesh, parameters);
    return mesh;
  }

  template std::unique_ptr<Triangulation<2>>
  make_mesh<2>(MeshParameters &, MeshGroups &, CellNodes<2> &);
  template std::unique_ptr<Triangulation<3>>
  make_mesh<3>(MeshParameters &, MeshGroups &, CellNodes<3> &);
} // namespace conetact::bodies
