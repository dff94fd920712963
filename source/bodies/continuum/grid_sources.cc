// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/grid_sources.h"

#include "conetact/base/errors.h"
#include "conetact/base/gmsh_file.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/generator_arguments.h"
#include "conetact/bodies/continuum/gmsh_mesh.h"

#include <deal.II/base/patterns.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <tuple>

namespace conetact::bodies
{
  using dealii::GridIn;
  using dealii::Triangulation;

  namespace
  {
    template <int dim>
    std::string
    cell_name(const bool simplices)
    {
      if (simplices)
        return dim == 2 ? "triangles" : "tetrahedra";
      return dim == 2 ? "quadrilaterals" : "hexahedra";
    }

    void
    erase_all(std::string &text, const std::string &part)
    {
      for (auto at = text.find(part); at != std::string::npos;
           at      = text.find(part))
        text.erase(at, part.size());
    }

    /** What deal.II has to say: one line, without banner and bounds. */
    std::string
    message_of(const std::exception &error)
    {
      const auto *deal = dynamic_cast<const dealii::ExceptionBase *>(&error);
      if (deal == nullptr)
        return one_line(error.what());
      if (dynamic_cast<const dealii::ExcIO *>(deal) != nullptr)
        return "it ends early, or holds something else";
      std::ostringstream text;
      deal->print_info(text);
      std::string message = one_line(text.str());
      for (const char *bounds : {" -MAX_DOUBLE...MAX_DOUBLE (inclusive)",
                                 " of length 0...4294967295 (inclusive)"})
        erase_all(message, bounds);
      for (char &c : message) // a binary file is quoted as it is
        if (static_cast<unsigned char>(c) < 32 ||
            static_cast<unsigned char>(c) > 126)
          c = '?';
      return message.size() > 300 ? message.substr(0, 300) + "..." : message;
    }

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

