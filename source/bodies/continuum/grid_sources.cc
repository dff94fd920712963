// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/grid_sources.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/generator_arguments.h"
#include "conetact/bodies/continuum/grid_messages.h"
#include "conetact/bodies/continuum/manifold_nodes.h"
#include "conetact/bodies/continuum/mesh_files.h"

#include <deal.II/base/patterns.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace conetact::bodies
{
  using dealii::Triangulation;

  namespace
  {
    /** The end of a sentence: how many arguments, or what deal.II has to say.
     */
    std::string
    reason(const std::string &message)
    {
      const std::string tuple = "does not match the pattern \"[Tuple of <";
      const auto        at    = message.find(tuple);
      if (at == std::string::npos)
        return ". (" + message + ")";
      const std::string count = message.substr(at + tuple.size());
      return " (there are " + count.substr(0, count.find('>')) +
             "; points and lists have ',' between their components).";
    }

    /** "3, 2 : 0, 0 : 1, 1 : true" as what a function takes. */
    template <class... Types>
    std::tuple<Types...>
    read_arguments(const std::string &text)
    {
      std::tuple<Types...> arguments;
      dealii::Patterns::Tools::to_value(text, arguments);
      return arguments;
    }

    /** Ids 0, 1 at the ends along x, then 2, 3 along y, 4, 5 along z. */
    template <int dim>
    void
    color_sides(Triangulation<dim>       &mesh,
                const dealii::Point<dim> &lower,
                const dealii::Point<dim> &upper)
    {
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary())
          for (unsigned int d = 0; d < dim; ++d)
            if (const double along =
                  (face->center()[d] - lower[d]) / (upper[d] - lower[d]);
                std::abs(along - .5) > .5 - 1e-9)
              face->set_boundary_id(2 * d + (along > .5));
    }

    /**
     * Blocks of triangles and tetrahedra, which deal.II neither knows by name
     * nor colours.
     */
    template <int dim>
    bool
    generate_simplices(Triangulation<dim>   &mesh,
                       const MeshParameters &parameters)
    {
      using dealii::Point;
      std::vector<unsigned int> cells(dim);
      Point<dim>                lower, upper;
      bool                      colorize = false;
      if (parameters.generator == "subdivided_hyper_cube_with_simplices")
        {
          const auto [n, left, right, color] =
            read_arguments<unsigned int, double, double, bool>(
              parameters.arguments);
          std::fill(cells.begin(), cells.end(), n);
          for (unsigned int d = 0; d < dim; ++d)
            {
              lower[d] = left;
              upper[d] = right;
            }
          colorize = color;
        }
      else if (parameters.generator ==
               "subdivided_hyper_rectangle_with_simplices")
        std::tie(cells, lower, upper, colorize) =
          read_arguments<std::vector<unsigned int>,
                         Point<dim>,
                         Point<dim>,
                         bool>(parameters.arguments);
      else
        return false;
      dealii::GridGenerator::subdivided_hyper_rectangle_with_simplices(mesh,
                                                                       cells,
                                                                       lower,
                                                                       upper);
      if (colorize)
        color_sides(mesh, lower, upper);
      return true;
    }

    template <int dim>
    void
    generate(Triangulation<dim> &mesh, MeshParameters &parameters)
    {
      check_generator_arguments(parameters, dim);
      const std::string given = parameters.arguments;
      try
        {
          refine_instead(parameters, dim);
          if (!generate_simplices(mesh, parameters))
            dealii::GridGenerator::generate_from_name_and_arguments(
              mesh, parameters.generator, parameters.arguments);
        }
      catch (const std::exception &error)
        {
          const std::string message = message_of(error);
          if (message.find("not implemented") != std::string::npos)
            throw InputError(
              parameters.where + "Generator: there is no mesh generator '" +
              parameters.generator + "' in " + std::to_string(dim) + "D. " +
              generator_hint(parameters.generator) +
              "Use a function name of deal.II's GridGenerator such as "
              "hyper_rectangle.");
          throw InputError(
            parameters.where + "Arguments: '" + given + "' does not suit " +
            parameters.generator + " in " + std::to_string(dim) +
            "D. Give all its arguments, separated by ':'" + reason(message));
        }
    }

    /** At a face, an edge in 2D, at most two cells meet. */
    template <int dim>
    void
    check_shared_faces(const Triangulation<dim> &mesh,
                       const MeshParameters     &parameters)
    {
      std::vector<unsigned int> n_cells(mesh.n_raw_faces(), 0);
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          ++n_cells[face->index()];
      for (const auto &face : mesh.active_face_iterators())
        if (n_cells[face->index()] > 2)
          {
            dealii::Tensor<1, 3> place;
            for (unsigned int d = 0; d < dim; ++d)
              place[d] = face->center()[d];
            throw InputError(
              parameters.where + "File: in '" + parameters.file.string() +
              "' " + std::to_string(n_cells[face->index()]) +
              " cells share the " + (dim == 2 ? "edge" : "face") + " at " +
              to_text(place) +
              ", but at most two can. Cells overlap or do not fit each " +
              "other: mesh it again" +
              (dim == 2 ? "." :
                          " (in Gmsh 'Mesh.SubdivisionAlgorithm = 2;' "
                          "without 'Mesh.RecombineAll')."));
          }
    }

    /** The corner of a simplex that a face of it does not have. Faces are in
     * deal.II's order: 01, 12, 20 of a triangle; 012, 103, 023, 213 of a
     * tetrahedron. */
    template <int dim, class Cell>
    dealii::Point<dim>
    corner_off_face(const Cell &cell, const unsigned int face)
    {
      const unsigned int corner = dim == 2 ? (face + 2) % 3 : 3 - face;
      Assert(cell->face(face)->vertex_index(0) != cell->vertex_index(corner) &&
               cell->face(face)->vertex_index(dim - 1) !=
                 cell->vertex_index(corner),
             dealii::ExcInternalError());
      return cell->vertex(corner);
    }

    /** Of the edges from a corner of a face to its others and to p: above zero
     * on the one side of it. */
    template <int dim, class Face>
    double
    side_of(const Face &face, const dealii::Point<dim> &p)
    {
      dealii::Tensor<2, dim> edges;
      for (unsigned int d = 0; d + 1 < dim; ++d)
        edges[d] = face->vertex(d + 1) - face->vertex(0);
      edges[dim - 1] = p - face->vertex(0);
      return determinant(edges);
    }

    /** Simplices on the same side of their face lie over each other. Folded
     * quadrilaterals and hexahedra are seen at their corners. */
    template <int dim>
    void
    check_sides_of_faces(const Triangulation<dim> &mesh,
                         const MeshParameters     &parameters)
    {
      if (!mesh.all_reference_cells_are_simplex())
        return;
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          {
            if (cell->at_boundary(f) || cell->neighbor(f) < cell)
              continue;
            const auto         face  = cell->face(f);
            const auto         other = cell->neighbor(f);
            const unsigned int back  = cell->neighbor_of_neighbor(f);
            if (side_of(face, corner_off_face<dim>(cell, f)) *
                  side_of(face, corner_off_face<dim>(other, back)) <
                0)
              continue;
            throw InputError(
              parameters.where + "File: in '" + parameters.file.string() +
              "' two cells lie on the same side of the " +
              (dim == 2 ? "edge" : "face") + " at " +
              to_text(dealii::Tensor<1, 3>(to_space(face->center()))) +
              " that they share, over each other: a node is out of its place. "
              "Mesh it again.");
          }
    }

    /** It asks the coarse cells of the mesh that it was made for. Inside of
     * simplices, where such manifolds are, edges are straight. */
    template <int dim>
    bool
    belongs_to_mesh(const dealii::Manifold<dim> &manifold)
    {
      return dynamic_cast<
               const dealii::TransfiniteInterpolationManifold<dim> *>(
               &manifold) != nullptr;
    }

    /** Each quadrilateral into 8 triangles, each hexahedron 24 tetrahedra. */
    template <int dim>
    std::unique_ptr<Triangulation<dim>>
    divide_into_simplices(const Triangulation<dim> &mesh,
                          const MeshParameters     &parameters)
    {
      check_mesh_size(parameters,
                      dim,
                      (dim == 2 ? 8. : 24.) * mesh.n_active_cells(),
                      "Element");
      auto result = std::make_unique<Triangulation<dim>>();
      dealii::GridGenerator::convert_hypercube_to_simplex_mesh(mesh, *result);
      if (parameters.second_order)
        bend_divided_cells(mesh, *result);
      for (const auto id : mesh.get_manifold_ids())
        if (const auto &manifold = mesh.get_manifold(id);
            id != dealii::numbers::flat_manifold_id &&
            !belongs_to_mesh(manifold))
          result->set_manifold(id, manifold);
      return result;
    }

    /** The cells that elements ask for, all of one kind. */
    template <int dim>
    void
    settle_cells(std::unique_ptr<Triangulation<dim>> &mesh,
                 const MeshParameters                &parameters,
                 CellNodes<dim>                      &nodes)
    {
      using Cells = MeshParameters::Cells;
      const std::string where =
        parameters.where + (parameters.file.empty() ? "Generator: " : "File: ");
      if (mesh->n_active_cells() == 0)
        throw InputError(where + "the mesh has no cells. Check the arguments.");
      const bool simplices  = mesh->all_reference_cells_are_simplex();
      const bool hypercubes = mesh->all_reference_cells_are_hyper_cube();
      Assert(simplices || hypercubes,
             dealii::ExcMessage("Readers make cells of one kind."));
      if (simplices && parameters.cells == Cells::hypercubes)
        throw InputError(
          where + "the mesh has " + cell_name(dim, true) +
          ", but Element is for " + cell_name(dim, false) +
          ". Set Element = P1" + (dim == 2 ? ", P2" : "") +
          " or automatic, or use a mesh of " + cell_name(dim, false) +
          " (in Gmsh: '" +
          (dim == 2 ? "Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 1;" :
                      "Mesh.SubdivisionAlgorithm = 2;") +
          "').");
      if (hypercubes && parameters.cells == Cells::simplices)
        {
          mesh  = divide_into_simplices(*mesh, parameters);
          nodes = {};
        }
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Triangulation<dim>>
  generate_or_read(MeshParameters &parameters,
                   MeshGroups     &groups,
                   CellNodes<dim> &nodes)
  {
    auto mesh = std::make_unique<Triangulation<dim>>();
    if (parameters.file.empty())
      generate(*mesh, parameters);
    else
      {
        groups = read_mesh_file(parameters, *mesh, nodes);
        check_shared_faces(*mesh, parameters);
        check_sides_of_faces(*mesh, parameters);
      }
    settle_cells(mesh, parameters, nodes);
    return mesh;
  }

  template std::unique_ptr<Triangulation<2>>
  generate_or_read<2>(MeshParameters &, MeshGroups &, CellNodes<2> &);
  template std::unique_ptr<Triangulation<3>>
  generate_or_read<3>(MeshParameters &, MeshGroups &, CellNodes<3> &);
} // namespace conetact::bodies
