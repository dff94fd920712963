// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/automatic_contacts.h"

#include "conetact/application/scene_text.h"
#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/groups.h"

#include <algorithm>
#include <sstream>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    const std::string own_section = "Automatic contact";

    /** Entries that contacts do not have. */
    constexpr const char *largest_gap = "Largest gap";
    constexpr const char *exceptions  = "Exceptions";

    /** What stands in the section. */
    void
    declare_own_entries(Handler &prm)
    {
      using namespace dealii::Patterns;
      prm.declare_entry(
        largest_gap,
        "",
        Anything(),
        "'Contacts = automatic' makes a contact of all bodies, and of a body "
        "and an obstacle, whose faces oppose each other with a gap of at most "
        "this, with the boundary ids of these faces. The finer side is the "
        "slave. Empty: a quarter of the mean edge of the finer side. [length]");
      prm.declare_entry(
        exceptions,
        "",
        Anything(),
        "Pairs that are no contact: 'pin : lug ; spring' leaves out the pair "
        "of pin and lug, and all of spring. A pair that has a contact of its "
        "own in Contacts is left out as well.");
      pairing::declare_contact_law(prm);
    }

    Entries
    all_entries(const Handler &prm)
    {
      std::ostringstream text;
      prm.print_parameters(text, Handler::ShortText);
      return entries_of(text.str());
    }

    /** Of entries that were declared by `declare`. */
    Entries
    defaults(void (*const declare)(Handler &))
    {
      Handler plain;
      declare(plain);
      return all_entries(plain);
    }

    /** What the section of a scene says. */
    std::string
    value_in(const Handler &prm, const std::string &entry)
    {
      return prm.get({own_section}, entry);
    }

    /** Of a contact whose other side is an obstacle: what tells of master
     * bodies is left out. */
    bool
    is_of_masters(const std::string &entry, const std::string &value)
    {
      return entry == "Reach" || entry == "Pairing" ||
             (entry == "Gap" && value != "adjust");
    }

    std::vector<std::string>
    names_of(const std::vector<pairing::Obstacle> &obstacles)
    {
      std::vector<std::string> names;
      for (const pairing::Obstacle &obstacle : obstacles)
        names.push_back(obstacle.name);
      return names;
    }

    /** "pin : lug ; spring" */
    std::vector<SideNames>
    read_exceptions(const std::string              &text,
                    const std::vector<std::string> &known)
    {
      const std::string      in = in_automatic + exceptions + ": ";
      std::vector<SideNames> found;
      if (text.empty())
        return found;
      for (const std::string &pair : split(text, ';'))
        {
          const std::vector<std::string> names = split(pair, ':');
          for (const std::string &name : names)
            if (std::find(known.begin(), known.end(), name) == known.end())
              throw InputError(in + "there is no body or obstacle '" + name +
                               "'. Give two of " + join(known) +
                               " with a colon between them, or one that "
                               "meets nothing, and ';' before the next.");
          if (names.size() == 2 && names.front() == names.back())
            throw InputError(in + '\'' + pair +
                             "' names one side twice. Give two, or one name "
                             "alone for what meets nothing.");
          if (names.size() > 2)
            throw InputError(in + '\'' + pair +
                             "' names more than two sides. Separate pairs "
                             "by ';'.");
          found.emplace_back(names.begin(), names.end());
        }
      return found;
    }

    /** Whether two sides are among the pairs, or one of them alone is. */
    bool
    stands_in(const std::vector<SideNames> &pairs,
              const std::string            &one,
              const std::string            &other)
    {
      return std::any_of(pairs.begin(), pairs.end(), [&](const auto &pair) {
        return pair == SideNames{one, other} || pair == SideNames{one} ||
               pair == SideNames{other};
      });
    }
  } // namespace



  void
  declare_automatic_contact(Handler &prm)
  {
    prm.enter_subsection(own_section);
    declare_own_entries(prm);
    prm.leave_subsection();
  }



  void
  refuse_idle_automatic_contact(const Handler &prm)
  {
    for (const auto &[entry, value] : defaults(declare_own_entries))
      if (value_in(prm, entry) != value)
        throw InputError(in_automatic + entry +
                         ": no contact is found by itself. Add 'automatic' to "
                         "the names in Contacts, or remove the entry.");
  }



  std::vector<SideNames>
  named_sides(Handler &prm, const std::vector<std::string> &contacts)
  {
    std::vector<SideNames> named;
    for (const std::string &contact : contacts)
      {
        prm.enter_subsection("Contact " + contact);
        const std::string master = prm.get("Master body");
        if (prm.get("Body") != master)
          named.push_back(
            {prm.get("Body"), master.empty() ? prm.get("Obstacle") : master});
        prm.leave_subsection();
      }
    return named;
  }



  pairing::NearPairs
  find_near_sides(Handler                                      &prm,
                  const std::vector<std::string>               &bodies,
                  const std::vector<const bodies::Structure *> &structures,
                  const std::vector<pairing::Obstacle>         &obstacles,
                  const std::vector<SideNames>                 &named)
  {
    prm.enter_subsection(own_section);
    const pairing::Contact law = pairing::read_contact_law(prm, in_automatic);
    std::optional<double>  gap;
    if (const std::string text = prm.get(largest_gap); !text.empty())
      gap = to_number(text, in_automatic + largest_gap);
    std::vector<std::string> known = bodies;
    for (const std::string &name : names_of(obstacles))
      known.push_back(name);
    std::vector<SideNames> others = read_exceptions(prm.get(exceptions), known);
    prm.leave_subsection();
    if (gap && *gap < 0)
      throw InputError(in_automatic + largest_gap + ": " + to_text(*gap) +
                       " is negative. Give a length of 0 or more.");
    others.insert(others.end(), named.begin(), named.end());

    const pairing::NearSearch search(structures, obstacles, law, gap);
    pairing::NearPairs        found;
    const auto                keep = [&](auto &&sides) {
      if (sides)
        found.sides.push_back(std::move(*sides));
      return sides.has_value();
    };
    const auto n = static_cast<unsigned int>(bodies.size());
    for (unsigned int one = 0; one < n; ++one)
      for (unsigned int other = one + 1; other < n; ++other)
        if (!stands_in(others, bodies[one], bodies[other]) &&
            !keep(search.between(one, other)))
          found.apart.emplace_back(one, other);
    for (unsigned int body = 0; body < n; ++body)
      for (unsigned int o = 0; o < obstacles.size(); ++o)
        if (!stands_in(others, bodies[body], obstacles[o].name))
          keep(search.on_obstacle(body, o));
    return found;
  }



  namespace
  {
    WrittenContact
    write_contact(const Entries                                &law,
                  const pairing::NearSides                     &sides,
                  const std::vector<std::string>               &names,
                  const std::vector<const bodies::Structure *> &structures,
                  const std::vector<pairing::Obstacle>         &obstacles)
    {
      const std::string &other =
        sides.obstacle ? obstacles[*sides.obstacle].name : names[sides.master];
      WrittenContact contact{names[sides.body] + ' ' + other,
                             std::make_unique<Handler>()};
      Handler       &entries = *contact.entries;
      pairing::declare_contact(entries);
      entries.set("Body", names[sides.body]);
      entries.set("Boundary ids",
                  bodies::join_names(
                    sides.ids, structures[sides.body]->boundary_groups()));
      entries.set(sides.obstacle ? "Obstacle" : "Master body", other);
      if (!sides.obstacle)
        entries.set(
          "Master boundary ids",
          bodies::join_names(sides.master_ids,
                             structures[sides.master]->boundary_groups()));
      for (const auto &[entry, value] : law)
        if (entry != largest_gap && entry != exceptions &&
            !(sides.obstacle && is_of_masters(entry, value)))
          entries.set(entry, value);
      return contact;
    }
  } // namespace



  std::vector<WrittenContact>
  write_contacts(const Handler                                &prm,
                 const pairing::NearPairs                     &pairs,
                 const std::vector<std::string>               &names,
                 const std::vector<const bodies::Structure *> &structures,
                 const std::vector<pairing::Obstacle>         &obstacles)
  {
    Entries law = defaults(declare_own_entries);
    for (auto &[entry, value] : law)
      value = value_in(prm, entry);
    std::vector<WrittenContact> contacts;
    for (const pairing::NearSides &sides : pairs.sides)
      contacts.push_back(
        write_contact(law, sides, names, structures, obstacles));
    return contacts;
  }



  std::string
  WrittenContact::text() const
  {
    const Entries by_itself = defaults(pairing::declare_contact);
    std::string   text      = "subsection Contact " + name + '\n';
    for (const auto &[entry, value] : all_entries(*entries))
      if (value != by_itself.at(entry))
        text += "  set " + entry + " = " + value + '\n';
    return text + "end\n";
  }
} // namespace conetact::application