    std::string
    lower_case(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      });
      return text;
    }

    /** By extension; Abaqus shares .inp with UCD but starts with a keyword. */
    GridIn<2>::Format
    format_of(const std::filesystem::path &file,
              std::istream                &stream,
              const std::string           &where)
    {
      std::string extension = lower_case(file.extension().string());
      extension.erase(0, 1);
      if (extension == "inp" && (stream >> std::ws).peek() == '*')
        return GridIn<2>::abaqus;
      for (const char *known : {"msh",
                                "vtk",
                                "vtu",
                                "unv",
                                "inp",
                                "ucd",
                                "xda",
                                "dbmesh",
                                "dat",
                                "tecplot"})
        if (extension == known)
          return GridIn<2>::parse_format(extension);
      throw InputError(where + "'" + file.string() +
                       "' is of no known mesh format. Use .msh, .vtk, .vtu, " +
                       ".unv, .inp, .ucd, .xda, .dbmesh or .dat.");
    }

    std::ifstream
    open_mesh(const std::filesystem::path &file, const std::string &where)
    {
      std::error_code error;
      if (!std::filesystem::exists(file, error))
        throw InputError(where + "there is no file '" + file.string() +
                         "'. Give a path relative to the scene's folder.");
      if (!std::filesystem::is_regular_file(file, error))
        throw InputError(where + "'" + file.string() +
                         "' is not a file. Name a mesh file.");
      if (std::filesystem::file_size(file, error) == 0)
        throw InputError(where + "'" + file.string() +
                         "' is empty. Write the mesh again.");
      std::ifstream stream(file);
      if (!stream)
        throw InputError(where + "'" + file.string() +
                         "' cannot be opened. Check its permissions.");
      return stream;
    }

    /** Gmsh's binary files share the extension of its text files. */
    void
    refuse_binary(std::istream &stream, const std::string &file)
    {
      std::string line;
      std::getline(stream, line);
      double version = 0;
      int    binary  = 0;
      if (trim(line) == "$MeshFormat" && stream >> version >> binary && binary)
        throw InputError(file + " is a binary Gmsh file of version " +
                         to_text(version) + ". Save it as version 4.1 or 2.2 " +
                         "(in Gmsh 'Mesh.MshFileVersion = 4.1;').");
    }

    /** GridIn would wait for the rest of a Gmsh file for ever. */
    void
    check_gmsh_sections(std::istream &stream, const std::string &file)
    {
      std::string line, open;
      bool        elements = false;
      while (std::getline(stream, line))
        if (line[0] == '$')
          {
            line = lower_case(trim(line));
            if (open.empty())
              open = line.substr(1);
            else if (line == "$end" + open)
              {
                elements = elements || open == "elements" || open == "elm";
                open.clear();
              }
          }
      if (!open.empty() || !elements)
        throw InputError(file + " is no whole Gmsh mesh: " +
                         (open.empty() ?
                            "it has no elements" :
                            "its section '" + open + "' does not end") +
                         ". Write it again.");
    }

    void
    check_gmsh(std::istream &stream, const std::string &file)
    {
      refuse_binary(stream, file);
      stream.clear();
      stream.seekg(0);
      check_gmsh_sections(stream, file);
      stream.clear();
      stream.seekg(0);
    }

    /** GridIn knows no names, reads text only and refuses groups inside. */
    bool
    is_for_own_reader(const std::string &contents)
    {
      const double version = gmsh_version(contents);
      return (version >= 2 && version < 3) || version == 4.1;
    }

    /** GridIn prints what it finds wrong in files of Abaqus. */
    class SilentErrors
    {
    public:
      SilentErrors()
        : buffer(std::cerr.rdbuf(nullptr))
      {}
      SilentErrors(const SilentErrors &) = delete;
      SilentErrors &
      operator=(const SilentErrors &) = delete;
      ~SilentErrors()
      {
        std::cerr.rdbuf(buffer);
      }

    private:
      std::streambuf *buffer;
    };

    /** Grids of version 2.0 are written alike. */
    std::string
    vtk_of_version_3(std::istream &stream)
    {
      std::ostringstream contents;
      contents << stream.rdbuf();
      std::string       text = contents.str();
      const std::string head = "# vtk DataFile Version ";
      if (text.rfind(head + "2.0", 0) == 0)
        text[head.size()] = '3';
      return text;
    }

    /** In brackets, unless it tells users nothing. */
    std::string
    remark_of(const std::exception &error)
    {
      const std::string message = message_of(error);
      for (const char *empty :
           {"currently not implemented", "error message printed above"})
        if (message.find(empty) != message.npos)
          return "";
      return " (" + message + ")";
    }

    template <int dim>
    void
    read(Triangulation<dim>   &mesh,
         const MeshParameters &parameters,
         MeshGroups           &groups)
    {
      const std::string where  = parameters.where + "File: ";
      std::ifstream     stream = open_mesh(parameters.file, where);
      const auto        format = static_cast<typename GridIn<dim>::Format>(
        format_of(parameters.file, stream, where));
      if (format == GridIn<dim>::msh)
        {
          std::ostringstream contents;
          contents << stream.rdbuf();
          if (is_for_own_reader(contents.str()))
            {
              groups = read_gmsh_mesh<dim>(contents.str(), parameters, mesh);
              return;
            }
          stream.clear();
          stream.seekg(0);
          check_gmsh(stream, where + "'" + parameters.file.string() + "'");
        }
      if (!parameters.group.empty())
        throw InputError(parameters.where + "Group: only Gmsh's files (.msh) "
                                            "of version 2 and 4.1 have "
                                            "groups of cells. Save the mesh as "
                                            "one, or remove Group.");
      try
        {
          const SilentErrors silent;
          if (format == GridIn<dim>::vtk)
            {
              std::istringstream contents(vtk_of_version_3(stream));
              GridIn<dim>(mesh).read(contents, format);
            }
          else
            GridIn<dim>(mesh).read(stream, format);
        }
      catch (const std::exception &error)
        {
          throw InputError(
            where + "'" + parameters.file.string() +
            "' cannot be read as a mesh of " + cell_name<dim>(false) + " or " +
            cell_name<dim>(true) + ". Check that it is whole and " +
            "of dimension " + std::to_string(dim) +
            (format == GridIn<dim>::msh ?
               "" :
               ", or write it as .msh (Gmsh writes other formats in ways "
               "that are not read)") +
            "." + remark_of(error));
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
      for (const auto id : mesh.get_manifold_ids())
        if (const auto &manifold = mesh.get_manifold(id);
            id != dealii::numbers::flat_manifold_id &&
            !belongs_to_mesh(manifold))
          result->set_manifold(id, manifold);
      return result;
    }

    /** "2 hexahedra, 1 wedges" */
    template <int dim>
    std::string
    count_of_cells(const Triangulation<dim> &mesh)
    {
      namespace Cells = dealii::ReferenceCells;
      std::string text;
      for (const auto &[kind, name] :
           {std::pair(Cells::get_hypercube<dim>(), cell_name<dim>(false)),
            std::pair(Cells::get_simplex<dim>(), cell_name<dim>(true)),
            std::pair(Cells::Wedge, std::string("wedges")),
            std::pair(Cells::Pyramid, std::string("pyramids"))})
        {
          unsigned int n = 0;
          for (const auto &cell : mesh.active_cell_iterators())
            n += cell->reference_cell() == kind;
          if (n > 0)
            text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + name;
        }
      return text;
    }

    /** The cells that elements ask for, all of one kind. */
    template <int dim>
    void
    settle_cells(std::unique_ptr<Triangulation<dim>> &mesh,
                 const MeshParameters                &parameters)
    {
      using Cells = MeshParameters::Cells;
      const std::string where =
        parameters.where + (parameters.file.empty() ? "Generator: " : "File: ");
      if (mesh->n_active_cells() == 0)
        throw InputError(where + "the mesh has no cells. Check the arguments.");
      const bool simplices  = mesh->all_reference_cells_are_simplex();
      const bool hypercubes = mesh->all_reference_cells_are_hyper_cube();
      if (!simplices && !hypercubes)
        throw InputError(where + "the mesh has cells of several kinds, or " +
                         "wedges or pyramids: " + count_of_cells(*mesh) +
                         ". No element carries them together: use a mesh of " +
                         cell_name<dim>(false) + " only or of " +
                         cell_name<dim>(true) + " only.");
      if (simplices && parameters.cells == Cells::hypercubes)
        throw InputError(
          where + "the mesh has " + cell_name<dim>(true) +
          ", but Element is for " + cell_name<dim>(false) +
          ". Set Element = P1" + (dim == 2 ? ", P2" : "") +
          " or automatic, or use a mesh of " + cell_name<dim>(false) +
          " (in Gmsh: '" +
          (dim == 2 ? "Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 1;" :
                      "Mesh.SubdivisionAlgorithm = 2;") +
          "').");
      if (hypercubes && parameters.cells == Cells::simplices)
        mesh = divide_into_simplices(*mesh, parameters);
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Triangulation<dim>>
  generate_or_read(MeshParameters &parameters, MeshGroups &groups)
  {
    auto mesh = std::make_unique<Triangulation<dim>>();
    if (parameters.file.empty())
      generate(*mesh, parameters);
    else
      {
        read(*mesh, parameters, groups);
        check_shared_faces(*mesh, parameters);
      }
    settle_cells(mesh, parameters);
    return mesh;
  }

  template std::unique_ptr<Triangulation<2>>
  generate_or_read<2>(MeshParameters &, MeshGroups &);
  template std::unique_ptr<Triangulation<3>>
  generate_or_read<3>(MeshParameters &, MeshGroups &);
} // namespace conetact::bodies
