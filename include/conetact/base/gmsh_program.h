// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_gmsh_program_h
#define conetact_base_gmsh_program_h

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace conetact
{
  /** What a user may ask of a mesh that is made of a drawing. */
  struct GmshWishes
  {
    using Values = std::vector<std::pair<std::string, double>>;

    std::optional<double> size;      ///< of cells, at most [length]
    Values                near;      ///< beside entities or groups, by name
    unsigned int          order = 1; ///< of cells
    Values                constants; ///< of DefineConstant
    std::string           group;     ///< of cells, all that is meshed
  };

  /** Whether a file of this extension is a drawing, which Gmsh must mesh first:
   * "step". */
  bool
  is_drawing(const std::string &extension);

  /** A mesh as Gmsh writes it. */
  struct GmshResult
  {
    std::string contents; ///< of a mesh file of version 4.1
    double      size = 0; ///< of cells of a drawing that brings none, else 0
  };

  /**
   * Has Gmsh read a file of any format that it knows, and mesh it if it is a
   * drawing. The parts of what has no physical groups become groups with the
   * numbers that Gmsh shows, and the names of solids. Gmsh works in a process
   * apart, so that it neither prints nor takes this one along. Throws
   * FileFault.
   */
  GmshResult
  run_gmsh(const std::filesystem::path &file,
           const unsigned int           dim,
           const GmshWishes            &wishes);
} // namespace conetact

#endif
