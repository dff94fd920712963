// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/body_table.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/continuum.h"
#include "conetact/bodies/continuum/grid_messages.h"
#include "conetact/bodies/continuum/grids.h"
#include "conetact/bodies/continuum/material_groups.h"
#include "conetact/bodies/frame/frame.h"
#include "conetact/bodies/frame/parameters.h"

#include <deal.II/grid/tria.h>

namespace conetact::bodies
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    const std::string automatic = "automatic"; ///< element that suits the cells

    /** "continuum|frame" and a list with descriptions for the manual. */
    template <class Row>
    std::pair<std::string, std::string>
    choices(const std::vector<Row> &table)
    {
      std::pair<std::string, std::string> result;
      for (const Row &row : table)
        {
          const bool first = result.first.empty();
          result.first += (first ? "" : "|") + std::string(row.name);
          result.second += (first ? "" : "; ") + std::string(row.name) + ": " +
                           row.description;
        }
      return result;
    }

    template <class Row>
    const Row &
    find_row(const std::vector<Row> &table, const std::string &name)
    {
      for (const Row &row : table)
        if (row.name == name)
          return row;
      throw InputError("There is no '" + name + "'."); // a pattern forbids it
    }



    void
    declare_continuum(ParameterHandler &prm)
    {
      const auto elements = choices(element_table<2>());
      prm.declare_entry("Element",
                        automatic,
                        Patterns::Selection(automatic + ("|" + elements.first)),
                        "Kind of elements. automatic: " +
                          std::string(default_element<2>(false, 1).name) +
                          " on quadrilaterals and hexahedra, " +
                          default_element<2>(true, 1).name +
                          " on triangles and tetrahedra; where a mesh file is "
                          "of second order " +
                          default_element<2>(false, 2).name + " and " +
                          default_element<2>(true, 2).name +
                          ", but for bodies of revolution; " + elements.second +
                          ". On a mesh of quadrilaterals or hexahedra P1 and "
                          "P2 divide each into 8 triangles or 24 tetrahedra. "
                          "[-]");
      declare_mesh(prm);
      declare_material(prm);
    }

    /** So that what a kind of body does not read is not passed over. */
    void
    expect_unset(ParameterHandler                &prm,
                 const std::vector<const char *> &entries,
                 const std::string               &section,
                 const std::string               &body)
    {
      prm.enter_subsection(section);
      for (const char *entry : entries)
        if (!trim(prm.get(entry)).empty())
          throw InputError(body + ", " + section + "/" + entry +
                           ": it is not for bodies of this Kind. Remove it, "
                           "or change Kind.");
      prm.leave_subsection();
    }

    /** What bodies of revolution do not have. */
    void
    check_section(const unsigned int dim,
                  const std::string &element,
                  const bool         goes_round,
                  const std::string &body)
    {
      if (dim == 3)
        throw InputError(body + ", Material/Plane: axisymmetric is for "
                                "Dimension = 2, where the mesh is half a "
                                "section. Set that, or remove Plane.");
      if (!goes_round)
        throw InputError(body + ", Element: " + element +
                         " is not for bodies of revolution (Plane = "
                         "axisymmetric), only Q1 and Q1 B-bar are. Choose one "
                         "of these.");
    }

    /** Of the element that is chosen by itself. */
    template <int dim>
    std::string
    why_element(const ElementRow<dim> &row)
    {
      return std::string("Element = ") + automatic + ": " + row.name +
             ", for " + cell_name(dim, row.is_simplex) +
             (row.degree > 1 ? " with nodes in the middle of edges" : "");
    }

    template <int dim>
    std::unique_ptr<Structure>
    make_continuum(MeshParameters                      &mesh,
                   const std::vector<MaterialOfGroups> &materials,
                   const std::string                   &element,
                   const std::string                   &body)
    {
      const ElementRow<dim> *row = element == automatic ?
                                     nullptr :
                                     &find_row(element_table<dim>(), element);
      if (row != nullptr)
        {
          mesh.cells = row->is_simplex ? MeshParameters::Cells::simplices :
                                         MeshParameters::Cells::hypercubes;
          mesh.second_order = row->degree > 1;
        }
      mesh.on_axis = materials.front().material.is_axisymmetric();
      if (mesh.on_axis)
        check_section(dim, element, row == nullptr || row->goes_round, body);
      MeshGroups     groups;
      CellNodes<dim> nodes;
      auto           triangulation = make_mesh<dim>(mesh, groups, nodes);
      set_materials(*triangulation, materials, groups.cells, body);
      if (row == nullptr)
        {
          row = &default_element<dim>(
            !triangulation->all_reference_cells_are_hyper_cube(),
            nodes.empty() || mesh.on_axis ? 1 : 2);
          groups.notes.push_back(why_element(*row));
        }
      if (row->degree > 1)
        groups.caution.clear(); // edges may be bent
      std::vector<ElasticMaterial> of_cells;
      for (const MaterialOfGroups &material : materials)
        of_cells.push_back(material.material);
      auto made = std::make_unique<Continuum<dim>>(std::move(triangulation),
                                                   of_cells,
                                                   *row,
                                                   groups,
                                                   nodes,
                                                   mesh.is_to_be_halved);
      if (const auto folded = made->folded_cell())
        throw InputError(
          mesh.where + (mesh.file.empty() ? "Generator: " : "File: ") +
          "the cell at " + to_text(Tensor<1, 3>(*folded)) +
          " is folded: with its nodes in the middle of bent edges its volume "
          "is not positive everywhere. Move these nodes or refine the mesh "
          "there; where its corners are right, Element of first degree takes "
          "the edges as straight.");
      return made;
    }

    std::unique_ptr<Structure>
    create_continuum(ParameterHandler            &prm,
                     const unsigned int           dim,
                     const std::filesystem::path &folder,
                     const std::string           &name,
                     const Refinements           &refinements)
    {
      const std::string body = "Body '" + name + "'";
      expect_unset(prm, {"Generator", "File", "Nodes"}, "Frame", body);
      const std::string element   = prm.get("Element");
      const auto        materials = parse_materials(prm, dim, body);
      MeshParameters    mesh      = parse_mesh(prm, dim, folder, body);
      mesh.refinements            = refinements;
      switch (dim)
        {
          case 2:
            return make_continuum<2>(mesh, materials, element, body);
          case 3:
            return make_continuum<3>(mesh, materials, element, body);
          default:
            throw InputError("Dimension: " + std::to_string(dim) +
                             " is neither 2 nor 3.");
        }
    }

    std::unique_ptr<Structure>
    create_frame(ParameterHandler            &prm,
                 const unsigned int           dim,
                 const std::filesystem::path &folder,
                 const std::string           &name,
                 const Refinements & /*refinements*/)
    {
      const std::string body = "Body '" + name + "'";
      expect_unset(prm, {"Generator", "File", "Boundary ids"}, "Mesh", body);
      return std::make_unique<Frame>(parse_frame(prm, dim, folder, body));
    }
  } // namespace

  const std::vector<BodyRow> &
  body_table()
  {
    static const std::vector<BodyRow> table = {
      {"continuum",
       "linear elastic solid on a mesh of quadrilaterals, hexahedra, triangles or tetrahedra",
       &declare_continuum,
       &create_continuum},
      {"frame",
       "bars and beams between nodes, with Sections and subsection Frame",
       &declare_frame,
       &create_frame}};
    return table;
  }

  void
  declare_body(ParameterHandler &prm)
  {
    const auto kinds = choices(body_table());
    prm.declare_entry("Kind",
                      body_table().front().name,
                      Patterns::Selection(kinds.first),
                      "Kind of body. " + kinds.second + ". [-]");
    for (const BodyRow &row : body_table())
      row.declare(prm);
  }

  std::unique_ptr<Structure>
  create_body(ParameterHandler            &prm,
              const unsigned int           dim,
              const std::filesystem::path &folder,
              const std::string           &name,
              const Refinements           &refinements)
  {
    return find_row(body_table(), prm.get("Kind"))
      .create(prm, dim, folder, name, refinements);
  }
} // namespace conetact::bodies
