// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/gmsh_groups.h"

#include "conetact/base/file_mesh.h"
#include "conetact/base/nearest.h"
#include "conetact/base/text.h"

namespace conetact::gmsh_model
{
  namespace
  {
    /** "Shapes/part/bolt": the last word. A translator's words are no name. */
    std::string
    name_of(const std::pair<int, int> &entity)
    {
      std::string name;
      gmsh::model::getEntityName(entity.first, entity.second, name);
      name = name.substr(name.rfind('/') + 1);
      return name.find("Open CASCADE") == name.npos ? name : "";
    }

    std::string
    unquoted(const std::string &word)
    {
      const bool quoted = word.size() > 1 && word.front() == word.back() &&
                          (word.front() == '"' || word.front() == '\'');
      return quoted ? word.substr(1, word.size() - 2) : word;
    }

    std::vector<std::string>
    known_groups(const std::set<int> &dimensions)
    {
      std::vector<std::string> names;
      for (const auto &[dim, tag] : groups())
        if (dimensions.count(dim) > 0)
          {
            std::string name;
            gmsh::model::getPhysicalName(dim, tag, name);
            names.push_back(name.empty() ? std::to_string(tag) : name);
          }
      return names;
    }
  } // namespace

  Entities
  entities(const unsigned int dim)
  {
    Entities all;
    gmsh::model::getEntities(all, static_cast<int>(dim));
    return all;
  }

  Entities
  groups()
  {
    Entities all;
    gmsh::model::getPhysicalGroups(all);
    return all;
  }

  void
  make_groups(const unsigned int dim)
  {
    if (!groups().empty())
      return;
    for (const unsigned int d : {dim - 1, dim})
      for (const auto &entity : entities(d))
        {
          gmsh::model::addPhysicalGroup(entity.first,
                                        {entity.second},
                                        entity.second);
          if (const std::string name = name_of(entity); !name.empty())
            gmsh::model::setPhysicalName(entity.first, entity.second, name);
        }
  }

  Entities
  entities_of(const std::string &text, const std::set<int> &dimensions)
  {
    const std::string name = unquoted(text);
    Entities          result;
    for (const auto &[dim, tag] : groups())
      {
        std::string known;
        gmsh::model::getPhysicalName(dim, tag, known);
        if (dimensions.count(dim) == 0 ||
            (known != name && std::to_string(tag) != name))
          continue;
        std::vector<int> tags;
        gmsh::model::getEntitiesForPhysicalGroup(dim, tag, tags);
        for (const int entity : tags)
          result.emplace_back(dim, entity);
      }
    return result;
  }

  [[noreturn]] void
  refuse_group(const std::string &name, const std::set<int> &dimensions)
  {
    const std::vector<std::string> names = known_groups(dimensions);
    const std::string              other = nearest(name, names);
    throw FileFault{"the drawing has no group '" + name +
                      "'. It has: " + (names.empty() ? "none" : join(names)) +
                      (other.empty() ?
                         std::string() :
                         "; the name that is most like it is '" + other + "'"),
                    "Size near"};
  }

  void
  hide_others(const std::string &group, const int dim)
  {
    Entities wanted;
    for (const std::string &word : split(group, ','))
      for (const auto &entity : entities_of(word, {dim}))
        wanted.push_back(entity);
    if (wanted.empty())
      return; // refused where groups of all files are
    Entities all;
    gmsh::model::getEntities(all);
    gmsh::model::setVisibility(all, 0);
    gmsh::model::setVisibility(wanted, 1, true);
    gmsh::option::setNumber("Mesh.MeshOnlyVisible", 1);
  }
} // namespace conetact::gmsh_model
