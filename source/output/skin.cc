// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/skin.h"

#include "conetact/bodies/face_nodes.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
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

    constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    Tensor<1, 3>
    slip_of(const model::ContactRow &row)
    {
      return row.du[1] * row.t1 + row.du[2] * row.t2;
    }

    /** Not a number where it faces nothing. */
    double
    gap_of(const model::ContactRow &row)
    {
      return row.faces ? row.gap : nan;
    }

    /** What contact does to a node of a body. */
    struct ContactHere
    {
      double                    pressure = 0;
      double                    gap      = nan;
      double                    state    = -1;
      double                    wear     = 0;
      Tensor<1, 3>              traction, slip;
      std::vector<unsigned int> contacts; ///< that the node is in

      void
      add(const model::ContactRow &row)
      {
        const double p     = row.traction()[0];
        const bool   first = state < 0;
        contacts.push_back(row.contact);
        traction += row.in_space(row.traction());
        wear = std::max(wear, row.wear);
        gap  = std::fmin(gap, gap_of(row)); // a number where there is one
        if (first || p > pressure)
          {
            pressure = p;
            state    = row.state_number();
            slip     = slip_of(row);
          }
      }

      /** Of points of solids that nothing touches. */
      static ContactHere
      nothing()
      {
        ContactHere none;
        none.pressure = none.wear = nan;
        for (unsigned int d = 0; d < 3; ++d)
          none.traction[d] = none.slip[d] = nan;
        return none;
      }
    };

    using ContactOfNodes = std::map<unsigned int, ContactHere>;

    /** Some contact is at all of these nodes. */
    bool
    share_contact(const std::vector<unsigned int> &nodes,
                  const ContactOfNodes            &contact)
    {
      const auto first = contact.find(nodes.front());
      if (first == contact.end())
        return false;
      const auto is_at = [&](const unsigned int node, const unsigned int c) {
        const auto found = contact.find(node);
        return found != contact.end() &&
               std::count(found->second.contacts.begin(),
                          found->second.contacts.end(),
                          c) > 0;
      };
      return std::any_of(first->second.contacts.begin(),
                         first->second.contacts.end(),
                         [&](const unsigned int c) {
                           return std::all_of(nodes.begin(),
                                              nodes.end(),
                                              [&](const unsigned int node) {
                                                return is_at(node, c);
                                              });
                         });
    }

    ContactHere
    mean_of(const bodies::HangingNode &middle, const ContactOfNodes &contact)
    {
      ContactHere here;
      here.gap       = 0;
      double largest = -std::numeric_limits<double>::infinity();
      for (const auto &[node, weight] : middle.masters)
        {
          const ContactHere &corner = contact.at(node);
          here.pressure += weight * corner.pressure;
          here.gap += weight * corner.gap;
          here.wear += weight * corner.wear;
          here.traction += weight * corner.traction;
          here.slip += weight * corner.slip;
          if (corner.pressure > largest)
            {
              largest    = corner.pressure;
              here.state = corner.state;
            }
        }
      return here;
    }

    ContactOfNodes
    contact_on(const Skin                   &skin,
               const RunDescription         &run,
               const model::IncrementRecord &record,
               const unsigned int            body)
    {
      ContactOfNodes corners;
      for (const model::ContactRow &row : record.rows)
        if (run.contact_bodies.at(row.contact) == body && !row.couples)
          corners[row.node].add(row);
      for (const model::WornNode &worn : record.worn_masters)
        if (worn.body == body)
          {
            double &depth = corners[worn.node].wear;
            depth         = std::max(depth, worn.depth);
          }
      ContactOfNodes nodes = corners;
      for (const SkinMiddle &middle : skin.middles)
        if (share_contact(middle.corners, corners))
          nodes.emplace(middle.between.node, mean_of(middle.between, corners));
      return nodes;
    }

    void
    append(VtuField &field, const Tensor<1, 3> &v)
    {
      for (unsigned int d = 0; d < 3; ++d)
        field.values.push_back(v[d]);
    }

    /** Of points that are nodes, or nothing: `elsewhere`. */
    std::vector<ContactHere>
    contact_at(const std::vector<unsigned int> &nodes,
               const Skin                      &skin,
               const RunDescription            &run,
               const model::IncrementRecord    &record,
               const unsigned int               body,
               const ContactHere               &elsewhere)
    {
      const auto               contact = contact_on(skin, run, record, body);
      std::vector<ContactHere> points;
      points.reserve(nodes.size());
      for (const unsigned int node : nodes)
        {
          const auto found = contact.find(node);
          points.push_back(found == contact.end() ? elsewhere : found->second);
        }
      return points;
    }

    /** All but the state, which skins have as a field and solids as numbers. */
    std::vector<VtuField>
    fields_of(const std::vector<ContactHere> &points, const bool wears)
    {
      VtuField pressure{"contact_pressure", 1, {}};
      VtuField traction{"contact_traction", 3, {}};
      VtuField gap{"gap", 1, {}};
      VtuField slip{"slip", 3, {}};
      VtuField wear{"wear", 1, {}};
      for (const ContactHere &here : points)
        {
          pressure.values.push_back(here.pressure);
          append(traction, here.traction);
          gap.values.push_back(here.gap);
          append(slip, here.slip);
          wear.values.push_back(here.wear);
        }
      std::vector<VtuField> fields = {std::move(pressure),
                                      std::move(traction),
                                      std::move(gap),
                                      std::move(slip)};
      if (wears)
        fields.push_back(std::move(wear));
      return fields;
    }
    void
    add_middles(const bodies::Structure   &body,
                const bodies::SurfaceFace &face,
                Skin                      &skin)
    {
      const auto end = face.nodes.begin() + static_cast<std::ptrdiff_t>(
                                              bodies::n_corners(body, face));
      for (const bodies::HangingNode &middle : bodies::middle_nodes(body, face))
        skin.middles.push_back({middle, {face.nodes.begin(), end}});
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
          if (face.meets_at_corners)
            add_middles(body, face, skin);
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
  displacement_of(const RunDescription         &run,
                  const model::IncrementRecord &record,
                  const unsigned int            body,
                  const unsigned int            node)
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
  draw_skin(const Skin                   &skin,
            const RunDescription         &run,
            const model::IncrementRecord &record,
            const unsigned int            body)
  {
    AssertIndexRange(body, run.structures.size());
    AssertDimension(skin.nodes.size(), skin.grid.points.size());
    const auto points =
      contact_at(skin.nodes, skin, run, record, body, ContactHere());
    VtuField displacement{"displacement", 3, {}};
    for (const unsigned int node : skin.nodes)
      append(displacement, displacement_of(run, record, body, node));
    VtuField state{"state", 1, {}};
    for (const ContactHere &here : points)
      state.values.push_back(here.state);
    VtuGrid grid      = skin.grid;
    grid.point_fields = fields_of(points, !run.wearing.empty());
    grid.point_fields.insert(grid.point_fields.begin(),
                             std::move(displacement));
    grid.point_fields.push_back(std::move(state));
    grid.cell_ids.push_back(
      {"body", std::vector<int>(grid.n_cells(), static_cast<int>(body))});
    return grid;
  }



  void
  add_contact(const Skin                   &skin,
              const RunDescription         &run,
              const model::IncrementRecord &record,
              const unsigned int            body,
              VtuGrid                      &grid)
  {
    if (run.contacts.empty())
      return;
    std::vector<unsigned int> nodes = grid.nodes_of_points;
    nodes.resize(grid.points.size(), VtuGrid::no_node);
    const auto points =
      contact_at(nodes, skin, run, record, body, ContactHere::nothing());
    for (VtuField &field : fields_of(points, !run.wearing.empty()))
      grid.point_fields.push_back(std::move(field));
    VtuIds state{"state", {}};
    for (const ContactHere &here : points)
      state.values.push_back(static_cast<int>(here.state));
    grid.point_ids.push_back(std::move(state));
  }



  VtuGrid
  draw_contact_nodes(const RunDescription         &run,
                     const model::IncrementRecord &record)
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
    for (const model::ContactRow &row : record.rows)
      {
        const Tensor<1, 3> reaction = row.in_space(row.reaction);
        const unsigned int body     = run.contact_bodies.at(row.contact);
        std::size_t        field    = 0;
        for (const Tensor<1, 3> &vector :
             {reaction,
              row.in_space(row.traction()),
              slip_of(row),
              row.in_space(row.u),
              row.normal,
              displacement_of(run, record, body, row.node)})
          append(grid.point_fields[field++], vector);
        for (const double scalar : {gap_of(row),
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
