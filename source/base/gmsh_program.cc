// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/gmsh_program.h"

#include "conetact/base/child_process.h"
#include "conetact/base/file_mesh.h"
#include "conetact/base/gmsh_groups.h"
#include "conetact/base/nastran_cards.h"
#include "conetact/base/nearest.h"
#include "conetact/base/text.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace conetact
{
  namespace
  {
    using namespace gmsh_model;

    void
    start(const GmshWishes &wishes)
    {
      std::vector<std::string> words = {"conetact"};
      for (const auto &[name, value] : wishes.constants)
        {
          std::ostringstream number;
          number.precision(17);
          number << value;
          words.insert(words.end(), {"-setnumber", name, number.str()});
        }
      std::vector<char *> arguments;
      for (std::string &word : words)
        arguments.push_back(word.data());
      gmsh::initialize(static_cast<int>(arguments.size()),
                       arguments.data(),
                       false);
      gmsh::logger::start();
      for (const auto &[option, value] :
           {std::pair("General.Terminal", 0.),
            std::pair("General.NumThreads", 1.),
            std::pair("Geometry.OCCImportLabels", 1.)})
        gmsh::option::setNumber(option, value);
    }

    /** The sides of the box around all. */
    Tensor<1, 3>
    extents()
    {
      Point<3> low, high;
      gmsh::model::getBoundingBox(
        -1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
      return high - low;
    }

    /** Sizes on entities and what bounds them; elsewhere it is the largest. */
    void
    set_sizes_near(const GmshWishes &wishes, const double largest)
    {
      std::map<std::pair<int, int>, double> sizes;
      for (const auto &[name, size] : wishes.near)
        {
          const std::set<int> any = {0, 1, 2, 3};
          const Entities      own = entities_of(name, any);
          if (own.empty())
            refuse_group(name, any);
          Entities bounds;
          gmsh::model::getBoundary(own, bounds, false, false, true);
          Entities curves;
          gmsh::model::getBoundary(own, curves, false, false, false);
          for (const Entities &list : {own, bounds, curves})
            for (const auto &entity : list)
              {
                const auto [found, is_new] = sizes.emplace(entity, size);
                found->second              = std::min(found->second, size);
              }
        }
      gmsh::model::mesh::setSizeCallback(
        [sizes, largest](int dim, int tag, double, double, double) {
          const auto found = sizes.find({dim, tag});
          return found == sizes.end() ? largest : found->second;
        });
    }

    /** Triangles of a surface become smooth faces, and these a volume. */
    void
    fill_surface()
    {
      constexpr double edge = 40; // degrees between faces
      gmsh::model::mesh::removeDuplicateNodes();
      gmsh::model::mesh::classifySurfaces(edge * std::acos(-1.) / 180,
                                          true,
                                          true,
                                          std::acos(-1.));
      gmsh::model::mesh::createGeometry();
      std::vector<int> surfaces;
      for (const auto &surface : entities(2))
        surfaces.push_back(surface.second);
      const int loop = gmsh::model::geo::addSurfaceLoop(surfaces);
      gmsh::model::geo::addVolume({loop});
      gmsh::model::geo::synchronize();
    }

    bool
    has_cells(const unsigned int dim)
    {
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, static_cast<int>(dim));
      return !types.empty();
    }

    std::string
    last_error()
    {
      std::string error;
      gmsh::logger::getLastError(error);
      return one_line(error);
    }

    std::filesystem::path
    temporary_folder()
    {
      std::string folder =
        (std::filesystem::temp_directory_path() / "conetact-XXXXXX").string();
      if (mkdtemp(folder.data()) == nullptr)
        throw FileFault{"there is no place for temporary files"};
      return folder;
    }

    std::string
    text_in(const std::filesystem::path &file)
    {
      std::ostringstream read;
      read << std::ifstream(file, std::ios::binary).rdbuf();
      return read.str();
    }

    /** With the first `old` replaced. */
    std::string
    replaced(std::string text, const std::string &old, const std::string &other)
    {
      if (const auto at = text.find(old); at != text.npos)
        text.replace(at, old.size(), other);
      return text;
    }

    /** A script may say so itself, by Error("..."), and goes on. */
    void
    refuse_errors_of_script()
    {
      std::vector<std::string> lines;
      gmsh::logger::get(lines);
      const std::string mark = "Error: ";
      for (const std::string &line : lines)
        if (line.rfind(mark, 0) == 0)
          throw FileFault{"Gmsh says: " + one_line(line.substr(mark.size()))};
    }

    /** Another text in place of that of a file, in a folder of its own, whose
     * mistakes are told with the name of the file. */
    void
    open_copy(const std::string &text, const std::filesystem::path &file)
    {
      const std::filesystem::path folder = temporary_folder();
      const std::filesystem::path copy   = folder / file.filename();
      std::ofstream(copy, std::ios::binary) << text;
      try
        {
          gmsh::open(copy.string());
          std::filesystem::remove_all(folder);
          refuse_errors_of_script();
        }
      catch (const FileFault &fault)
        {
          throw FileFault{replaced(fault.why, copy.string(), file.string())};
        }
      catch (...) // what Gmsh throws
        {
          std::filesystem::remove_all(folder);
          throw FileFault{"Gmsh says: " +
                          replaced(last_error(), copy.string(), file.string())};
        }
    }

    /** Gmsh leaves out what the last line says where it has no end, and writes
     * what a script saves beside the script: then a copy is opened, if the
     * script reads no other files. */
    void
    open_script(const std::filesystem::path &file)
    {
      const std::string text     = text_in(file);
      const bool        has_end  = text.empty() || text.back() == '\n';
      bool              is_alone = true;
      for (const char *other : {"Include", "Merge", "ShapeFromFile"})
        is_alone = is_alone && text.find(other) == std::string::npos;
      if (!has_end && !is_alone)
        throw FileFault{"its last line has no end, and Gmsh leaves out what "
                        "it says. Add a line break behind it"};
      if (is_alone &&
          (!has_end || std::regex_search(text, std::regex("\\bSave\\b"))))
        return open_copy(text + '\n', file);
      gmsh::open(file.string());
      refuse_errors_of_script();
    }

    /** By the drawing itself; a very large one by default. */
    double
    largest_size_given()
    {
      double size = 0;
      gmsh::option::getNumber("Mesh.MeshSizeMax", size);
      return size;
    }

    /** Of cells that would fill the box around all. */
    void
    refuse_too_many(const double size, const unsigned int dim)
    {
      constexpr double   most  = 1e8;
      const Tensor<1, 3> sides = extents();
      double             n     = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n *= std::max(1., sides[d] / size);
      if (n > most)
        throw FileFault{"cells of " + to_text(size) + " would be some " +
                          to_text(std::round(n)) +
                          " in the box around it. Give a larger one",
                        "Size"};
    }

    /** Says which size of cells it took itself, else 0. */
    double
    mesh_drawing(const std::string &extension,
                 const unsigned int dim,
                 const GmshWishes  &wishes)
    {
      constexpr double part        = 20; // of the diagonal
      constexpr double cells_round = 12; // a circle
      if (entities(dim).empty())
        throw FileFault{
          "it has no " + std::string(dim == 3 ? "volume" : "surface") +
          " that could be meshed in " + std::to_string(dim) + "D"};
      const bool   brings_sizes = extension == "geo";
      const double own =
        wishes.size || brings_sizes ? 0 : extents().norm() / part;
      const double largest = wishes.size ? *wishes.size :
                             own > 0     ? own :
                                           largest_size_given();
      refuse_too_many(largest, dim);
      gmsh::option::setNumber("Mesh.MeshSizeMax", largest);
      if (!brings_sizes)
        gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", cells_round);
      if (!wishes.near.empty())
        set_sizes_near(wishes, largest);
      if (!wishes.group.empty())
        hide_others(wishes.group, static_cast<int>(dim));
      if (!has_cells(dim)) // a .geo may mesh by itself
        gmsh::model::mesh::generate(static_cast<int>(dim));
      if (wishes.order == 2)
        {
          gmsh::option::setNumber("Mesh.HighOrderOptimize", 1);
          gmsh::model::mesh::setOrder(2);
        }
      if (!has_cells(dim))
        throw FileFault{"Gmsh makes no cells of it. " + last_error()};
      return own;
    }

    /** The mesh as a file of version 4.1. */
    std::string
    text_of_mesh(const unsigned int dim)
    {
      bool has_group = false;
      for (const auto &group : groups())
        has_group = has_group || group.first == static_cast<int>(dim);
      for (const auto &[option, value] :
           {std::pair("Mesh.MshFileVersion", 4.1),
            std::pair("Mesh.Binary", 0.),
            std::pair("Mesh.SaveParametric", 0.),
            std::pair("Mesh.SaveAll", has_group ? 0. : 1.)})
        gmsh::option::setNumber(option, value);
      const std::filesystem::path folder = temporary_folder();
      const std::filesystem::path file   = folder / "mesh.msh";
      gmsh::write(file.string());
      std::string text = text_in(file);
      std::filesystem::remove_all(folder);
      return text;
    }

    std::string
    read_and_mesh(const std::filesystem::path &file,
                  const unsigned int           dim,
                  const GmshWishes            &wishes)
    {
      const std::string extension = extension_of(file);
      start(wishes);
      if (extension == "geo")
        open_script(file);
      else if (extension == "bdf" || extension == "nas")
        open_copy(with_whole_cards(text_in(file)), file);
      else
        gmsh::open(file.string());
      double size = 0;
      if (extension == "stl")
        fill_surface();
      make_groups(dim);
      if (is_drawing(extension))
        size = mesh_drawing(extension, dim, wishes);
      else if (!has_cells(dim))
        throw FileFault{"Gmsh finds no cells of dimension " +
                        std::to_string(dim) + " in it. " + last_error()};
      std::ostringstream number;
      number.precision(17);
      number << size;
      return number.str() + "\n" + text_of_mesh(dim);
    }

    /** In the process apart. Throws ChildRefusal: the entry that asks for it, a
     * line on its own, and why. */
    std::string
    mesh_or_refusal(const std::filesystem::path &file,
                    const unsigned int           dim,
                    const GmshWishes            &wishes)
    {
      try
        {
          return read_and_mesh(file, dim, wishes);
        }
      catch (const FileFault &fault)
        {
          throw ChildRefusal{fault.entry + '\n' + trim(fault.why)};
        }
      catch (const std::bad_alloc &)
        {
          throw;
        }
      catch (...) // a string, a number, an exception: Gmsh throws them all
        {
          throw ChildRefusal{"\nGmsh says: " + last_error()};
        }
    }

    FileFault
    fault_of(const std::string &refusal)
    {
      const auto end = refusal.find('\n');
      FileFault  fault{refusal.substr(end + 1), refusal.substr(0, end)};
      while (!fault.why.empty() && fault.why.back() == '.')
        fault.why.pop_back();
      return fault;
    }
  } // namespace

  bool
  is_drawing(const std::string &extension)
  {
    static const std::set<std::string> drawings = {
      "step", "stp", "brep", "iges", "igs", "geo", "stl"};
    return drawings.count(extension) > 0;
  }

  GmshResult
  run_gmsh(const std::filesystem::path &file,
           const unsigned int           dim,
           const GmshWishes            &wishes)
  {
    // Meshing takes its time; what damaged files ask for has an end.
    const bool        meshes = is_drawing(extension_of(file));
    const ChildLimits limits = {meshes ? 3600. : 120., meshes ? 3e10 : 4e9};
    const ChildResult result = in_child_process(limits, [&] {
      return mesh_or_refusal(file, dim, wishes);
    });
    if (!result.why.empty())
      throw FileFault{"Gmsh " + result.why};
    if (result.refused)
      throw fault_of(*result.refused);
    const auto end = result.bytes.find('\n');
    return {result.bytes.substr(end + 1),
            std::strtod(result.bytes.c_str(), nullptr)};
  }
} // namespace conetact
