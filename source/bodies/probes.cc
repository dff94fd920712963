// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/probes.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"

#include <regex>
#include <set>

namespace conetact::bodies
{
  namespace
  {
    constexpr const char *example =
      " Write for example 'tip: 1, 0 ; middle: 0.5, 0' (with three "
      "coordinates in space).";

    /** False if no cell holds it. */
    bool
    find_shapes(Probe             &probe,
                const unsigned int dim,
                const Structure   &structure)
    {
      probe.shapes.clear();
      for (unsigned int c = 0; c < dim; ++c)
        if (auto shapes = shapes_at(structure, probe.point, c))
          probe.shapes.push_back(std::move(*shapes));
        else
          return false;
      return true;
    }

    /** In 2D a third coordinate of 0 is no mistake. */
    Point<3>
    parse_point(const std::string &text,
                const unsigned int dim,
                const std::string &entry)
    {
      const auto numbers = to_numbers(text, entry);
      if (dim == 2 && numbers.size() == 3 && numbers[2] == 0)
        return Point<3>(numbers[0], numbers[1], 0);
      return Point<3>(to_vector(text, dim, entry));
    }

    /** Those that hold the point, of all or of the one that is named. */
    std::vector<Probe>
    candidates(const Probe                          &probe,
               const unsigned int                    dim,
               const std::vector<unsigned int>      &in,
               const std::vector<const Structure *> &bodies)
    {
      std::vector<Probe> found;
      for (const unsigned int body : in)
        {
          Probe candidate = probe;
          candidate.body  = body;
          if (find_shapes(candidate, dim, *bodies[body]))
            found.push_back(std::move(candidate));
        }
      return found;
    }

    Probe
    parse_probe(const std::string                    &text,
                const unsigned int                    dim,
                const std::vector<std::string>       &names,
                const std::vector<const Structure *> &bodies,
                const std::string                    &entry)
    {
      static const std::regex form("([^:]*?)(?:\\s+in\\s+([^:]*))?:(.*)");
      constexpr std::size_t   most_letters = 1000; // more is no point
      std::smatch             parts;
      if (text.size() > most_letters || !std::regex_match(text, parts, form) ||
          trim(parts[1]).empty())
        throw InputError(entry + ": '" + text +
                         "' is not a name, a colon and "
                         "a point." +
                         example);
      Probe probe;
      probe.name = trim(parts[1]);
      if (!std::regex_match(probe.name, std::regex("[A-Za-z0-9_.-]+")))
        throw InputError(entry + ": the name '" + probe.name +
                         "' becomes part of columns. Use letters, digits, '_', "
                         "'-' and '.' only.");
      const std::string here = entry + ", " + probe.name;
      probe.point            = parse_point(trim(parts[3]), dim, here);
      std::vector<unsigned int> in;
      if (const std::string body = trim(parts[2]); !body.empty())
        in.push_back(find_body(body, names, here));
      else
        for (unsigned int b = 0; b < bodies.size(); ++b)
          in.push_back(b);
      std::vector<Probe> found = candidates(probe, dim, in, bodies);
      if (found.empty())
        throw InputError(here + ": no body holds the point " +
                         to_text(probe.point) +
                         ". Give an undeformed point inside of a body or on "
                         "its surface.");
      if (found.size() > 1)
        throw InputError(here + ": the bodies '" + names[found[0].body] +
                         "' and '" + names[found[1].body] +
                         "' both hold the point. Say which one is meant: '" +
                         probe.name + " in " + names[found[0].body] + ": " +
                         trim(parts[3]) + "'.");
      return found[0];
    }
  } // namespace



  std::optional<std::vector<std::pair<Eigen::Index, double>>>
  shapes_at(const Structure   &structure,
            const Point<3>    &point,
            const unsigned int component)
  {
    Tensor<1, 3> unit;
    unit[component]   = 1;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(structure.n_dofs());
    if (!structure.add(Action::point_force(point, unit), f))
      return {};
    std::vector<std::pair<Eigen::Index, double>> shapes;
    for (Eigen::Index i = 0; i < f.size(); ++i)
      if (f[i] != 0)
        shapes.emplace_back(i, f[i]);
    return shapes;
  }



  std::vector<Probe>
  parse_probes(const std::string                    &text,
               const unsigned int                    dim,
               const std::vector<std::string>       &names,
               const std::vector<const Structure *> &bodies,
               const std::string                    &entry)
  {
    std::vector<Probe>    probes;
    std::set<std::string> seen;
    for (const std::string &part : split(text, ';'))
      {
        if (part.empty())
          continue; // one behind the last
        probes.push_back(parse_probe(part, dim, names, bodies, entry));
        if (!seen.insert(probes.back().name).second)
          throw InputError(entry + ": '" + probes.back().name +
                           "' stands there twice. Give each point its own "
                           "name.");
      }
    return probes;
  }
} // namespace conetact::bodies
