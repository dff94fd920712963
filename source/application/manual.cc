// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/manual.h"

#include "conetact/application/entry_list.h"
#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <sstream>

namespace conetact::application
{
  namespace
  {
    constexpr const char *introduction =
      R"(# All entries of a scene

A scene is a text file. Lists of names come first, such as `set Bodies = block`,
then one subsection for each name, `subsection Body block` ... `end`. An entry is
`set Entry = value`; entries that are not set have their defaults. `#` begins a
comment. A backslash at the end of a line continues it in the next one.
`include FILE` reads another file, relative to the folder of the file that
includes it. Entries behind that line replace those that it sets, and a list there
drops the loads, contacts and others that it does not name any more. Expressions
are functions of x, y, z and t, such as `-0.1*min(t, 1)`. Components are separated
by `;`, numbers by `,`. Choose any consistent units. The option
`-s "Section/Entry=value"` replaces an
entry. NAME stands for names of your own.

)";

    constexpr const char *starter =
      R"(# A block on a floor: pressed down, then pushed sideways until it slips.
# Run it:          conetact THIS-FILE.prm
# All entries:     conetact --parameters
# Check it only:   conetact THIS-FILE.prm --dry-run
# Units: N, mm, MPa. Any consistent ones will do: write yours here.

set Dimension = 2           # or 3
set Bodies    = block       # names of your own, each with its subsection below
set Obstacles = floor       # rigid; bodies may touch each other, too
set Contacts  = bottom
set Supports  = top
set Loads     =             # for example: push

subsection Body block
  subsection Mesh           # a mesh of deal.II, or: set File = part.msh
    set Generator = subdivided_hyper_rectangle
    set Arguments = 20, 10 : 0, 0 : 40, 20 : true    # cells : corner : corner
  end                       # its boundary ids: 0 left, 1 right, 2 bottom, 3 top
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Plane         = strain     # 2D only; or stress
  end
end

subsection Obstacle floor
  set Shape  = half space
  set Normal = 0, 1         # out of the obstacle, towards the body
end

subsection Contact bottom
  set Body                 = block
  set Boundary ids         = 2
  set Obstacle             = floor
  set Friction coefficient = 0.3
end

subsection Support top      # down until t = 1, then sideways until t = 2
  set Body         = block
  set Boundary ids = 3
  set Directions   = x, y
  set Displacement = 0.3 * max(t - 1, 0) ; -0.1 * min(t, 1)
end

subsection Time
  set End        = 2
  set Increments = 20
end

subsection Output
  set VTU    = 1                       # ParaView: scene.pvd shows everything
  set Probes = edge: 40, 20 ; middle: 20, 10
end
)";

    /** Without the marks of a comment. */
    std::string
    comment(const std::string &line)
    {
      return trim(line.substr(line.find_first_not_of('#')));
    }

    std::string
    entry(const std::string &line, const std::string &text)
    {
      const auto        equals = line.find('=');
      const std::string name   = trim(line.substr(4, equals - 4));
      const std::string value  = trim(line.substr(equals + 1));
      return "* **" + name + "**" +
             (value.empty() ? std::string() : " = `" + value + "`") +
             (text.empty() ? "" : ": " + text) + "\n";
    }

    /** deal.II's own form: comments above entries, nested subsections. */
    std::string
    to_markdown(const std::string &text)
    {
      std::string              page, about;
      std::vector<std::string> path;
      std::istringstream       stream(text);
      for (std::string raw; std::getline(stream, raw);)
        {
          const std::string line = trim(raw);
          if (line.rfind("# ---", 0) == 0)
            about.clear(); // of the head of the listing
          else if (line.rfind("# ", 0) == 0)
            about += (about.empty() ? "" : " ") + comment(line);
          else if (line.rfind("set ", 0) == 0)
            page += entry(line, about);
          else if (line.rfind("subsection ", 0) == 0)
            {
              path.push_back(line.substr(11));
              page += "\n## " + join(path, "/") + "\n\n";
            }
          else if (line == "end" && !path.empty())
            path.pop_back();
          if (line.rfind('#', 0) != 0)
            about.clear();
        }
      return page;
    }
  } // namespace



  std::string
  manual()
  {
    dealii::ParameterHandler prm;
    declare_any_scene(prm);
    std::ostringstream stream;
    prm.print_parameters(stream,
                         dealii::ParameterHandler::Text |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    return introduction + to_markdown(stream.str());
  }



  std::string
  starter_scene()
  {
    return starter;
  }



  std::string
  write_starter_scene(const std::string &name)
  {
    std::filesystem::path file = name;
    if (file.filename().empty() || name.front() == '-')
      throw InputError("Option --new: '" + name + "' is no name of a scene.");
    if (file.extension() != ".prm")
      file += ".prm";
    std::error_code too_long; // writing tells
    if (std::filesystem::exists(file, too_long))
      throw InputError("Option --new: " + file.string() +
                       " exists already. Choose another name.");
    write_atomically(file, starter_scene());
    return "Wrote " + file.string() + ". Edit it, then run: conetact " +
           file.string() + "\n";
  }
} // namespace conetact::application
