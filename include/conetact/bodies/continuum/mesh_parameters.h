// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_mesh_parameters_h
#define conetact_bodies_continuum_mesh_parameters_h

#include "conetact/base/gmsh_program.h"
#include "conetact/bodies/placement.h"
#include "conetact/bodies/structure.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace conetact::bodies
{
  /** The parsed entries of `subsection Mesh`. */
  struct MeshParameters
  {
    /**
     * Cells that touch the inside of a box are refined `levels` times more than
     * the rest of the mesh; where boxes overlap the largest number counts.
     */
    struct Box
    {
      dealii::Point<3> lower, upper; ///< in the scene's coordinates
      unsigned int     levels;
    };
    /** Cells nearer to faces of `ids` are refined `levels` times more. */
    struct Zone
    {
      std::string            text;     ///< ids or names of groups
      double                 distance; ///< of the scene [length]
      unsigned int           levels;
      std::set<unsigned int> ids{}; ///< when the mesh is there
    };
    /** What elements ask for; quadrilaterals can be made into triangles. */
    enum class Cells
    {
      any,
      hypercubes,
      simplices
    };
    std::string              where; ///< for messages: "Body 'block', Mesh/"
    Cells                    cells = Cells::any;
    std::string              generator, arguments;
    std::filesystem::path    file;  ///< empty: generated
    std::string              group; ///< of cells in the file; empty: all
    GmshWishes               wishes;
    bool                     split_mixed = true; ///< else they are refused
    double                   merge = 0; ///< of the size of the smallest cell
    unsigned int             global_refinements = 0;
    std::vector<Box>         boxes;
    std::vector<Zone>        zones; ///< beside boundaries
    Placement                placement;
    bool                     on_axis      = false; ///< half a section, x >= 0
    bool                     second_order = false; ///< cells may be bent
    std::vector<BoundaryTag> tags;        ///< of faces, by their centres
    Refinements              refinements; ///< of tagged meshes
    /** Whether make_mesh() has left one refinement of all cells, of which
     * deal.II need not know, to halved(). */
    bool is_to_be_halved = false;

    /** A point of the mesh as generated or read, scaled, rotated, moved. */
    dealii::Point<3>
    to_scene(const dealii::Point<3> &p) const
    {
      return placement.to_scene(p);
    }
    /** Of a face with this centre, in the scene, that has the id `own`. */
    unsigned int
    boundary_id(const unsigned int own, const dealii::Point<3> &centre) const;
  };

  /** Entries of `subsection Mesh`, in the body's subsection. */
  void
  declare_mesh(dealii::ParameterHandler &prm);
  /**
   * A relative file is one in `folder`; `body` is for messages: "Body
   * 'block'". Throws InputError.
   */
  MeshParameters
  parse_mesh(dealii::ParameterHandler    &prm,
             const unsigned int           dim,
             const std::filesystem::path &folder,
             const std::string           &body);
} // namespace conetact::bodies

#endif
