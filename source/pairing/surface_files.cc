// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/surface_files.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/pairing/joined_surface.h"
#include "conetact/pairing/surface_words.h"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

namespace conetact::pairing
{
  namespace
  {
    void
    add_triangle(SurfaceFaces &mesh, const std::array<Point<3>, 3> &corners)
    {
      const auto n = static_cast<unsigned int>(mesh.points.size());
      mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
      mesh.faces.push_back({n, n + 1, n + 2});
    }

    SurfaceFaces
    read_ascii_stl(const std::string &text)
    {
      SurfaceFaces            mesh;
      std::istringstream      stream(text);
      std::string             word;
      std::array<Point<3>, 3> corners;
      std::size_t             n = 0;
      while (stream >> word)
        if (word == "vertex")
          {
            if (n == 3)
              throw Fault{"a facet has more than three vertices"};
            corners.at(n++) = read_point(stream);
          }
        else if (word == "endfacet")
          {
            if (n != 3)
              throw Fault{"a facet has fewer than three vertices"};
            add_triangle(mesh, corners);
            n = 0;
          }
      if (n > 0)
        throw Fault{"it ends in the middle of a facet"};
      return mesh;
    }

    /* 80 bytes of text, the number of facets, 50 bytes a facet: normal, three
       vertices, two bytes of attributes; numbers are little-endian. */
    SurfaceFaces
    read_binary_stl(const std::string &bytes, const std::size_t n)
    {
      SurfaceFaces mesh;
      for (std::size_t f = 0; f < n; ++f)
        {
          std::array<float, 9> x{};
          std::memcpy(x.data(), bytes.data() + 84 + 50 * f + 12, sizeof(x));
          std::array<Point<3>, 3> corners;
          for (unsigned int i = 0; i < 9; ++i)
            corners.at(i / 3)[i % 3] = static_cast<double>(x.at(i));
          add_triangle(mesh, corners);
        }
      return mesh;
    }

    /** Binary files may begin with the word solid: their length tells. */
    SurfaceFaces
    read_stl(const std::string &bytes, const unsigned int)
    {
      std::uint32_t n = 0;
      if (bytes.size() >= 84)
        {
          std::memcpy(&n, bytes.data() + 80, sizeof(n));
          if (bytes.size() == 84 + 50 * std::size_t{n})
            return read_binary_stl(bytes, n);
        }
      if (trim(bytes.substr(0, 80)).substr(0, 5) != "solid")
        throw Fault{"it neither begins with 'solid' nor is as long as a binary "
                    "STL file of its number of facets"};
      return read_ascii_stl(bytes);
    }

    /** A vertex of "f 1/2/3 -1//4": counted from 1, or back from the last. */
    unsigned int
    obj_vertex(const std::string &word, const std::size_t n_points)
    {
      std::istringstream stream(word.substr(0, word.find('/')));
      const double       index = read_number(stream);
      const double       i =
        index < 0 ? static_cast<double>(n_points) + index : index - 1;
      if (!(i >= 0 && i < static_cast<double>(n_points) && i == std::floor(i)))
        throw Fault{"a face names the vertex '" + word + "', one of " +
                    std::to_string(n_points)};
      return static_cast<unsigned int>(i);
    }

    SurfaceFaces
    read_obj(const std::string &text, const unsigned int)
    {
      SurfaceFaces       mesh;
      std::istringstream lines(text);
      std::string        line, word;
      while (std::getline(lines, line))
        {
          std::istringstream stream(line.substr(0, line.find('#')));
          if (!(stream >> word))
            continue;
          if (word == "v")
            mesh.points.push_back(read_point(stream));
          if (word != "f")
            continue;
          std::vector<unsigned int> face;
          while (stream >> word)
            face.push_back(obj_vertex(word, mesh.points.size()));
          if (face.size() < 3)
            throw Fault{"a face has fewer than three vertices"};
          // Polygons of more corners become fans of triangles about their first
          // one, as if they were convex and plane.
          if (face.size() <= 4)
            mesh.faces.push_back(face);
          else
            for (std::size_t i = 2; i < face.size(); ++i)
              mesh.faces.push_back({face[0], face[i - 1], face[i]});
        }
      return mesh;
    }

    std::string
    contents(const std::filesystem::path &file)
    {
      std::error_code error;
      if (!std::filesystem::exists(file, error))
        throw Fault{"there is no such file. Give a path relative to the "
                    "scene's folder"};
      if (!std::filesystem::is_regular_file(file, error))
        throw Fault{"it is no file. Name a file of faces"};
      std::ifstream      stream(file, std::ios::binary);
      std::ostringstream text;
      if (!(text << stream.rdbuf()))
        throw Fault{"it is empty or cannot be read. Write it again, or check "
                    "its permissions"};
      return text.str();
    }

    SurfaceFaces
    read(const std::filesystem::path &file, const unsigned int dim)
    {
      const std::string extension = lower_case(file.extension().string());
      using Reader = SurfaceFaces (*)(const std::string &, const unsigned int);
      const std::map<std::string, Reader> readers = {{".stl", read_stl},
                                                     {".obj", read_obj},
                                                     {".msh", read_msh}};
      const auto                          found   = readers.find(extension);
      if (found == readers.end())
        throw Fault{"its format is not known by its name. Give a file .stl, "
                    ".obj or .msh"};
      const SurfaceFaces mesh = found->second(contents(file), dim);
      for (const Point<3> &p : mesh.points)
        if (!std::isfinite(p.norm_square()))
          throw Fault{"a coordinate of " + to_text(p) +
                      " is not a finite number"};
      SurfaceFaces result = joined(mesh);
      result.bent         = mesh.bent;
      if (result.faces.empty())
        throw Fault{dim == 2 ?
                      "it has no lines. In 2D give a .msh file of lines" :
                      "it has no triangles or quadrilaterals"};
      return result;
    }
  } // namespace

  SurfaceFaces
  read_surface(const std::filesystem::path &file,
               const unsigned int           dim,
               const std::string           &entry)
  {
    try
      {
        return read(file, dim);
      }
    catch (const Fault &fault)
      {
        throw InputError(entry + ": '" + file.string() +
                         "' cannot be taken as a surface: " + fault.why + ".");
      }
  }
} // namespace conetact::pairing
