// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/skin.h"

#include "conetact/bodies/face_nodes.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <map>

namespace conetact::output
{
  namespace
  {
    VtuGrid::Shape
    shape_of(const std::size_t n_nodes)
    {
      using Shape = VtuGrid::Shape;
      return n_nodes == 2 ? Shape::line :
             n_nodes == 3 ? Shape::triangle :
                            Shape::quadrilateral;
    }

    /** What contact does to a node of a skin. */
    struct ContactHere
    {
      double       pressure = 0;
      double       gap      = std::numeric_limits<double>::quiet_NaN();
      double       state    = -1;
      double       wear     = 0;
      Tensor<1, 3> traction;

      void
      add(const ContactRow &row)
      {
        const double p     = row.traction()[0];
        const bool   first = state < 0;
        traction += row.in_space(row.traction());
        wear = std::max(wear, row.wear);
        gap  = first ? row.gap : std::min(gap, row.gap);
        if (first || p > pressure)
          {
            pressure = p;
            state    = row.state_number();
          }
      }
    };

    std::map<unsigned int, ContactHere>
    contact_on(const RunDescription  &run,
               const IncrementRecord &record,
               const unsigned int     body)
    {
      std::map<unsigned int, ContactHere> nodes;
      for (const ContactRow &row : record.rows)
        if (run.contact_bodies.at(row.contact) == body)
          nodes[row.node].add(row);
      return nodes;
    }

    void
    append(VtuField &field, const Tensor<1, 3> &v)
    {
      for (unsigned int d = 0; d < 3; ++d)
        field.values.push_back(v[d]);
    }
  } // namespace



  Skin
  make_skin(const bodies::Structure &body)
  {
    Skin                                              skin;
    std::map<unsigned int, unsigned int>              number;
    std::map<std::vector<unsigned int>, unsigned int> seen;
    VtuIds                                            ids{"boundary_id", {}};
    const auto point = [&](const unsigned int node) {
      const auto [found, is_new] =
        number.emplace(node, static_cast<unsigned int>(skin.nodes.size()));
      if (is_new)
        {
          skin.nodes.push_back(node);
          skin.grid.points.push_back(body.position(node));
        }
      return found->second;
    };
    for (const unsigned int id : body.boundary_ids())
      for (const bodies::SurfaceFace &face : body.surface({id}).faces)
        {
          if (!seen.emplace(face.nodes, id).second)
            continue; // a member of a frame may have several ids
          for (const auto &part : bodies::parts_of_first_degree(body, face))
            {
              std::vector<unsigned int> points;
              for (const unsigned int node : part)
                points.push_back(point(node));
              skin.grid.add_cell(shape_of(points.size()), points);
              ids.values.push_back(static_cast<int>(id));
            }
        }
    skin.grid.cell_ids = {std::move(ids)};
    return skin;
  }



  Tensor<1, 3>
  displacement_of(const RunDescription  &run,
                  const IncrementRecord &record,
                  const unsigned int     body,
                  const unsigned int     node)
  {
    Tensor<1, 3> displacement;
    if (body < record.displacements.size())
      for (unsigned int c = 0; c < run.dim; ++c)
        displacement[c] =
          record
            .displacements[body]
                          [node * run.structures.at(body)->n_components() + c];
    return displacement;
  }



  VtuGrid
  draw_skin(const Skin            &skin,
            const RunDescription  &run,
            const IncrementRecord &record,
            const unsigned int     body)
  {
    AssertIndexRange(body, run.structures.size());
    AssertDimension(skin.nodes.size(), skin.grid.points.size());
    const auto contact = contact_on(run, record, body);
    VtuField   displacement{"displacement", 3, {}};
    VtuField   pressure{"contact_pressure", 1, {}};
    VtuField   traction{"contact_traction", 3, {}};
    VtuField   gap{"gap", 1, {}};
    VtuField   state{"state", 1, {}};
    VtuField   wear{"wear", 1, {}};
    for (const unsigned int node : skin.nodes)
      {
        const auto        found = contact.find(node);
        const ContactHere here =
          found == contact.end() ? ContactHere() : found->second;
        append(displacement, displacement_of(run, record, body, node));
        append(traction, here.traction);
        pressure.values.push_back(here.pressure);
        gap.values.push_back(here.gap);
        state.values.push_back(here.state);
        wear.values.push_back(here.wear);
      }
    VtuGrid grid      = skin.grid;
    grid.point_fields = {std::move(displacement),
                         std::move(pressure),
                         std::move(traction),
                         std::move(gap),
                         std::move(state)};
    if (!run.wearing.empty())
      grid.point_fields.push_back(std::move(wear));
    grid.cell_ids.push_back(
      {"body", std::vector<int>(grid.n_cells(), static_cast<int>(body))});
    return grid;
  }



  VtuGrid
  draw_contact_nodes(const RunDescription &run, const IncrementRecord &record)
  {
    VtuGrid grid;
    VtuIds  bodies{"body", {}};
    grid.point_fields = {{"reaction", 3, {}},
                         {"traction", 3, {}},
                         {"slip", 3, {}},
                         {"u", 3, {}},
                         {"normal", 3, {}},
                         {"displacement", 3, {}},
                         {"gap", 1, {}},
                         {"state", 1, {}},
                         {"contact", 1, {}},
                         {"pressure", 1, {}}};
    for (const ContactRow &row : record.rows)
      {
        const Tensor<1, 3> reaction = row.in_space(row.reaction);
        const unsigned int body     = run.contact_bodies.at(row.contact);
        std::size_t        field    = 0;
        for (const Tensor<1, 3> &vector :
             {reaction,
              row.in_space(row.traction()),
              row.du[1] * row.t1 + row.du[2] * row.t2,
              row.in_space(row.u),
              row.normal,
              displacement_of(run, record, body, row.node)})
          append(grid.point_fields[field++], vector);
        for (const double scalar : {row.gap,
                                    row.state_number(),
                                    static_cast<double>(row.contact),
                                    row.traction()[0]})
          grid.point_fields[field++].values.push_back(scalar);
        grid.add_cell(VtuGrid::Shape::vertex,
                      {static_cast<unsigned int>(grid.points.size())});
        grid.points.push_back(row.position);
        bodies.values.push_back(static_cast<int>(body));
      }
    grid.cell_ids = {std::move(bodies)};
    return grid;
  }
} // namespace conetact::output
