// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/material_groups.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/continuum_mesh.h"

#include <deal.II/grid/tria.h>

namespace conetact::bodies
{
  namespace
  {
    /** The places of materials by the ids of the mesh. */
    std::map<unsigned int, unsigned int>
    places_of_ids(const std::vector<MaterialOfGroups> &materials,
                  const MeshGroups::Ids               &groups,
                  const std::string                   &entry)
    {
      std::map<unsigned int, unsigned int> places;
      for (unsigned int i = 0; i < materials.size(); ++i)
        for (const unsigned int id :
             to_ids(materials[i].groups, groups, "a group of cells", entry))
          if (!places.emplace(id, i).second && places[id] != i)
            throw InputError(entry + ": some cells are in '" +
                             materials[places[id]].groups + "' and in '" +
                             materials[i].groups +
                             "' as well. Give groups "
                             "that do not overlap.");
      return places;
    }
  } // namespace

  template <int dim>
  void
  set_materials(dealii::Triangulation<dim>          &mesh,
                const std::vector<MaterialOfGroups> &materials,
                const MeshGroups::Ids               &groups,
                const std::string                   &body)
  {
    const std::string entry  = body + ", Material/Material group";
    const bool        one    = materials.front().groups.empty();
    const auto        places = one ? std::map<unsigned int, unsigned int>() :
                                     places_of_ids(materials, groups, entry);
    std::vector<bool> met(materials.size(), one);
    for (const auto &cell : mesh.active_cell_iterators())
      {
        const auto found = places.find(cell->material_id());
        if (!one && found == places.end())
          throw InputError(
            entry + ": the cell at " +
            to_text(Tensor<1, 3>(to_space(cell->center()))) +
            " is in none of these groups. Add its group, or take the cell "
            "out of the body by Mesh/Group.");
        const unsigned int place = one ? 0 : found->second;
        met[place]               = true;
        cell->set_material_id(place);
      }
    for (std::size_t i = 0; i < materials.size(); ++i)
      if (!met[i])
        throw InputError(entry + ": no cell of the body is in '" +
                         materials[i].groups + "'. Remove it.");
  }

  template void
  set_materials<2>(dealii::Triangulation<2> &,
                   const std::vector<MaterialOfGroups> &,
                   const MeshGroups::Ids &,
                   const std::string &);
  template void
  set_materials<3>(dealii::Triangulation<3> &,
                   const std::vector<MaterialOfGroups> &,
                   const MeshGroups::Ids &,
                   const std::string &);
} // namespace conetact::bodies
