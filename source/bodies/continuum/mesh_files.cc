// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/mesh_files.h"

#include "conetact/base/child_process.h"
#include "conetact/base/errors.h"
#include "conetact/base/gmsh_file.h"
#include "conetact/base/nearest.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/file_cells.h"
#include "conetact/bodies/continuum/grid_messages.h"

#include <deal.II/base/multithread_info.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/vector.hpp>

#include <cmath>
#include <fstream>
#include <sstream>
#include <tuple>

namespace conetact::bodies
{
  using dealii::GridIn;
  using dealii::Triangulation;

  namespace
  {
    /** What is offered. Each row is tested: check_program.py, formats. */
    struct Format
    {
      const char       *extension;
      GridIn<2>::Format reader; ///< of deal.II
    };
    constexpr Format formats[] = {{"msh", GridIn<2>::msh},
                                  {"vtk", GridIn<2>::vtk},
                                  {"unv", GridIn<2>::unv},
                                  {"inp", GridIn<2>::ucd},
                                  {"ucd", GridIn<2>::ucd},
                                  {"xda", GridIn<2>::xda},
                                  {"dat", GridIn<2>::tecplot}};

    /** A file of a mesh and what is said of it. */
    struct MeshFile
    {
      std::string       where; ///< "Body 'block', Mesh/File: "
      std::string       name;
      GridIn<2>::Format format;
      std::string       contents;
    };

    /** Abaqus shares .inp with UCD but starts with a keyword. */
    GridIn<2>::Format
    format_of(const MeshFile &file)
    {
      std::string extension =
        lower_case(std::filesystem::path(file.name).extension().string());
      extension.erase(0, 1);
      const std::size_t first = file.contents.find_first_not_of(" \t\r\n");
      if (extension == "inp" && first != std::string::npos &&
          file.contents[first] == '*')
        return GridIn<2>::abaqus;
      std::string known;
      for (const Format &format : formats)
        if (extension == format.extension)
          return format.reader;
        else
          known +=
            (known.empty() ? "." : ", .") + std::string(format.extension);
      throw InputError(file.where + "'" + file.name +
                       "' is of no known mesh format. Use one of " + known +
                       ".");
    }

    MeshFile
    open_mesh(const MeshParameters &parameters)
    {
      MeshFile file;
      file.where                        = parameters.where + "File: ";
      file.name                         = parameters.file.string();
      const std::string           start = file.where + "'" + file.name + "' ";
      std::error_code             error;
      const std::filesystem::path path = parameters.file;
      if (!std::filesystem::exists(path, error))
        throw InputError(file.where + "there is no file '" + file.name +
                         "'. Give a path relative to the scene's folder.");
      if (!std::filesystem::is_regular_file(path, error))
        throw InputError(start + "is not a file. Name a mesh file.");
      if (std::filesystem::file_size(path, error) == 0)
        throw InputError(start + "is empty. Write the mesh again.");
      std::ifstream stream(path);
      if (!stream)
        throw InputError(start + "cannot be opened. Check its permissions.");
      std::ostringstream contents;
      contents << stream.rdbuf();
      file.contents = contents.str();
      file.format   = format_of(file);
      return file;
    }

    /** Gmsh's binary files share the extension of its text files. */
    void
    refuse_binary_gmsh(const MeshFile &file)
    {
      std::istringstream stream(file.contents);
      std::string        line;
      std::getline(stream, line);
      double version = 0;
      int    binary  = 0;
      if (trim(line) == "$MeshFormat" && stream >> version >> binary && binary)
        throw InputError(file.where + "'" + file.name +
                         "' is a binary Gmsh file of version " +
                         to_text(version) + ". Save it as version 4.1 or 2.2 " +
                         "(in Gmsh 'Mesh.MshFileVersion = 4.1;').");
    }

    /** deal.II knows no names, reads text only and refuses groups inside. */
    bool
    is_for_own_reader(const MeshFile &file)
    {
      const double version = gmsh_version(file.contents);
      return file.format == GridIn<2>::msh &&
             ((version >= 2 && version < 3) || version == 4.1);
    }

