// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/file_cells.h"

#include "conetact/base/bent_edges.h"
#include "conetact/base/cell_splitting.h"
#include "conetact/base/errors.h"
#include "conetact/base/middle_nodes.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/grid_messages.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace conetact::bodies
{
  using dealii::GeometryInfo;
  using dealii::Triangulation;

  namespace
  {
    using Groups       = std::set<unsigned int>;
    using FileElements = std::vector<const FileMesh::Element *>;

    /** Its name, or its number if it has none. */
    std::string
    name_of_group(const FileMesh    &mesh,
                  const unsigned int dim,
                  const unsigned int group)
    {
      const auto name = mesh.names.find({dim, group});
      return name != mesh.names.end() ? name->second : std::to_string(group);
    }

    /**
     * An id for each combination of groups: the number of a group that is
     * alone, one of the program's own where several overlap, 0 for none.
     */
    class GroupIds
    {
    public:
      GroupIds(const FileMesh &m, const unsigned int d)
        : mesh(m)
        , dim(d)
      {
        for (const FileMesh::Element &element : mesh.elements)
          if (element.dim == dim)
            for (const unsigned int group : element.groups)
              next = std::max(next, group + 1);
      }

      unsigned int
      operator()(const Groups &groups)
      {
        if (groups.size() < 2)
          return groups.empty() ? 0 : *groups.begin();
        const auto [known, is_new] = overlaps.emplace(groups, next);
        next += is_new;
        return known->second;
      }

      /** Of all that was asked for, and of groups themselves: conditions may
       * give their numbers to further faces. */
      MeshGroups::Ids
      names(const std::set<Groups> &seen)
      {
        MeshGroups::Ids                     result;
        std::map<unsigned int, BoundaryIds> numbers;
        for (const Groups &groups : seen)
          for (const unsigned int group : groups)
            numbers[group].merge(BoundaryIds{group, (*this)(groups)});
        for (const auto &[group, ids] : numbers)
          {
            if (const auto name = mesh.names.find({dim, group});
                name != mesh.names.end())
              result[name->second].insert(ids.begin(), ids.end());
            if (group < own_numbers && ids.size() > 1)
              result[std::to_string(group)] = ids;
          }
        for (const Groups &groups : seen)
          name_own((*this)(groups), groups, result);
        return result;
      }

    private:
      /** The name of faces that are in these groups and in no other. */
      void
      name_own(const unsigned int id,
               const Groups      &groups,
               MeshGroups::Ids   &names) const
      {
        if (id < own_numbers)
          return;
        std::vector<std::string> parts;
        for (const unsigned int group : groups)
          parts.push_back(name_of_group(mesh, dim, group));
        std::string name = join(parts, " & ");
        std::replace(name.begin(), name.end(), ',', ' ');
        std::replace(name.begin(), name.end(), '#', ' ');
        if (names.count(name) > 0 && names[name] != BoundaryIds{id})
          name += " only";
        names[name] = {id};
      }

      const FileMesh                &mesh;
      unsigned int                   dim, next = own_numbers;
      std::map<Groups, unsigned int> overlaps;
    };

    /** Groups of the cells of this dimension, by their names if they have any.
     */
    std::string
    groups_of_cells(const FileMesh &mesh, const unsigned int dim)
    {
      Groups all;
      for (const FileMesh::Element &element : mesh.elements)
        if (element.dim == dim)
          all.insert(element.groups.begin(), element.groups.end());
      std::vector<std::string> names;
      for (const unsigned int group : all)
        names.push_back(name_of_group(mesh, dim, group));
      return names.size() < 2 ? "" : join(names);
    }

    /** Numbers and names of groups of this dimension that are asked for. */
    Groups
    wanted_groups(const FileMesh       &mesh,
                  const unsigned int    dim,
                  const MeshParameters &parameters)
    {
      MeshGroups::Ids known;
      for (const auto &[key, name] : mesh.names)
        if (key.first == dim)
          known[name] = {key.second};
      return to_ids(parameters.group,
                    known,
                    "the number of a group",
                    parameters.where + "Group");
    }

    FileElements
    cells_of(const FileMesh       &mesh,
             const unsigned int    dim,
             const MeshParameters &parameters)
    {
      Groups wanted;
      if (!parameters.group.empty())
        wanted = wanted_groups(mesh, dim, parameters);
      Groups       seen;
      FileElements cells;
      for (const FileMesh::Element &element : mesh.elements)
        if (element.dim == dim)
          {
            bool is_wanted = wanted.empty();
            for (const unsigned int group : element.groups)
              if (wanted.count(group) > 0)
                {
                  is_wanted = true;
                  seen.insert(group);
                }
            if (is_wanted)
              cells.push_back(&element);
          }
      for (const unsigned int group : wanted)
        if (seen.count(group) == 0)
          {
            const std::string names = groups_of_cells(mesh, dim);
            throw InputError(
              parameters.where + "Group: no cell of '" +
              parameters.file.string() + "' is in the group " +
              name_of_group(mesh, dim, group) + ". Name a physical " +
              (dim == 2 ? "surface" : "volume") + " of the file" +
              (names.empty() ? "." : ": " + names + "."));
          }
      return cells;
    }

    /** The points of the cells, renumbered without holes. */
    class Vertices
    {
    public:
      Vertices(const FileMesh &mesh, const FileElements &cells)
        : number(mesh.points.size(), unused)
      {
        for (const FileMesh::Element *cell : cells)
          for (const unsigned int node : cell->nodes)
            number[node] = 0;
        for (unsigned int i = 0; i < number.size(); ++i)
          if (number[i] != unused)
            {
              number[i] = static_cast<unsigned int>(places.size());
              point.push_back(i);
              places.push_back(mesh.points[i]);
            }
      }

      static constexpr unsigned int unused = ~0u;
      std::vector<unsigned int>     number; ///< of the file's points
      std::vector<unsigned int>     point;  ///< of the file, by this number
      std::vector<dealii::Point<3>> places;
    };

    template <int dim>
    std::vector<dealii::Point<dim>>
    in_plane(const std::vector<dealii::Point<3>> &places,
             const std::string                   &where)
    {
      double size = 0, beside = 0;
      for (const dealii::Point<3> &p : places)
        {
          size   = std::max(size, p.norm());
          beside = std::max(beside, std::abs(p[2] - places.front()[2]));
        }
      if (dim == 2 && beside > 1e-9 * size)
        throw InputError(where + "the mesh does not lie in the plane z = 0: " +
                         "its nodes differ in z by " + to_text(beside) +
                         ". Save it in the plane x, y.");
      std::vector<dealii::Point<dim>> result;
      for (const dealii::Point<3> &p : places)
        result.push_back(from_space<dim>(p));
      return result;
    }

    template <int dim>
    std::vector<dealii::CellData<dim>>
    cell_data(const FileElements &cells,
              const Vertices     &vertices,
              GroupIds           &ids)
    {
      std::vector<dealii::CellData<dim>> result;
      for (const FileMesh::Element *cell : cells)
        {
          const auto n = static_cast<unsigned int>(cell->nodes.size());
          dealii::CellData<dim> data(n);
          for (unsigned int i = 0; i < n; ++i)
            // Gmsh counts round faces of hypercubes, as UCD files do.
            data.vertices[n == GeometryInfo<dim>::vertices_per_cell ?
                            GeometryInfo<dim>::ucd_to_deal[i] :
                            i] = vertices.number[cell->nodes[i]];
          data.material_id = ids(cell->groups);
          result.push_back(data);
        }
      return result;
    }

    using Corners = std::vector<unsigned int>; ///< of a face, sorted

    template <int dim>
    MeshGroups::Ids
    set_boundary_ids(const FileMesh     &file,
                     const FileElements &faces,
                     const Vertices     &vertices,
                     Triangulation<dim> &mesh)
    {
      std::map<Corners, Groups> groups_of;
      for (const FileMesh::Element *element : faces)
        {
          Corners corners;
          for (const unsigned int node : element->nodes)
            corners.push_back(vertices.number[node]);
          std::sort(corners.begin(), corners.end());
          groups_of[corners].insert(element->groups.begin(),
                                    element->groups.end());
        }
      GroupIds         ids(file, dim - 1);
      std::set<Groups> seen;
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary())
          {
            Corners corners;
            for (const unsigned int v : face->vertex_indices())
              corners.push_back(face->vertex_index(v));
            std::sort(corners.begin(), corners.end());
            if (const auto found = groups_of.find(corners);
                found != groups_of.end())
              {
                face->set_boundary_id(ids(found->second));
                seen.insert(found->second);
              }
          }
      return ids.names(seen);
    }

    /* deal.II computes volumes of coordinates, not of their differences: cells
       that are far from the origin would be none. */
    template <int dim>
    void
    create_cells(const FileElements &cells,
                 const Vertices     &vertices,
                 const std::string  &where,
                 GroupIds           &ids,
                 Triangulation<dim> &mesh)
    {
      const auto places   = in_plane<dim>(vertices.places, where);
      auto       relative = places;
      for (dealii::Point<dim> &place : relative)
        place -= places.front();
      auto data = cell_data<dim>(cells, vertices, ids);
      dealii::GridTools::invert_cells_with_negative_measure(relative, data);
      // simplices have no order to be found
      if (std::all_of(data.begin(), data.end(), [](const auto &cell) {
            return cell.vertices.size() == GeometryInfo<dim>::vertices_per_cell;
          }))
        dealii::GridTools::consistently_order_cells(data);
      mesh.create_triangulation(relative, data, dealii::SubCellData());
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          cell->vertex(v) = places[cell->vertex_index(v)];
    }

    template <int dim>
    CellNodes<dim>
    nodes_of(const MiddleNodes        &middles,
             const Vertices           &vertices,
             const Triangulation<dim> &mesh)
    {
      if (middles.empty())
        return {};
      return make_cell_nodes<dim>(
        mesh, [&](const unsigned int v, const unsigned int w) {
          return from_space<dim>(
            middles.between(vertices.point[v], vertices.point[w]));
        });
    }

    [[noreturn]] void
    refuse_no_cells(const unsigned int dim, const MeshParameters &parameters)
    {
      throw InputError(parameters.where + "File: '" + parameters.file.string() +
                       "' has no cells of dimension " + std::to_string(dim) +
                       (dim == 2 ? ", quadrilaterals or triangles" :
                                   ", hexahedra or tetrahedra") +
                       ". Mesh it and save all elements (in Gmsh " +
                       "'Mesh.SaveAll = 1;'), or set Dimension.");
    }

    MeshGroups::Ids
    cell_groups(const FileElements &cells, GroupIds &ids)
    {
      std::set<Groups> seen;
      for (const FileMesh::Element *cell : cells)
        if (!cell->groups.empty())
          seen.insert(cell->groups);
      return ids.names(seen);
    }

    /** Those that have groups. */
    FileElements
    faces_of(const FileMesh &file, const unsigned int dim)
    {
      FileElements faces;
      for (const FileMesh::Element &element : file.elements)
        if (element.dim == dim - 1 && !element.groups.empty())
          faces.push_back(&element);
      return faces;
    }

    FileElements
    pointers(const std::vector<FileMesh::Element> &elements)
    {
      FileElements result;
      for (const FileMesh::Element &element : elements)
        result.push_back(&element);
      return result;
    }

    /** Cells and faces as they are taken, of one kind. */
    struct Taken
    {
      FileElements cells, faces;
      std::string  note; ///< how they were split

      /** Of split ones. */
      std::vector<FileMesh::Element> own_cells = {}, own_faces = {};
    };

    std::unique_ptr<Taken>
    take(const FileMesh       &file,
         const FileElements   &cells,
         const unsigned int    dim,
         const MeshParameters &parameters)
    {
      auto taken =
        std::make_unique<Taken>(Taken{cells, faces_of(file, dim), ""});
      if (!are_mixed(cells))
        return taken;
      const std::string kinds = count_of_kinds(cells);
      if (!parameters.split_mixed)
        throw InputError(parameters.where + "File: the mesh has " + kinds +
                         ", which no element carries together. Use a mesh of " +
                         cell_name(dim, false) + " only or of " +
                         cell_name(dim, true) +
                         " only, or set Mixed cells = split.");
      const bool joined = parameters.merge > 0; // and cells with their nodes
      taken->own_cells  = split_into_simplices(file, cells, joined);
      taken->own_faces  = split_into_simplices(file, taken->faces, joined);
      taken->cells      = pointers(taken->own_cells);
      taken->faces      = pointers(taken->own_faces);
      taken->note       = kinds + " split into " +
                    std::to_string(taken->cells.size()) + " " +
                    cell_name(dim, true);
      return taken;
    }
  } // namespace

  template <int dim>
  MeshGroups
  make_cells(const FileMesh       &file,
             const MeshParameters &parameters,
             Triangulation<dim>   &mesh,
             CellNodes<dim>       &nodes)
  {
    const FileElements cells = cells_of(file, dim, parameters);
    if (cells.empty())
      refuse_no_cells(dim, parameters);
    const auto     taken = take(file, cells, dim, parameters);
    const Vertices vertices(file, taken->cells);
    GroupIds       ids(file, dim);
    create_cells<dim>(
      taken->cells, vertices, parameters.where + "File: ", ids, mesh);
    nodes = nodes_of<dim>(MiddleNodes(file, cells), vertices, mesh);

    MeshGroups groups;
    groups.cells = cell_groups(taken->cells, ids);
    groups.faces = set_boundary_ids(file, taken->faces, vertices, mesh);
    groups.notes = file.notes;
    if (!taken->note.empty())
      groups.notes.push_back(taken->note);
    if (parameters.group.empty())
      if (const std::string names = groups_of_cells(file, dim); !names.empty())
        groups.notes.push_back("groups of its cells: " + names);
    const BentEdges bent = bent_edges(file, cells);
    groups.caution       = to_sentence(bent,
                                 parameters.file.filename().string(),
                                 parameters.placement.scale,
                                 parameters.to_scene(bent.place));
    return groups;
  }

  template MeshGroups
  make_cells<2>(const FileMesh &,
                const MeshParameters &,
                Triangulation<2> &,
                CellNodes<2> &);
  template MeshGroups
  make_cells<3>(const FileMesh &,
                const MeshParameters &,
                Triangulation<3> &,
                CellNodes<3> &);
} // namespace conetact::bodies
