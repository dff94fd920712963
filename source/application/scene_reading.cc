// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/automatic_contacts.h"
#include "conetact/application/scene_entries.h"
#include "conetact/application/scene_text.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    std::vector<std::string>
    get_names(Handler &prm, const std::string &list)
    {
      std::vector<std::string> names = split(prm.get(list), ',');
      std::set<std::string>    seen;
      for (const std::string &name : names)
        if (name.empty())
          throw InputError(list + ": a name is missing beside a comma. "
                                  "Remove the comma, or add the name.");
        else if (!seen.insert(name).second)
          throw InputError(list + ": '" + name +
                           "' stands there twice. Give each one its own name.");
      return names;
    }
  } // namespace

  SceneEntries::SceneEntries(const CommandLine &line)
    : file(line.scene)
    , overrides(line.overrides)
    , text(read_scene_file(line.scene))
  {
    refuse_repeats(text);
    left_out = leave_out_unlisted(text, overrides);
    read_names();
    declare_scene(prm, names);
    parse_all(prm, false);
    if (!finds_contacts)
      refuse_idle_automatic_contact(prm);
    if (names.bodies.empty())
      throw InputError("Bodies: the scene names no body. Add for example "
                       "'set Bodies = block' and 'subsection Body block'.");
    replace_times();
  }

  void
  SceneEntries::parse_all(Handler &handler, const bool skip_undefined) const
  {
    parse_scene_text(handler, text, skip_undefined);
    for (const std::string &override : overrides)
      parse_override(handler, override, skip_undefined);
  }

  void
  SceneEntries::read_names()
  {
    Handler lists;
    declare_lists(lists);
    parse_all(lists, true);
    dim             = static_cast<unsigned int>(lists.get_integer("Dimension"));
    names.bodies    = get_names(lists, "Bodies");
    names.obstacles = get_names(lists, "Obstacles");
    names.contacts  = get_names(lists, "Contacts");
    const auto at   = std::find(names.contacts.begin(),
                              names.contacts.end(),
                              automatic_contacts);
    finds_contacts  = at != names.contacts.end();
    if (finds_contacts)
      names.contacts.erase(at);
    names.supports = get_names(lists, "Supports");
    names.loads    = get_names(lists, "Loads");
  }

  /* Times of the command line stand in place of those of the file, and these
     in place of those that it includes. */
  void
  SceneEntries::replace_times()
  {
    prm.enter_subsection("Time");
    constexpr int nowhere = std::numeric_limits<int>::max();
    const auto    depth   = [this](const std::string &entry) {
      const std::string key = "Time/" + entry;
      if (std::any_of(overrides.begin(),
                      overrides.end(),
                      [&key](const std::string &override) {
                        return sets(override, key);
                      }))
        return -1;
      const auto line = place_of(text, key);
      return line ? static_cast<int>(text.origins[*line].depth) : nowhere;
    };
    for (const char *list : {"Times", "Stages"})
      for (const char *entry : {"End", "Increments"})
        if (!prm.get(list).empty() && depth(list) < depth(entry))
          prm.set(entry, "1");
    prm.leave_subsection();
  }

  std::string
  SceneEntries::documentation() const
  {
    std::ostringstream stream;
    prm.print_parameters(stream, Handler::Text);
    return stream.str();
  }

  std::string
  SceneEntries::values() const
  {
    std::ostringstream stream;
    prm.print_parameters(stream, Handler::ShortText);
    return stream.str();
  }

  std::string
  SceneEntries::name() const
  {
    return file.stem().string();
  }

  std::filesystem::path
  SceneEntries::folder() const
  {
    return file.parent_path();
  }
} // namespace conetact::application
