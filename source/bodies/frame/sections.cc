// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/sections.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

namespace conetact::bodies
{
  using dealii::ParameterHandler;

  namespace
  {
    void
    declare_section(ParameterHandler &prm)
    {
      const auto declare =
        [&](const char *entry, const char *value, const char *text) {
          prm.declare_entry(entry, value, dealii::Patterns::Anything(), text);
        };
      declare("Young modulus",
              "",
              "Young's modulus E, above 0; must be given. [force/length^2]");
      declare("Area",
              "",
              "Area A of the cross section, above 0; must be given. "
              "[length^2]");
      declare("Moment of inertia",
              "",
              "Empty: a bar, which carries axial force only. Else a beam "
              "(Euler-Bernoulli): I in 2D; 'I_y, I_z' in 3D about the local "
              "axes y and z, one number for both. [length^4]");
      declare("Torsion constant",
              "",
              "3D beams: J, above 0. Empty: I_y + I_z, a round section's. "
              "[length^4]");
      declare("Shear modulus",
              "",
              "3D beams: G of torsion, above 0. Empty: E/2.6, a Poisson's "
              "ratio of 0.3. [force/length^2]");
      declare("Orientation",
              "",
              "3D: a vector v that tells the local axes, x along the member, "
              "y = v x x, z = x x y: where v is upright, z points up. Empty: "
              "(0, 0, 1), and (1, 0, 0) for members along z. [-]");
      declare("Width",
              "1",
              "Width of the surface that members offer to tractions, "
              "pressures, foundations and contacts, above 0: the area of a "
              "node is its share of the members' lengths times this. "
              "[length]");
      declare("Expansion coefficient",
              "0",
              "Thermal expansion alpha: strain of a change of temperature by "
              "1 K where nothing resists. [1/K]");
    }

    double
    positive(const std::string &text, const std::string &entry)
    {
      const double value = to_number(text, entry);
      if (!(value > 0))
        throw InputError(entry + ": " + to_text(value) +
                         " is not positive. Give a number above 0.");
      return value;
    }

    void
    parse_beam(ParameterHandler   &prm,
               const unsigned int  dim,
               const std::string  &where,
               FrameSection       &section,
               std::vector<double> inertia)
    {
      const std::string entry = where + "Moment of inertia";
      if (inertia.size() > dim - 1)
        throw InputError(entry + ": " + std::to_string(inertia.size()) +
                         " numbers are given. Give " +
                         (dim == 2 ? "one." : "I_y, I_z."));
      for (const double i : inertia)
        positive(to_text(i), entry);
      section.inertia_z = inertia.back();
      if (dim == 2)
        return;
      section.inertia_y   = inertia.front();
      const std::string j = prm.get("Torsion constant");
      const std::string g = prm.get("Shear modulus");
      section.torsion     = (j.empty() ? section.inertia_y + section.inertia_z :
                                         positive(j, where + "Torsion constant")) *
                        (g.empty() ? section.young_modulus / 2.6 :
                                     positive(g, where + "Shear modulus"));
    }

    FrameSection
    parse_section(ParameterHandler  &prm,
                  const unsigned int dim,
                  const std::string &name,
                  const std::string &where)
    {
      FrameSection section;
      section.name = name;
      section.young_modulus =
        positive(prm.get("Young modulus"), where + "Young modulus");
      section.area      = positive(prm.get("Area"), where + "Area");
      section.width     = positive(prm.get("Width"), where + "Width");
      section.expansion = to_number(prm.get("Expansion coefficient"),
                                    where + "Expansion coefficient");
      const auto inertia =
        to_numbers(prm.get("Moment of inertia"), where + "Moment of inertia");
      if (!inertia.empty())
        parse_beam(prm, dim, where, section, inertia);
      if (const std::string v = prm.get("Orientation"); !v.empty())
        {
          section.orientation = to_vector(v, dim, where + "Orientation");
          if (dim == 2)
            throw InputError(where + "Orientation: it has no meaning in 2D. " +
                             "Remove it.");
          if (section.orientation.norm() == 0)
            throw InputError(where + "Orientation: the vector has no length.");
        }
      return section;
    }
  } // namespace

  void
  declare_sections(ParameterHandler &prm)
  {
    prm.declare_entry("Sections",
                      "",
                      dealii::Patterns::Anything(),
                      "frame: names of cross sections, separated by commas; "
                      "each has its own subsection 'Section NAME' after this "
                      "list. [-]");
    // names are known only when the list is read
    prm.add_action("Sections", [&prm](const std::string &names) {
      for (const std::string &name : split(names, ','))
        if (!name.empty())
          {
            prm.enter_subsection("Section " + name);
            declare_section(prm);
            prm.leave_subsection();
          }
    });
  }

  std::vector<FrameSection>
  parse_sections(ParameterHandler  &prm,
                 const unsigned int dim,
                 const std::string &body)
  {
    std::vector<FrameSection> sections;
    for (const std::string &name : split(prm.get("Sections"), ','))
      {
        for (const FrameSection &other : sections)
          if (other.name == name)
            throw InputError(body + ", Sections: '" + name +
                             "' stands there twice.");
        if (name.empty())
          throw InputError(body + ", Sections: a name is missing between two " +
                           "commas.");
        prm.enter_subsection("Section " + name);
        sections.push_back(
          parse_section(prm, dim, name, body + ", Section '" + name + "', "));
        prm.leave_subsection();
      }
    if (sections.empty())
      throw InputError(body + ", Sections: there is none. Add for example " +
                       "'set Sections = pipe' and 'subsection Section pipe'.");
    return sections;
  }
} // namespace conetact::bodies
