// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/groups.h"

#include "conetact/base/errors.h"
#include "conetact/base/file_mesh.h"
#include "conetact/base/nearest.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <cctype>

namespace conetact::bodies
{
  namespace
  {
    std::string
    unquoted(const std::string &word)
    {
      if (word.size() > 1 && word.front() == word.back() &&
          (word.front() == '"' || word.front() == '\''))
        return trim(word.substr(1, word.size() - 2));
      return word;
    }

    bool
    begins_like_a_name(const std::string &word)
    {
      return !word.empty() &&
             (std::isalpha(static_cast<unsigned char>(word.front())) != 0 ||
              word.front() == '_' || word.front() == '"' ||
              word.front() == '\'');
    }

    /** What to write in place of a name that no group has. */
    std::string
    advice(const std::string &name, const MeshGroups::Ids &groups)
    {
      if (groups.empty())
        return "Give whole numbers, separated by commas: the mesh has no "
               "groups with names.";
      std::vector<std::string> names;
      for (const auto &[known, ids] : groups)
        names.push_back(known);
      const std::string other = nearest(name, names);
      return (other.empty() ? "" : "Did you mean '" + other + "'? ") +
             "The mesh has the groups " + join(names) +
             ": give one of them, or a number.";
    }
  } // namespace

  BoundaryIds
  to_ids(const std::string     &text,
         const MeshGroups::Ids &groups,
         const std::string     &what,
         const std::string     &entry)
  {
    BoundaryIds ids;
    std::string numbers;
    for (const std::string &word : split(text, ','))
      if (const auto found = groups.find(unquoted(word)); found != groups.end())
        {
          if (found->second.empty())
            throw InputError(entry + ": no face is in '" + unquoted(word) +
                             "' any more: Boundary ids of Mesh gives other "
                             "numbers to all of them. Write these.");
          ids.insert(found->second.begin(), found->second.end());
        }
      else if (begins_like_a_name(word))
        throw InputError(entry + ": '" + unquoted(word) + "' is not " + what +
                         ". " + advice(unquoted(word), groups));
      else
        numbers += (numbers.empty() ? "" : ", ") + word;
    if (!numbers.empty() || ids.empty())
      ids.merge(conetact::to_ids(numbers, entry));
    return ids;
  }

  std::string
  name_of(const unsigned int id, const MeshGroups::Ids &groups)
  {
    std::string shortest;
    if (id >= own_numbers)
      for (const auto &[name, ids] : groups)
        if (ids == BoundaryIds{id} &&
            (shortest.empty() || name.size() < shortest.size()))
          shortest = name;
    return shortest.empty() ? std::to_string(id) : shortest;
  }

  std::string
  join_names(const BoundaryIds &ids, const MeshGroups::Ids &groups)
  {
    std::vector<std::string> names;
    for (const unsigned int id : ids)
      names.push_back(name_of(id, groups));
    return join(names);
  }
} // namespace conetact::bodies
