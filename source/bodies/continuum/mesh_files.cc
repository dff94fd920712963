// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/mesh_files.h"

#include "conetact/base/deck_mesh.h"
#include "conetact/base/errors.h"
#include "conetact/base/gmsh_file.h"
#include "conetact/base/joined_points.h"
#include "conetact/base/text.h"
#include "conetact/base/unv_file.h"
#include "conetact/base/vtk_middles.h"
#include "conetact/bodies/continuum/drawings.h"
#include "conetact/bodies/continuum/file_cells.h"
#include "conetact/bodies/continuum/library_meshes.h"

#include <deal.II/grid/tria.h>

#include <cctype>
#include <fstream>
#include <sstream>

namespace conetact::bodies
{
  using dealii::GridIn;
  using dealii::Triangulation;

  namespace
  {
    /** A file of a mesh and what is said of it. */
    struct MeshFile
    {
      std::string where; ///< "Body 'block', Mesh/File: "
      std::string name, extension, contents;
    };

    /** A mesh, and its file where it was made in this run. */
    struct Reading
    {
      FileMesh    mesh;
      std::string made = {};
    };

    using Reader = Reading (*)(const MeshFile &, const MeshParameters &);

    template <int dim>
    Reading
    read_with_gmsh(const MeshFile &file, const MeshParameters &parameters)
    {
      GmshResult result = run_gmsh(parameters.file, dim, parameters.wishes);
      Reading    reading{read_gmsh(result.contents)};
      if (is_drawing(file.extension))
        reading.made = std::move(result.contents);
      if (result.size > 0)
        reading.mesh.notes.push_back("meshed with Size = " +
                                     to_text(result.size));
      return reading;
    }

    /** Versions of today have a reader of their own. */
    template <int dim>
    Reading
    read_msh(const MeshFile &file, const MeshParameters &parameters)
    {
      const double version = gmsh_version(file.contents);
      if ((version >= 2 && version < 3) || version == 4.1)
        return {read_gmsh(file.contents)};
      return read_with_gmsh<dim>(file, parameters);
    }

    template <int dim, GridIn<2>::Format format>
    Reading
    read_with_library(const MeshFile &file, const MeshParameters &)
    {
      return {
        read_by_library<dim>({file.where, file.name, file.contents, format})};
    }

    /** deal.II keeps their ids, but does not read all of them. */
    template <int dim, GridIn<2>::Format format>
    Reading
    read_with_both(const MeshFile &file, const MeshParameters &parameters)
    {
      try
        {
          return read_with_library<dim, format>(file, parameters);
        }
      catch (const InputError &refused)
        {
          try
            {
              Reading reading = read_with_gmsh<dim>(file, parameters);
              arrange_middles_of_vtk(reading.mesh);
              return reading;
            }
          catch (const FileFault &)
            {
              throw refused;
            }
        }
    }

    /** Abaqus shares .inp with UCD but starts with a keyword. */
    template <int dim>
    Reading
    read_inp(const MeshFile &file, const MeshParameters &parameters)
    {
      const std::size_t first = file.contents.find_first_not_of(" \t\r\n");
      if (first != std::string::npos && file.contents[first] == '*')
        return {read_deck(file.contents, parameters.file)};
      return read_with_library<dim, GridIn<2>::ucd>(file, parameters);
    }

    Reading
    read_universal(const MeshFile &file, const MeshParameters &)
    {
      return {read_unv(file.contents)};
    }

    /** What is offered. Each row is tested: check_program.py, formats. */
    struct Format
    {
      const char *extension;
      Reader      read;
    };
    template <int dim>
    const std::vector<Format> &
    formats()
    {
      static const std::vector<Format> all = {
        {"msh", read_msh<dim>},
        {"inp", read_inp<dim>},
        {"step", read_with_gmsh<dim>},
        {"stp", read_with_gmsh<dim>},
        {"brep", read_with_gmsh<dim>},
        {"iges", read_with_gmsh<dim>},
        {"igs", read_with_gmsh<dim>},
        {"geo", read_with_gmsh<dim>},
        {"stl", read_with_gmsh<dim>},
        {"bdf", read_with_gmsh<dim>},
        {"nas", read_with_gmsh<dim>},
        {"med", read_with_gmsh<dim>},
        {"mesh", read_with_gmsh<dim>},
        {"unv", read_universal},
        {"vtk", read_with_both<dim, GridIn<2>::vtk>},
        {"ucd", read_with_library<dim, GridIn<2>::ucd>},
        {"xda", read_with_library<dim, GridIn<2>::xda>},
        {"dat", read_with_library<dim, GridIn<2>::tecplot>}};
      return all;
    }

