// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/library_meshes.h"

#include "conetact/base/child_process.h"
#include "conetact/base/errors.h"
#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/grid_messages.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/vector.hpp>

#include <cmath>
#include <sstream>
#include <tuple>

namespace conetact::bodies
{
  using dealii::GeometryInfo;
  using dealii::GridIn;
  using dealii::Triangulation;

  namespace
  {
    /** VTK's grids of version 2.0 are written as those of 3.0. */
    std::string
    prepared(const LibraryFile &file)
    {
      std::string       contents = file.contents;
      const std::string head     = "# vtk DataFile Version ";
      if (file.format == GridIn<2>::vtk && contents.rfind(head + "2.0", 0) == 0)
        contents[head.size()] = '3';
      return contents;
    }

    /** All that makes a mesh that is not refined. */
    template <int dim>
    struct CoarseMesh
    {
      std::vector<dealii::Point<dim>>    vertices;
      std::vector<dealii::CellData<dim>> cells;
      dealii::SubCellData                faces;

      template <class Stream>
      void
      pass(Stream &stream)
      {
        stream &vertices &cells &faces.boundary_lines &faces.boundary_quads;
      }
    };

    template <int dim>
    CoarseMesh<dim>
    read_coarse_mesh(const LibraryFile &file)
    {
      Triangulation<dim> mesh;
      std::istringstream stream(prepared(file));
      GridIn<dim>(mesh).read(
        stream, static_cast<typename GridIn<dim>::Format>(file.format));
      CoarseMesh<dim> coarse;
      std::tie(coarse.vertices, coarse.cells, coarse.faces) =
        dealii::GridTools::get_coarse_mesh_description(mesh);
      return coarse;
    }

    /** In the process apart. Throws ChildRefusal with what deal.II says against
     * the file. */
    template <int dim>
    std::string
    bytes_of_mesh(const LibraryFile &file)
    {
      // This process has no other thread.
      dealii::MultithreadInfo::set_thread_limit(1);
      try
        {
          CoarseMesh<dim>                 mesh = read_coarse_mesh<dim>(file);
          std::ostringstream              bytes;
          boost::archive::binary_oarchive stream(bytes);
          mesh.pass(stream);
          return bytes.str();
        }
      catch (const std::bad_alloc &)
        {
          throw;
        }
      catch (const std::exception &error)
        {
          throw ChildRefusal{message_of(error)};
        }
    }

    /** In brackets, unless it tells users nothing. */
    std::string
    remark(const std::string &message)
    {
      for (const char *empty :
           {"currently not implemented", "error message printed above"})
        if (message.find(empty) != message.npos)
          return "";
      return " (" + message + ")";
    }

    template <int dim>
    [[noreturn]] void
    refuse(const LibraryFile &file, const std::string &message)
    {
      throw InputError(
        file.where + "'" + file.name + "' cannot be read as a mesh of " +
        cell_name(dim, false) + " or " + cell_name(dim, true) +
        ". Check that it is whole and of dimension " + std::to_string(dim) +
        ", or write it as .msh." + remark(message));
    }

    /** A reader that went astray may have come to an end. */
    template <int dim>
    bool
    is_sound(const CoarseMesh<dim> &mesh)
    {
      for (const dealii::Point<dim> &vertex : mesh.vertices)
        if (!std::isfinite(vertex.norm_square()))
          return false;
      for (const dealii::CellData<dim> &cell : mesh.cells)
        for (const unsigned int vertex : cell.vertices)
          if (vertex >= mesh.vertices.size())
            return false;
      return true;
    }

    /** Hundreds of bytes of a mesh for each of a file, some seconds for each
     * million of these. */
    ChildLimits
    limits_for(const LibraryFile &file)
    {
      const auto bytes = static_cast<double>(file.contents.size());
      return {3 + 2e-5 * bytes, 2e8 + 500 * bytes};
    }

    /** Corners once round in place of deal.II's order. */
    std::vector<unsigned int>
    corners_once_round(const std::vector<unsigned int> &vertices,
                       const unsigned int               dim)
    {
      std::vector<unsigned int> corners = vertices;
      const bool is_round = vertices.size() == (dim == 2 ? 3u : 4u) ||
                            vertices.size() == 6; // a simplex, a wedge
      if (dim == 3 && vertices.size() == 8)
        for (unsigned int i = 0; i < 8; ++i)
          corners[i] = vertices[GeometryInfo<3>::ucd_to_deal[i]];
      else if (!is_round && vertices.size() >= 4) // also the base of a pyramid
        std::swap(corners[2], corners[3]);
      return corners;
    }

    template <int dim>
    void
    add_elements(const std::vector<dealii::CellData<dim>> &cells,
                 const bool                                are_faces,
                 FileMesh                                 &mesh)
    {
      for (const dealii::CellData<dim> &cell : cells)
        {
          FileMesh::Element  element{dim,
                                    corners_once_round(cell.vertices, dim),
                                    {}};
          const unsigned int id =
            are_faces ? cell.boundary_id : cell.material_id;
          if (are_faces &&
              (id == dealii::numbers::internal_face_boundary_id || id == 0))
            continue;
          if (id != 0)
            element.groups = {id};
          mesh.elements.push_back(std::move(element));
        }
    }

    template <int dim>
    FileMesh
    file_mesh(const CoarseMesh<dim> &coarse)
    {
      FileMesh mesh;
      for (const dealii::Point<dim> &p : coarse.vertices)
        mesh.points.push_back(to_space(p));
      add_elements(coarse.cells, false, mesh);
      if (dim == 2)
        add_elements(coarse.faces.boundary_lines, true, mesh);
      else
        add_elements(coarse.faces.boundary_quads, true, mesh);
      return mesh;
    }
  } // namespace

  template <int dim>
  FileMesh
  read_by_library(const LibraryFile &file)
  {
    const ChildResult result = in_child_process(limits_for(file), [&file] {
      return bytes_of_mesh<dim>(file);
    });
    if (!result.why.empty())
      refuse<dim>(file, "the reader of this format " + result.why);
    if (result.refused)
      refuse<dim>(file, *result.refused);
    std::istringstream              bytes(result.bytes);
    boost::archive::binary_iarchive stream(bytes);
    CoarseMesh<dim>                 coarse;
    coarse.pass(stream);
    if (!is_sound(coarse))
      refuse<dim>(file,
                  "it names nodes that are not there, or places that "
                  "are not finite");
    return file_mesh(coarse);
  }

  template FileMesh
  read_by_library<2>(const LibraryFile &);
  template FileMesh
  read_by_library<3>(const LibraryFile &);
} // namespace conetact::bodies
