// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/graphics.h"

#include "conetact/base/atomic_file.h"
#include "conetact/bodies/frame/diagrams.h"

#include <deal.II/base/data_out_base.h>

#include <sstream>

namespace conetact::bodies
{
  namespace
  {
    using DataRanges = std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>;

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

    /** Members in the form that deal.II's writers take. */
    class LineOutput : public dealii::DataOutInterface<1, 3>
    {
    public:
      explicit LineOutput(const unsigned int dim)
        : fields(fields_in(dim))
      {}

      void
      add(const Member &member, const std::vector<MemberSection> &cuts)
      {
        Patch patch;
        patch.patch_index    = static_cast<unsigned int>(patches.size());
        patch.reference_cell = dealii::ReferenceCells::Line;
        patch.vertices[0]    = member.point(0);
        patch.vertices[1]    = member.point(1);
        patch.n_subdivisions = static_cast<unsigned int>(cuts.size()) - 1;
        patch.data.reinit(3 + static_cast<unsigned int>(fields.size()),
                          static_cast<unsigned int>(cuts.size()));
        for (unsigned int i = 0; i < cuts.size(); ++i)
          {
            for (unsigned int c = 0; c < 3; ++c)
              patch.data(c, i) = static_cast<float>(cuts[i].displacement[c]);
            for (unsigned int k = 0; k < fields.size(); ++k)
              patch.data(3 + k, i) =
                static_cast<float>(fields[k].value(cuts[i], member.section()));
          }
        patches.push_back(patch);
      }

    private:
      using Patch = dealii::DataOutBase::Patch<1, 3>;
      std::vector<Patch>       patches;
      const std::vector<Field> fields;

      const std::vector<Patch> &
      get_patches() const override
      {
        return patches;
      }
      std::vector<std::string>
      get_dataset_names() const override
      {
        std::vector<std::string> names(3, "displacement");
        for (const Field &field : fields)
          names.emplace_back(field.name);
        return names;
      }
      DataRanges
      get_nonscalar_data_ranges() const override
      {
        using namespace dealii::DataComponentInterpretation;
        return {{0, 2, "displacement", component_is_part_of_vector}};
      }
    };
  } // namespace

  void
  write_frame(const std::vector<Member>       &members,
              const std::vector<MemberMotion> &motions,
              const std::vector<MemberLoad>   &loads,
              const unsigned int               dim,
              const double                     time,
              const std::filesystem::path     &file)
  {
    LineOutput output(dim);
    for (std::size_t m = 0; m < members.size(); ++m)
      output.add(members[m],
                 member_sections(members[m],
                                 motions[m].displacement,
                                 motions[m].deformation,
                                 loads[m],
                                 members[m].bends() ? 8 : 1));
    dealii::DataOutBase::VtkFlags flags(time, 0, false);
    flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
    output.set_flags(flags);
    std::ostringstream text;
    output.write_vtu(text);
    write_atomically(file, text.str());
  }
} // namespace conetact::bodies
