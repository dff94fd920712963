// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/gmsh_file.h"

#include "conetact/base/gmsh_source.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <unordered_map>

namespace conetact
{
  namespace
  {
    /** Dimension and numbers of nodes; corners stand first. */
    struct Kind
    {
      unsigned int dim;
      std::size_t  n_nodes, n_corners;
    };
    Kind
    kind_of(const std::size_t type)
    {
      static const std::map<std::size_t, Kind> kinds = {{1, {1, 2, 2}},
                                                        {2, {2, 3, 3}},
                                                        {3, {2, 4, 4}},
                                                        {4, {3, 4, 4}},
                                                        {5, {3, 8, 8}},
                                                        {6, {3, 6, 6}},
                                                        {7, {3, 5, 5}},
                                                        // of second order
                                                        {8, {1, 3, 2}},
                                                        {9, {2, 6, 3}},
                                                        {10, {2, 9, 4}},
                                                        {11, {3, 10, 4}},
                                                        {12, {3, 27, 8}},
                                                        {13, {3, 18, 6}},
                                                        {14, {3, 14, 5}},
                                                        {15, {0, 1, 1}},
                                                        {16, {2, 8, 4}},
                                                        {17, {3, 20, 8}},
                                                        {18, {3, 15, 6}},
                                                        {19, {3, 13, 5}}};
      const auto                               found = kinds.find(type);
      if (found == kinds.end())
        throw FileFault{"it has elements of third or higher order, or of a "
                        "kind that is not known (Gmsh's type " +
                        std::to_string(type) +
                        "). Save it with elements of first order (in Gmsh "
                        "'Mesh.ElementOrder = 1;')"};
      return found->second;
    }

    class Reader
    {
    public:
      explicit Reader(const std::string &contents)
        : source(contents)
      {}

      /** Faults of text say on which line. */
      FileMesh
      read()
      {
        try
          {
            return read_sections();
          }
        catch (const FileFault &fault)
          {
            if (is_binary)
              throw;
            throw FileFault{source.place() + fault.why};
          }
      }

    private:
      FileMesh
      read_sections()
      {
        for (std::string name = source.next_section(); !name.empty();
             name             = source.next_section())
          {
                        if (const auto found = sections().find(name);
                found != sections().end())
              (this->*found->second)();
            source.leave_section();
          }
        if (mesh.elements.empty())
          throw FileFault{"it has no elements"};
        return std::move(mesh);
      }

      using Section = void (Reader::*)();

      static const std::map<std::string, Section> &
      sections()
      {
        static const std::map<std::string, Section> known = {
          {"MeshFormat", &Reader::read_format},
          {"PhysicalNames", &Reader::read_names},
          {"Entities", &Reader::read_entities},
          {"PartitionedEntities", &Reader::refuse_partitions},
          {"Nodes", &Reader::read_nodes},
          {"Elements", &Reader::read_elements}};
        return known;
      }

      void
      read_format()
      {
        version                = source.real();
        const bool   binary    = source.integer() != 0;
        const double data_size = source.real();
        blocks                 = version >= 4;
        if (!(version >= 2 && version < 3) && version != 4.1)
          throw FileFault{"it is of version " + to_text(version) +
                          ". Save it as version 4.1 or 2.2"};
        source.line();
        source.is_binary = is_binary = binary;
        if (binary && (source.integer() != 1 || data_size != 8))
          throw FileFault{"it is a binary file of another kind of machine. "
                          "Save it as ASCII (in Gmsh 'Mesh.Binary = 0;')"};
      }

      /* Always text: dimension, number and "name". */
      void
      read_names()
      {
        const bool binary   = source.is_binary;
        source.is_binary    = false;
        const std::size_t n = source.count();
        for (std::size_t i = 0; i < n; ++i)
          {
            const auto         dim  = static_cast<unsigned int>(source.count());
            const unsigned int tag  = group(source.integer());
            const std::string  text = source.line();
            const std::size_t  from = text.find('"'), to = text.rfind('"');
            if (to != std::string::npos && to > from)
              mesh.names[{dim, tag}] = text.substr(from + 1, to - from - 1);
          }
        source.is_binary = binary;
      }

      /* Which physical groups the parts of the geometry belong to. */
      void
      read_entities()
      {
        std::size_t n[4];
        for (std::size_t &count : n)
          count = source.count();
        for (unsigned int dim = 0; dim < 4; ++dim)
          for (std::size_t i = 0; i < n[dim]; ++i)
            {
              const long tag = source.integer();
              for (unsigned int k = 0; k < (dim == 0 ? 3 : 6); ++k)
                source.real(); // a point, or a box around it
              const std::size_t n_groups = source.count();
              for (std::size_t k = 0; k < n_groups; ++k)
                groups_of[{dim, tag}].insert(group(source.integer()));
              const std::size_t n_sides = dim == 0 ? 0 : source.count();
              for (std::size_t k = 0; k < n_sides; ++k)
                source.integer();
            }
      }

      void
      refuse_partitions()
      {
        throw FileFault{"it is divided into partitions. Save it without "
                        "them"};
      }

      /** The sign of a group is an orientation. */
      static unsigned int
      group(const long number)
      {
        return static_cast<unsigned int>(std::abs(number));
      }

