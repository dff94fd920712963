// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/parameters.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/frame/generators.h"
#include "conetact/bodies/frame/reader.h"
#include "conetact/bodies/frame/sections.h"
#include "conetact/bodies/placement.h"

#include <algorithm>

namespace conetact::bodies
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    void
    declare_geometry(ParameterHandler &prm)
    {
      std::string generators;
      for (const FrameGenerator &row : frame_generators())
        generators += (generators.empty() ? "" : "; ") + std::string(row.name) +
                      ": " + row.description;
      prm.declare_entry("Generator",
                        "",
                        Patterns::Anything(),
                        "Instead of Nodes or File: a frame of a few numbers, "
                        "all members of the first section. " +
                          generators + ". [-]");
      prm.declare_entry("Arguments",
                        "",
                        Patterns::Anything(),
                        "Arguments of the generator, separated by ':'. "
                        "[length]");
      prm.declare_entry(
        "Nodes",
        "",
        Patterns::Anything(),
        "Nodes by name, 'name: x, y ; ...' (3D: x, y, z), names being numbers "
        "or words; boundary ids may follow, '7: 4, 0 : 1, 2'. A long list is "
        "continued in the next line after a backslash. [length]");
      prm.declare_entry(
        "Members",
        "",
        Patterns::Anything(),
        "Members, 'a-b: section ; ...', or several in a row, 'a-b-c: section'. "
        "Options follow after commas: 'hinge start', 'hinge end', 'hinges' (no "
        "bending moment at an end; in 3D no torque either), 'elements 10' "
        "(each is divided), 'group 5' (has boundary id 5). [-]");
      prm.declare_entry(
        "File",
        "",
        Patterns::Anything(),
        "Nodes and members from a text file in the scene's folder: lines "
        "'node, name, x, y[, z][, boundary id]...' and 'member, a, b, "
        "section[, option]...', nodes first; '#' starts a comment. [length]");
    }

    void
    declare_tags(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Boundary ids",
        "",
        Patterns::Anything(),
        "Boundary ids of nodes by conditions, 'id: condition ; ...', such as "
        "'1: abs(y) < 1e-6': a node (x, y, z in the scene's coordinates) that "
        "satisfies it gets the id besides those it has. Nodes without any "
        "have id 0. A member has the ids that both its nodes have, and its "
        "groups; nodes that divide it have the ids of both its ends. [-]");
    }

    void
    check_sources(const bool         generator,
                  const bool         nodes,
                  const bool         file,
                  const std::string &where)
    {
      if (generator + nodes + file != 1)
        throw InputError(where + "Nodes: " +
                         (generator || nodes || file ?
                            "more than one of Nodes, File and Generator is "
                            "set. Keep one." :
                            "there is no frame. Set Nodes and Members, File, "
                            "or Generator."));
    }

    void
    generate(const std::string &name,
             const std::string &arguments,
             const std::string &where,
             FrameModel        &model)
    {
      std::vector<std::string> names;
      for (const FrameGenerator &row : frame_generators())
        {
          names.push_back(row.name);
          if (name == row.name)
            return row.generate(split(arguments, ':'), where, model);
        }
      throw InputError(where + "Generator: there is no '" + name +
                       "'. Give one of: " + join(names) + ".");
    }

    void
    read(ParameterHandler            &prm,
         const std::filesystem::path &folder,
         const std::string           &where,
         FrameModel                  &model)
    {
      const auto text = [&](const char *entry) { return trim(prm.get(entry)); };
      const std::string generator = text("Generator"), nodes = text("Nodes"),
                        members = text("Members"), file = text("File");
      check_sources(!generator.empty(), !nodes.empty(), !file.empty(), where);
      FrameReader reader(model);
      if (!generator.empty())
        generate(generator, text("Arguments"), where, model);
      else if (!file.empty())
        reader.read_file(folder / file, where + "File");
      else
        reader.read_nodes(nodes, where + "Nodes");
      if (!generator.empty() && !members.empty())
        throw InputError(where + "Members: the generator makes all members. " +
                         "Remove them.");
      reader.read_members(members, where + "Members");
      if (model.members.empty())
        throw InputError(
          where + "Members: there are none. Write 'a-b: " + "section ; ...'.");
    }

    void
    place(const Placement &placement, FrameModel &model)
    {
      for (FrameNode &node : model.nodes)
        {
          node.position = placement.to_scene(node.position);
          node.area *= placement.scale * placement.scale;
          node.normal = placement.rotation * node.normal;
        }
    }

    /** Id 0 for nodes without any, and for members between two of them. */
    void
    tag_the_rest(FrameModel &model)
    {
      const auto rest = [&](const unsigned int node) {
        return model.nodes[node].ids.count(0) > 0;
      };
      for (FrameNode &node : model.nodes)
        if (node.between ?
              rest((*node.between)[0]) && rest((*node.between)[1]) :
              node.ids.empty())
          node.ids.insert(0);
    }

    void
    tag(const std::vector<BoundaryTag> &tags,
        const std::string              &where,
        FrameModel                     &model)
    {
      for (const BoundaryTag &tag : tags)
        {
          bool found = false;
          for (FrameNode &node : model.nodes)
            if (tag.condition(node.position) != 0)
              {
                node.ids.insert(tag.id);
                found = true;
              }
          if (!found)
            throw InputError(where + "Boundary ids: no node satisfies '" +
                             tag.text + "' (id " + std::to_string(tag.id) +
                             "). Check the condition against the nodes' "
                             "coordinates.");
        }
      tag_the_rest(model);
    }

    void
    check(const FrameModel &model, const std::string &where)
    {
      double size = 0;
      for (const FrameNode &node : model.nodes)
        size =
          std::max(size, node.position.distance(model.nodes.front().position));
      std::vector<bool> used(model.nodes.size(), false);
      for (const FrameMember &member : model.members)
        {
          const FrameNode &a    = model.nodes[member.nodes[0]];
          const FrameNode &b    = model.nodes[member.nodes[1]];
          used[member.nodes[0]] = used[member.nodes[1]] = true;
          if (!(a.position.distance(b.position) > 1e-10 * size))
            throw InputError(where + "Members: member " + a.name + "-" +
                             b.name + " has no length, both ends are at " +
                             to_text(a.position) +
                             ". Move a node or remove "
                             "the member.");
        }
      for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i])
          throw InputError(where + "Nodes: node '" + model.nodes[i].name +
                           "' belongs to no member, nothing holds it. Remove "
                           "it, or add a member.");
    }
  } // namespace

  void
  declare_frame(ParameterHandler &prm)
  {
    declare_sections(prm);
    prm.enter_subsection("Frame");
    declare_geometry(prm);
    declare_placement(prm);
    declare_tags(prm);
    prm.leave_subsection();
  }

  FrameModel
  parse_frame(ParameterHandler            &prm,
              const unsigned int           dim,
              const std::filesystem::path &folder,
              const std::string           &body)
  {
    const std::string where = body + ", Frame/";
    FrameModel        model;
    model.dim      = dim;
    model.sections = parse_sections(prm, dim, body);
    prm.enter_subsection("Frame");
    read(prm, folder, where, model);
    place(parse_placement(prm, dim, where), model);
    tag(parse_tags(prm.get("Boundary ids"), where + "Boundary ids"),
        where,
        model);
    prm.leave_subsection();
    check(model, where);
    return model;
  }
} // namespace conetact::bodies