    template <int dim>
    Reader
    reader_of(const MeshFile &file)
    {
      std::vector<std::string> known;
      for (const Format &format : formats<dim>())
        if (file.extension == format.extension)
          return format.read;
        else
          known.push_back("." + std::string(format.extension));
      throw InputError(file.where + "'" + file.name +
                       "' is of no known mesh format. Use one of " +
                       join(known) + ".");
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
      file.contents  = contents.str();
      file.extension = extension_of(path);
      return file;
    }

    bool
    has_word(const std::string &text, const std::string &word)
    {
      const auto is_part = [](const char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
      };
      std::size_t at = text.find(word);
      while (at != std::string::npos)
        {
          const std::size_t end = at + word.size();
          if ((at == 0 || !is_part(text[at - 1])) &&
              (end == text.size() || !is_part(text[end])))
            return true;
          at = text.find(word, end);
        }
      return false;
    }

    /** Whether a value may be given to it from outside: a plain assignment in
     * the drawing would overwrite that. */
    bool
    lets_define(const std::string &drawing, const std::string &constant)
    {
      for (const std::string command : {"DefineConstant", "Exists"})
        for (std::size_t at = drawing.find(command); at != std::string::npos;
             at             = drawing.find(command, at + 1))
          if (has_word(drawing.substr(at, drawing.find(';', at) - at),
                       constant))
            return true;
      return false;
    }

    /** A name that the drawing does not have would be passed over. */
    void
    check_constants(const MeshFile &file, const MeshParameters &parameters)
    {
      for (const auto &[name, value] : parameters.wishes.constants)
        if (file.extension != "geo" ||
            (!lets_define(file.contents, name) &&
             file.contents.find("Include") == std::string::npos))
          throw InputError(parameters.where + "Parameters: '" + file.name +
                           "' has no constant '" + name +
                           "'. Name one of 'DefineConstant' of a .geo file.");
    }

    /** What only drawings have must not be passed over. */
    void
    check_wishes(const MeshFile &file, const MeshParameters &parameters)
    {
      if (is_drawing(file.extension))
        {
          check_constants(file, parameters);
          return;
        }
      if (const std::string entry = first_entry_of(parameters.wishes);
          !entry.empty())
        throw InputError(parameters.where + entry + ": '" + file.name +
                         "' is a mesh already. Remove it, or give a drawing "
                         "(.step, .geo).");
    }

    void
    join_places(FileMesh &mesh, const MeshParameters &parameters)
    {
      if (parameters.merge == 0)
        return;
      const std::size_t n = join_points(mesh, parameters.merge);
      mesh.notes.push_back(std::to_string(n) +
                           " nodes at places of others are joined with them");
    }
  } // namespace



  template <int dim>
  MeshGroups
  read_mesh_file(const MeshParameters &parameters,
                 Triangulation<dim>   &mesh,
                 CellNodes<dim>       &nodes)
  {
    const MeshFile file = open_mesh(parameters);
    const auto     read = reader_of<dim>(file);
    check_wishes(file, parameters);
    try
      {
        Reading reading = read(file, parameters);
        join_places(reading.mesh, parameters);
        MeshGroups groups =
          make_cells<dim>(reading.mesh, parameters, mesh, nodes);
        groups.made_mesh = std::move(reading.made);
        return groups;
      }
    catch (const FileFault &fault)
      {
        const std::string says = fault.why + '.';
        throw InputError(fault.entry.empty() ?
                           file.where + "'" + file.name +
                             "' is no mesh that can be taken: " + says :
                           parameters.where + fault.entry + ": " + says);
      }
    catch (const dealii::ExceptionBase &)
      {
        throw InputError(file.where + "the cells of '" + file.name +
                         "' make no mesh: some are flat, or lie in each "
                         "other. Mesh it again.");
      }
  }

  template MeshGroups
  read_mesh_file<2>(const MeshParameters &, Triangulation<2> &, CellNodes<2> &);
  template MeshGroups
  read_mesh_file<3>(const MeshParameters &, Triangulation<3> &, CellNodes<3> &);
} // namespace conetact::bodies