    /** VTK's grids of version 2.0 are written as those of 3.0. */
    void
    prepare(MeshFile &file)
    {
      const std::string head = "# vtk DataFile Version ";
      if (file.format == GridIn<2>::vtk &&
          file.contents.rfind(head + "2.0", 0) == 0)
        file.contents[head.size()] = '3';
      if (file.format == GridIn<2>::msh)
        refuse_binary_gmsh(file);
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
    read_by_library(const MeshFile &file)
    {
      Triangulation<dim> mesh;
      std::istringstream stream(file.contents);
      GridIn<dim>(mesh).read(
        stream, static_cast<typename GridIn<dim>::Format>(file.format));
      CoarseMesh<dim> coarse;
      std::tie(coarse.vertices, coarse.cells, coarse.faces) =
        dealii::GridTools::get_coarse_mesh_description(mesh);
      return coarse;
    }

    constexpr char has_mesh = 'm', has_message = 'e';

    /** In the process apart: a mesh, or what deal.II says against the file. */
    template <int dim>
    std::string
    mesh_or_message(const MeshFile &file)
    {
      // This process has no other thread.
      dealii::MultithreadInfo::set_thread_limit(1);
      try
        {
          CoarseMesh<dim>    mesh = read_by_library<dim>(file);
          std::ostringstream bytes;
          bytes << has_mesh;
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
          return has_message + message_of(error);
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
    refuse(const MeshFile &file, const std::string &message)
    {
      throw InputError(
        file.where + "'" + file.name + "' cannot be read as a mesh of " +
        cell_name(dim, false) + " or " + cell_name(dim, true) +
        ". Check that it is whole and of dimension " + std::to_string(dim) +
        (file.format == GridIn<2>::msh ?
           "" :
           ", or write it as .msh (Gmsh writes other formats in ways that "
           "are not read)") +
        "." + remark(message));
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
    limits_for(const MeshFile &file)
    {
      const auto bytes = static_cast<double>(file.contents.size());
      return {3 + 2e-5 * bytes, 2e8 + 500 * bytes};
    }

    template <int dim>
    void
    read_apart(const MeshFile &file, Triangulation<dim> &mesh)
    {
      const ChildResult result = in_child_process(limits_for(file), [&file] {
        return mesh_or_message<dim>(file);
      });
      if (!result.why.empty())
        refuse<dim>(file, "the reader of this format " + result.why);
      if (result.bytes[0] == has_message)
        refuse<dim>(file, result.bytes.substr(1));
      std::istringstream              bytes(result.bytes.substr(1));
      boost::archive::binary_iarchive stream(bytes);
      CoarseMesh<dim>                 coarse;
      coarse.pass(stream);
      if (!is_sound(coarse))
        refuse<dim>(file,
                    "it names nodes that are not there, or places that "
                    "are not finite");
      mesh.create_triangulation(coarse.vertices, coarse.cells, coarse.faces);
    }
    template <int dim>
    MeshGroups
    read_by_own_reader(const MeshFile       &file,
                       const MeshParameters &parameters,
                       Triangulation<dim>   &mesh,
                       CellNodes<dim>       &nodes)
    {
      try
        {
          return make_cells<dim>(read_gmsh(file.contents),
                                 parameters,
                                 mesh,
                                 nodes);
        }
      catch (const FileFault &fault)
        {
          throw InputError(
            file.where + "'" + file.name +
            "' is no mesh of Gmsh that can be taken: " + fault.why + ".");
        }
      catch (const dealii::ExceptionBase &)
        {
          throw InputError(file.where + "the cells of '" + file.name +
                           "' make no mesh: some are flat, or lie in each "
                           "other. Mesh it again.");
        }
    }
  } // namespace



  template <int dim>
  MeshGroups
  read_mesh_file(const MeshParameters &parameters,
                 Triangulation<dim>   &mesh,
                 CellNodes<dim>       &nodes)
  {
    MeshFile file = open_mesh(parameters);
    if (is_for_own_reader(file))
      return read_by_own_reader(file, parameters, mesh, nodes);
    if (!parameters.group.empty())
      throw InputError(parameters.where + "Group: only Gmsh's files (.msh) "
                                          "of version 2 and 4.1 have "
                                          "groups of cells. Save the mesh as "
                                          "one, or remove Group.");
    prepare(file);
    read_apart(file, mesh);
    return {};
  }

  template MeshGroups
  read_mesh_file<2>(const MeshParameters &, Triangulation<2> &, CellNodes<2> &);
  template MeshGroups
  read_mesh_file<3>(const MeshParameters &, Triangulation<3> &, CellNodes<3> &);
} // namespace conetact::bodies
