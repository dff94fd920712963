// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/graphics.h"

#include "conetact/bodies/frame/diagrams.h"

namespace conetact::bodies
{
  namespace
  {
    /** A scalar field besides the displacement. */
    struct Field
    {
      const char *name;
      double (*value)(const MemberSection &cut, const FrameSection &section);
    };

    std::vector<Field>
    fields_in(const unsigned int dim)
    {
      using Cut                 = const MemberSection &;
      using Of                  = const FrameSection &;
      std::vector<Field> fields = {
        {"axial_force", [](Cut c, Of) { return c.force[0]; }},
        {"axial_stress", [](Cut c, Of s) { return c.force[0] / s.area; }}};
      if (dim == 2)
        {
          fields.push_back(
            {"shear_force", [](Cut c, Of) { return c.force[1]; }});
          fields.push_back({"moment", [](Cut c, Of) { return c.moment[2]; }});
          return fields;
        }
      fields.push_back({"shear_force_y", [](Cut c, Of) { return c.force[1]; }});
      fields.push_back({"shear_force_z", [](Cut c, Of) { return c.force[2]; }});
      fields.push_back({"torque", [](Cut c, Of) { return c.moment[0]; }});
      fields.push_back({"moment_y", [](Cut c, Of) { return c.moment[1]; }});
      fields.push_back({"moment_z", [](Cut c, Of) { return c.moment[2]; }});
      return fields;
    }

    /** Cuts through a member as points with lines between them. */
    void
    add_member(const Member                     &member,
               const std::vector<MemberSection> &cuts,
               const std::vector<Field>         &fields,
               VtuGrid                          &grid)
    {
      const auto first = static_cast<unsigned int>(grid.points.size());
      const auto n     = static_cast<unsigned int>(cuts.size());
      for (unsigned int i = 0; i < n; ++i)
        {
          grid.points.push_back(member.point(double(i) / (n - 1)));
          grid.nodes_of_points.push_back(i == 0     ? member.nodes()[0] :
                                         i == n - 1 ? member.nodes()[1] :
                                                      VtuGrid::no_node);
          for (unsigned int c = 0; c < 3; ++c)
            grid.point_fields[0].values.push_back(cuts[i].displacement[c]);
          for (std::size_t k = 0; k < fields.size(); ++k)
            grid.point_fields[1 + k].values.push_back(
              fields[k].value(cuts[i], member.section()));
          if (i > 0)
            grid.add_cell(VtuGrid::Shape::line, {first + i - 1, first + i});
        }
    }
  } // namespace

  VtuGrid
  draw_frame(const FrameModel                &model,
             const std::vector<Member>       &members,
             const std::vector<MemberMotion> &motions,
             const std::vector<MemberLoad>   &loads)
  {
    const std::vector<Field> fields = fields_in(model.dim);
    VtuGrid                  grid;
    grid.point_fields.push_back({"displacement", 3, {}});
    for (const Field &field : fields)
      grid.point_fields.push_back({field.name, 1, {}});
    VtuIds sections{"material_id", {}};
    for (std::size_t m = 0; m < members.size(); ++m)
      {
        add_member(members[m],
                   member_sections(members[m],
                                   motions[m].displacement,
                                   motions[m].deformation,
                                   loads[m],
                                   members[m].bends() ? 8 : 1),
                   fields,
                   grid);
        sections.values.resize(grid.n_cells(),
                               static_cast<int>(model.members[m].section));
      }
    grid.cell_ids = {std::move(sections)};
    return grid;
  }
} // namespace conetact::bodies