      void
      read_nodes()
      {
        const std::size_t n =
          blocks || !source.is_binary ? source.count() : text_count();
        if (!blocks)
          for (std::size_t i = 0; i < n; ++i)
            {
              add_number(source.small_count());
              mesh.points.push_back(source.point());
            }
        else
          {
            skip_counts();
            for (std::size_t block = 0; block < n; ++block)
              read_node_block();
          }
        if (numbers.size() != mesh.points.size())
          throw FileFault{"a node stands there twice"};
      }

      void
      read_node_block()
      {
        const long dim = source.integer();
        source.integer();
        const long        parameters = source.integer() != 0 ? dim : 0;
        const std::size_t n          = source.count();
        for (std::size_t i = 0; i < n; ++i)
          add_number(source.count());
        for (std::size_t i = 0; i < n; ++i)
          {
            mesh.points.push_back(source.point());
            for (long k = 0; k < parameters; ++k)
              source.real();
          }
      }

      /** Of version 2 numbers of things are text in binary files, too. */
      std::size_t
      text_count()
      {
        source.is_binary    = false;
        const std::size_t n = source.count();
        source.line();
        source.is_binary = true;
        return n;
      }
      /** Of all, and the range of their numbers. */
      void
      skip_counts()
      {
        for (unsigned int i = 0; i < 3; ++i)
          source.count();
      }
      void
      add_number(const std::size_t number)
      {
        numbers.emplace(number, static_cast<unsigned int>(numbers.size()));
      }

      void
      read_elements()
      {
        if (blocks)
          {
            const std::size_t n = source.count();
            skip_counts();
            for (std::size_t block = 0; block < n; ++block)
              read_element_block();
          }
        else if (source.is_binary)
          read_binary_elements();
        else
          {
            const std::size_t n = source.count();
            for (std::size_t i = 0; i < n; ++i)
              {
                source.count();
                const std::size_t type = source.count();
                read_old_element(kind_of(type), source.count());
              }
          }
      }

      void
      read_element_block()
      {
        const auto        dim   = static_cast<unsigned int>(source.integer());
        const long        tag   = source.integer();
        const Kind        kind  = kind_of(source.small_count());
        const std::size_t n     = source.count();
        const auto        found = groups_of.find({dim, tag});
        for (std::size_t i = 0; i < n; ++i)
          {
            source.count();
            FileMesh::Element element{kind.dim, {}, {}};
            if (found != groups_of.end())
              element.groups = found->second;
            element.nodes.reserve(kind.n_corners);
            for (std::size_t k = 0; k < kind.n_nodes; ++k)
              add_node(kind, k, node(source.count()), element);
            if (kind.dim > 0)
              mesh.elements.push_back(std::move(element));
          }
      }

      /** Corners stand first. */
      static void
      add_node(const Kind        &kind,
               const std::size_t  k,
               const unsigned int point,
               FileMesh::Element &element)
      {
        if (k < kind.n_corners)
          element.nodes.push_back(point);
        else
          element.middles.push_back(point);
      }

      /* Type, number of elements and tags; then the elements. */
      void
      read_binary_elements()
      {
        const std::size_t n = text_count();
        for (std::size_t read = 0; read < n;)
          {
            const Kind        kind     = kind_of(source.small_count());
            const std::size_t in_block = source.small_count();
            const std::size_t n_tags   = source.small_count();
            for (std::size_t i = 0; i < in_block; ++i, ++read)
              {
                source.integer();
                read_old_element(kind, n_tags);
              }
            if (in_block == 0)
              source.ends_early();
          }
      }

      /* Of version 2: the first tag is its physical group, 0 for none. One in
         several groups stands there for each of them. */
      void
      read_old_element(const Kind kind, const std::size_t n_tags)
      {
        FileMesh::Element element{kind.dim, {}, {}};
        for (std::size_t k = 0; k < n_tags; ++k)
          if (const long tag = source.integer(); k == 0 && tag != 0)
            element.groups.insert(group(tag));
        for (std::size_t k = 0; k < kind.n_nodes; ++k)
          add_node(kind, k, node(source.small_count()), element);
        if (kind.dim == 0)
          return;
        std::vector<unsigned int> key = element.nodes;
        std::sort(key.begin(), key.end());
        const auto [known, is_new] =
          known_elements.emplace(key, mesh.elements.size());
        if (is_new)
          mesh.elements.push_back(std::move(element));
        else
          mesh.elements[known->second].groups.merge(element.groups);
      }

      unsigned int
      node(const std::size_t number) const
      {
        const auto found = numbers.find(number);
        if (found == numbers.end())
          throw FileFault{"an element names a node that is not there"};
        return found->second;
      }

      GmshSource source;
      FileMesh   mesh;
      double     version   = 0;
      bool       blocks    = false; ///< of version 4
      bool       is_binary = false;
      /** Of nodes to points. */
      std::unordered_map<std::size_t, unsigned int> numbers;
      /** By dimension and number of a part of the geometry. */
      std::map<std::pair<unsigned int, long>, std::set<unsigned int>> groups_of;
      std::map<std::vector<unsigned int>, std::size_t> known_elements;
    };
  } // namespace

  double
  gmsh_version(const std::string &contents)
  {
    const std::string header = "$MeshFormat";
    const std::size_t found  = contents.find(header);
    if (found == std::string::npos)
      return 1;
    return std::strtod(contents.c_str() + found + header.size(), nullptr);
  }

  FileMesh
  read_gmsh(const std::string &contents)
  {
    return Reader(contents).read();
  }
} // namespace conetact
