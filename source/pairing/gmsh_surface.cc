// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Lines and faces of Gmsh's files.

#include "conetact/pairing/surface_words.h"

#include <map>
#include <sstream>

namespace conetact::pairing
{
  namespace
  {
    void
    go_to(std::istream &stream, const std::string &section)
    {
      std::string word;
      while (stream >> word)
        if (word == section)
          return;
      throw Fault{"it has no section " + section};
    }

    /** Numbers of Gmsh's nodes to those of points. */
    using NodeNumbers = std::map<std::size_t, unsigned int>;

    void
    read_msh_nodes(std::istream &stream,
                   const bool    blocks,
                   SurfaceFaces &mesh,
                   NodeNumbers  &numbers)
    {
      go_to(stream, "$Nodes");
      const std::size_t n          = read_whole(stream);
      const auto        add_number = [&](const std::size_t tag) {
        const auto next = static_cast<unsigned int>(numbers.size());
        numbers.emplace(tag, next);
      };
      if (!blocks)
        for (std::size_t i = 0; i < n; ++i)
          {
            add_number(read_whole(stream));
            mesh.points.push_back(read_point(stream));
          }
      else
        {
          for (unsigned int i = 0; i < 3; ++i)
            read_whole(stream);
          for (std::size_t block = 0; block < n; ++block)
            {
              for (unsigned int i = 0; i < 3; ++i)
                read_number(stream); // entity and whether it is parametric
              const std::size_t in_block = read_whole(stream);
              for (std::size_t i = 0; i < in_block; ++i)
                add_number(read_whole(stream));
              for (std::size_t i = 0; i < in_block; ++i)
                mesh.points.push_back(read_point(stream));
            }
        }
      if (numbers.size() != mesh.points.size())
        throw Fault{"a node stands there twice"};
    }

    /** The rest of a line of an element: lines, triangles, quadrilaterals. */
    void
    read_msh_element(std::istream      &stream,
                     const std::size_t  type,
                     const unsigned int dim,
                     const NodeNumbers &numbers,
                     SurfaceFaces      &mesh)
    {
      std::string line;
      std::getline(stream, line);
      if (type < 1 || type > 3 || (type == 1) != (dim == 2))
        return; // points, lines round faces, cells
      std::istringstream        rest(line);
      std::vector<unsigned int> face;
      for (std::size_t i = 0; i < type + 1; ++i)
        {
          const auto found = numbers.find(read_whole(rest));
          if (found == numbers.end())
            throw Fault{"an element names a node that is not there"};
          face.push_back(found->second);
        }
      mesh.faces.push_back(face);
    }

  } // namespace

  SurfaceFaces
  read_msh(const std::string &text, const unsigned int dim)
  {
    std::istringstream stream(text);
    go_to(stream, "$MeshFormat");
    const double version = read_number(stream);
    if (read_number(stream) != 0)
      throw Fault{"it is binary. Save it as ASCII (in Gmsh 'Mesh.Binary = "
                  "0;')"};
    const bool   blocks = version >= 4;
    SurfaceFaces mesh;
    NodeNumbers  numbers;
    read_msh_nodes(stream, blocks, mesh, numbers);
    go_to(stream, "$Elements");
    const std::size_t n = read_whole(stream);
    if (!blocks)
      for (std::size_t i = 0; i < n; ++i)
        {
          read_whole(stream);
          const std::size_t type   = read_whole(stream),
                            n_tags = read_whole(stream);
          for (std::size_t k = 0; k < n_tags; ++k)
            read_number(stream);
          read_msh_element(stream, type, dim, numbers, mesh);
        }
    else
      {
        for (unsigned int i = 0; i < 3; ++i)
          read_whole(stream);
        for (std::size_t block = 0; block < n; ++block)
          {
            read_whole(stream);
            read_number(stream);
            const std::size_t type     = read_whole(stream),
                              in_block = read_whole(stream);
            for (std::size_t i = 0; i < in_block; ++i)
              {
                read_whole(stream);
                read_msh_element(stream, type, dim, numbers, mesh);
              }
          }
      }
    return mesh;
  }
} // namespace conetact::pairing
