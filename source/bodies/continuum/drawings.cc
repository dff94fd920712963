// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/drawings.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <cmath>

namespace conetact::bodies
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    double
    to_size(const std::string &text, const std::string &entry)
    {
      const double size = to_number(text, entry);
      if (!(size > 0 && std::isfinite(size)))
        throw InputError(entry + ": '" + text +
                         "' is not positive. Give the length of a cell.");
      return size;
    }

    /** "floor : 0.5 ; 7 : 1" or "r = 3 ; n = 4". */
    std::vector<std::pair<std::string, std::string>>
    pairs(const std::string &text,
          const char         separator,
          const std::string &entry,
          const std::string &example)
    {
      std::vector<std::pair<std::string, std::string>> result;
      for (const std::string &part : split(text, ';'))
        {
          const std::vector<std::string> fields = split(part, separator);
          if (fields.size() != 2 || fields[0].empty() || fields[1].empty())
            throw InputError(entry + ": '" + part +
                             "' is not a name and its number. Write them as "
                             "in '" +
                             example + "'.");
          result.emplace_back(fields[0], fields[1]);
        }
      return result;
    }
  } // namespace

  void
  declare_drawing(dealii::ParameterHandler &prm)
  {
    prm.declare_entry(
      "Size",
      "",
      Patterns::Anything(),
      "Length of cells that a drawing (File = .step, .geo, ...) is meshed "
      "with, at most. Empty: a .geo file has its own sizes; cells of other "
      "drawings are a twentieth of the diagonal of the body's box, and round "
      "faces have 12 cells a circle at least. In the units of the file, before "
      "Scale. [length]");
    prm.declare_entry(
      "Size near",
      "",
      Patterns::Anything(),
      "Smaller cells of a drawing on some of its surfaces, volumes or curves: "
      "names or numbers of its groups and lengths, 'floor : 0.5 ; 7 : 1'. "
      "Away from there cells grow. [length]");
    prm.declare_entry(
      "Order",
      "1",
      Patterns::Selection("1|2"),
      "Order of the cells that a drawing is meshed with. Of order 2 they have "
      "nodes in the middles of their edges, which lie on curved faces. [-]");
    prm.declare_entry(
      "Parameters",
      "",
      Patterns::Anything(),
      "Values for constants of a .geo file, 'r = 3 ; n = 4'. The file names "
      "them, with other values, in DefineConstant[ r = 2 ]; [-]");
  }

  GmshWishes
  parse_drawing(dealii::ParameterHandler &prm, const std::string &where)
  {
    GmshWishes wishes;
    if (const std::string size = trim(prm.get("Size")); !size.empty())
      wishes.size = to_size(size, where + "Size");
    const std::string near = where + "Size near";
    for (const auto &[name, size] :
         pairs(trim(prm.get("Size near")), ':', near, "floor : 0.5 ; 7 : 1"))
      wishes.near.emplace_back(name, to_size(size, near));
    wishes.order            = prm.get("Order") == "2" ? 2 : 1;
    const std::string entry = where + "Parameters";
    for (const auto &[name, value] :
         pairs(trim(prm.get("Parameters")), '=', entry, "r = 3 ; n = 4"))
      wishes.constants.emplace_back(name, to_number(value, entry));
    return wishes;
  }

  std::string
  first_entry_of(const GmshWishes &wishes)
  {
    if (wishes.size)
      return "Size";
    if (!wishes.near.empty())
      return "Size near";
    if (wishes.order > 1)
      return "Order";
    return wishes.constants.empty() ? "" : "Parameters";
  }
} // namespace conetact::bodies
