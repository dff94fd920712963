// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/mesh_parameters.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/drawings.h"

#include <algorithm>
#include <cmath>

namespace conetact::bodies
{
  using dealii::ParameterHandler;
  using dealii::Point;
  using dealii::Tensor;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    void
    declare_source(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Generator",
        "",
        Patterns::Anything(),
        "Name of a function of deal.II's GridGenerator that makes the mesh, "
        "such as hyper_rectangle, subdivided_hyper_rectangle, hyper_ball or "
        "plate_with_a_hole. Either this or File must be given. [-]");
      prm.declare_entry(
        "Arguments",
        "",
        Patterns::Anything(),
        "All arguments of that function, also those with a default, "
        "separated by ':'; the components of points and lists by ','. For "
        "subdivided_hyper_rectangle: '50, 50 : 0, 0 : 80, 80 : true' (cells "
        "a direction, two corners, boundary ids 0 to 3 for left, right, "
        "bottom, top); subdivided_hyper_rectangle_with_simplices takes the "
        "same. [length]");
      prm.declare_entry(
        "File",
        "",
        Patterns::Anything(),
        "A file with the body, relative to the scene's folder; its extension "
        "says what it is. Meshes: Gmsh (.msh), decks of Abaqus and CalculiX "
        "(.inp), I-DEAS (.unv), Nastran (.bdf, .nas), .vtk, .mesh, UCD (.ucd, "
        ".inp), .xda, Tecplot's .dat (2D) and .med, if the Gmsh library was "
        "built with it. Drawings, which Gmsh meshes in the run (see Size): "
        ".step, .stp, .iges and .igs (in millimetres), .brep, .geo, closed "
        "surfaces of triangles (.stl); the mesh is written beside the results "
        "as mesh_BODY.msh. Groups (physical groups of Gmsh; sets, surfaces "
        "and instances of decks) have names and numbers that stand for ids in "
        "all entries: 'Boundary ids = floor'. Groups with names only have no "
        "numbers; what is in several groups is 'floor & side'. What has no groups, as a .step "
        "file, has the numbers of surfaces and volumes that Gmsh shows. Of "
        "decks the mesh is read, not the analysis; a set of nodes is the "
        "faces that have all their corners in it. Middle nodes of second "
        "order are read. [length]");
      prm.declare_entry(
        "Group",
        "",
        Patterns::Anything(),
        "Groups of a file whose cells are this body (physical groups, element "
        "sets, instances, volumes of a drawing), by name or number, separated "
        "by commas; empty: all cells. So bodies may share one file, each with "
        "a Group of its own; boundary groups that lie between two of them "
        "belong to both. [-]");
      prm.declare_entry(
        "Mixed cells",
        "split",
        Patterns::Selection("split|refuse"),
        "What becomes of wedges, pyramids and meshes that mix tetrahedra with "
        "hexahedra, or triangles with quadrilaterals. split: all cells are "
        "divided into tetrahedra (triangles), through the node that stands "
        "first in the file, so that neighbours fit; refuse: such a mesh is an "
        "error. Hexahedra alone stay. [-]");
      prm.declare_entry(
        "Merge",
        "0",
        Patterns::Double(0, .5),
        "Nodes of a file nearer to each other than this part of the longest "
        "edge of its smallest cell become one node, such as 1e-6 for bodies "
        "of pieces that were not joined. 0: none. [-]");
    }

    void
    declare_refinement(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Global refinements",
        "0",
        Patterns::Integer(0, 12),
        "How many times each cell is divided in 4 (2D) or 8 (3D). Curved "
        "bodies of a generator are refined to the curved shape. [-]");
      prm.declare_entry(
        "Refinement boxes",
        "",
        Patterns::Anything(),
        "Boxes in which the mesh is refined further: two corners and the "
        "number of divisions, 'x0, y0 : x1, y1 : levels ; ...' (3D: three "
        "coordinates a corner), in the scene's coordinates. Cells that "
        "reach into a box are refined; nodes that hang on a coarser cell "
        "follow it. Levels count from Global refinements; where boxes "
        "overlap the one with most levels counts, so that a box inside "
        "another one needs more of them: '-2, 0 : 2, 2 : 1 ; -1, 0 : 1, 1 : "
        "3'. [length]");
      prm.declare_entry(
        "Refinement distance",
        "",
        Patterns::Anything(),
        "Boundaries beside which the mesh is refined further, such as those "
        "of contact: boundary ids or names of groups, a distance and the number of divisions, "
        "'2 : 5 : 3 ; 4, 6 : 1 : 2'. Cells nearer than the distance to a face "
        "of these ids (between the boxes around cell and face, along the axes "
        "of the mesh as generated or read) are refined. Boxes come first. "
        "[length]");
    }

    unsigned int
    to_levels(const std::string &text, const std::string &entry)
    {
      const double levels = to_number(text, entry);
      if (!(levels >= 0 && levels <= 12 && levels == std::floor(levels)))
        throw InputError(entry + ": '" + text +
                         "' is not a number of levels. "
                         "Give a whole number from 0 to 12.");
      return static_cast<unsigned int>(levels);
    }

    bool
    is_inside(const MeshParameters::Box &a, const MeshParameters::Box &b)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (a.lower[d] < b.lower[d] || a.upper[d] > b.upper[d])
          return false;
      return true;
    }

    void
    refuse_idle_boxes(const std::vector<MeshParameters::Box> &boxes,
                      const std::string                      &entry)
    {
      for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t k = 0; k < boxes.size(); ++k)
          if (i != k && boxes[i].levels <= boxes[k].levels &&
              is_inside(boxes[i], boxes[k]))
            throw InputError(
              entry + ": box " + std::to_string(i + 1) + " has no effect, it " +
              "lies inside box " + std::to_string(k + 1) + " with " +
              std::to_string(boxes[k].levels) + " levels. Levels count from " +
              "Global refinements: give it more than " +
              std::to_string(boxes[k].levels) + ", or remove it.");
    }

    std::vector<MeshParameters::Box>
    parse_boxes(const std::string &text,
                const unsigned int dim,
                const std::string &entry)
    {
      std::vector<MeshParameters::Box> boxes;
      for (const std::string &part : split(text, ';'))
        {
          const std::vector<std::string> fields = split(part, ':');
          if (fields.size() != 3)
            throw InputError(
              entry + ": '" + part +
              "' is not a box. Write two corners and the " +
              "number of levels, separated by ':', such as " +
              (dim == 2 ? "0, 0 : 1, 1 : 2." : "0, 0, 0 : 1, 1, 1 : 2."));
          const Tensor<1, 3>  a = to_vector(fields[0], dim, entry);
          const Tensor<1, 3>  b = to_vector(fields[1], dim, entry);
          MeshParameters::Box box;
          for (unsigned int d = 0; d < 3; ++d)
            {
              box.lower[d] = std::min(a[d], b[d]);
              box.upper[d] = std::max(a[d], b[d]);
            }
          box.levels = to_levels(fields[2], entry);
          boxes.push_back(box);
        }
      refuse_idle_boxes(boxes, entry);
      return boxes;
    }

    std::vector<MeshParameters::Zone>
    parse_zones(const std::string &text, const std::string &entry)
    {
      std::vector<MeshParameters::Zone> zones;
      for (const std::string &part : split(text, ';'))
        {
          const std::vector<std::string> fields = split(part, ':');
          if (fields.size() != 3)
            throw InputError(entry + ": '" + part +
                             "' is not a distance. "
                             "Write boundary ids, the distance and the number "
                             "of levels, separated by ':', such as 2 : 5 : 3.");
          const double distance = to_number(fields[1], entry);
          if (!(distance > 0 && std::isfinite(distance)))
            throw InputError(entry + ": the distance '" + fields[1] +
                             "' is not positive. Give a length above 0.");
          zones.push_back({fields[0], distance, to_levels(fields[2], entry)});
        }
      return zones;
    }

    void
    declare_boundary_ids(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Boundary ids",
        "",
        Patterns::Anything(),
        "Boundary ids of faces by conditions, 'id: condition ; ...', such as "
        "'7: y > 79.9 && x < 40 ; 8: abs(x) < 1e-6': a face of the finished "
        "mesh whose centre (x, y, z in the scene's coordinates) satisfies a "
        "condition gets its id. Later ones win; other faces keep theirs. What "
        "Adaptive refinement divides passes its ids on. [-]");
    }

    void
    check_source(const MeshParameters &mesh)
    {
      if (mesh.generator.empty() == mesh.file.empty())
        throw InputError(mesh.where + "Generator: " +
                         (mesh.file.empty() ?
                            "there is no mesh. Set Generator or File." :
                            "both Generator and File are set. Remove one."));
      const std::string of_file = !mesh.group.empty() ? "Group" :
                                  mesh.merge > 0      ? "Merge" :
                                                   first_entry_of(mesh.wishes);
      if (mesh.file.empty() && !of_file.empty())
        throw InputError(mesh.where + of_file +
                         ": it is for files, not for a generated mesh. Set "
                         "File, or remove it.");
      if (!mesh.file.empty() && !mesh.arguments.empty())
        throw InputError(mesh.where + "Arguments: a file takes no arguments. " +
                         "Remove them.");
    }
  } // namespace

  unsigned int
  MeshParameters::boundary_id(const unsigned int      own,
                              const dealii::Point<3> &centre) const
  {
    unsigned int id = own;
    for (const BoundaryTag &tag : tags)
      if (tag.condition(centre) != 0)
        id = tag.id;
    return id;
  }

  void
  declare_mesh(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    declare_source(prm);
    declare_drawing(prm);
    declare_refinement(prm);
    declare_placement(prm);
    declare_boundary_ids(prm);
    prm.leave_subsection();
  }

  MeshParameters
  parse_mesh(ParameterHandler            &prm,
             const unsigned int           dim,
             const std::filesystem::path &folder,
             const std::string           &body)
  {
    MeshParameters mesh;
    mesh.where      = body + ", Mesh/";
    const auto text = [&](const char *entry) { return trim(prm.get(entry)); };

    prm.enter_subsection("Mesh");
    mesh.generator = text("Generator");
    mesh.arguments = text("Arguments");
    if (!text("File").empty())
      mesh.file = folder / text("File");
    mesh.group        = text("Group");
    mesh.wishes       = parse_drawing(prm, mesh.where);
    mesh.wishes.group = mesh.group;
    mesh.split_mixed  = text("Mixed cells") == "split";
    mesh.merge        = prm.get_double("Merge");
    check_source(mesh);
    mesh.global_refinements =
      static_cast<unsigned int>(prm.get_integer("Global refinements"));
    mesh.boxes     = parse_boxes(text("Refinement boxes"),
                             dim,
                             mesh.where + "Refinement boxes");
    mesh.zones     = parse_zones(text("Refinement distance"),
                             mesh.where + "Refinement distance");
    mesh.placement = parse_placement(prm, dim, mesh.where);
    mesh.tags = parse_tags(text("Boundary ids"), mesh.where + "Boundary ids");
    prm.leave_subsection();
    return mesh;
  }
} // namespace conetact::bodies
