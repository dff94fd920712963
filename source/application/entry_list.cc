// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/entry_list.h"

#include "conetact/application/scene_entries.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <cctype>
#include <sstream>
#include <utility>

namespace conetact::application
{
  namespace
  {
    using Tree = boost::property_tree::ptree;

    /** deal.II writes what is no letter and no digit as _20. */
    std::string
    plain_name(const std::string &mangled)
    {
      std::string name;
      for (std::size_t i = 0; i < mangled.size(); ++i)
        if (mangled[i] == '_' && i + 2 < mangled.size() &&
            std::isxdigit(static_cast<unsigned char>(mangled[i + 1])) != 0 &&
            std::isxdigit(static_cast<unsigned char>(mangled[i + 2])) != 0)
          {
            name += static_cast<char>(
              std::stoi(mangled.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          name += mangled[i];
      return name;
    }

    void
    collect(const Tree                    &tree,
            std::vector<std::string>      &path,
            std::vector<EntryDescription> &entries)
    {
      for (const auto &[mangled, below] : tree)
        if (below.get_child_optional("value"))
          entries.push_back(
            {path,
             plain_name(mangled),
             below.get<std::string>("value"),
             below.get<std::string>("default_value"),
             below.get<std::string>("documentation"),
             value_kind(below.get<std::string>("pattern_description"))});
        else
          {
            path.push_back(plain_name(mangled));
            collect(below, path, entries);
            path.pop_back();
          }
    }
  } // namespace



  void
  declare_any_scene(dealii::ParameterHandler &prm)
  {
    const std::vector<std::string> one = {any_name};
    declare_scene(prm, {one, one, one, one, one});
    prm.enter_subsection("Body " + one.front());
    prm.set("Sections", one.front()); // declares Section NAME
    prm.set("Sections", std::string());
    prm.leave_subsection();
  }



  std::vector<EntryDescription>
  list_entries(const dealii::ParameterHandler &prm)
  {
    std::stringstream stream;
    prm.print_parameters(stream,
                         dealii::ParameterHandler::XML |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    Tree tree;
    boost::property_tree::read_xml(stream, tree);
    std::vector<EntryDescription> entries;
    std::vector<std::string>      path;
    collect(tree.get_child("ParameterHandler"), path, entries);
    return entries;
  }
} // namespace conetact::application
