// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/vtu_grid.h"

#include <deal.II/base/utilities.h>

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace conetact
{
  namespace
  {
    constexpr std::size_t block_size = 1
                                       << 20; ///< bytes that are zipped as one

    template <typename T>
    const char *type_name;
    template <>
    constexpr const char *type_name<double> = "Float64";
    template <>
    constexpr const char *type_name<int> = "Int32";
    template <>
    constexpr const char *type_name<VtuGrid::Shape> = "UInt8";

    std::string
    base64(const std::vector<unsigned char> &bytes)
    {
      return dealii::Utilities::encode_base64(bytes);
    }

    std::vector<unsigned char>
    zipped(const unsigned char *data, const std::size_t size)
    {
      uLongf                     n = compressBound(static_cast<uLong>(size));
      std::vector<unsigned char> bytes(n);
      if (compress2(
            bytes.data(), &n, data, static_cast<uLong>(size), Z_BEST_SPEED) !=
          Z_OK)
        throw std::runtime_error("zlib cannot compress an array of a picture.");
      bytes.resize(n);
      return bytes;
    }

    /**
     * What vtkZLibDataCompressor reads: the number of blocks, their size, that
     * of the last one if it is shorter, zipped sizes; then the blocks.
     */
    template <typename T>
    std::string
    encoded(const std::vector<T> &values)
    {
      const auto *data = reinterpret_cast<const unsigned char *>(values.data());
      const std::size_t          size = sizeof(T) * values.size();
      std::vector<std::uint32_t> head = {
        static_cast<std::uint32_t>((size + block_size - 1) / block_size),
        block_size,
        static_cast<std::uint32_t>(size % block_size)};
      std::vector<unsigned char> blocks;
      for (std::size_t start = 0; start < size; start += block_size)
        {
          const std::vector<unsigned char> block =
            zipped(data + start, std::min(block_size, size - start));
          head.push_back(static_cast<std::uint32_t>(block.size()));
          blocks.insert(blocks.end(), block.begin(), block.end());
        }
      std::vector<unsigned char> head_bytes(sizeof(std::uint32_t) *
                                            head.size());
      std::memcpy(head_bytes.data(), head.data(), head_bytes.size());
      return base64(head_bytes) + base64(blocks);
    }

    // Appended, because files may be large.
    template <typename T>
    void
    append(std::string                    &text,
           const std::string              &name,
           const std::vector<T>           &values,
           const unsigned int              n_components = 1,
           const std::vector<std::string> &components   = {})
    {
      text += std::string("<DataArray type=\"") + type_name<T> + "\" Name=\"" +
              name + "\" NumberOfComponents=\"" + std::to_string(n_components) +
              '"';
      for (std::size_t c = 0; c < components.size(); ++c)
        text +=
          " ComponentName" + std::to_string(c) + "=\"" + components[c] + '"';
      text += " format=\"binary\">\n";
      text += encoded(values);
      text += "\n</DataArray>\n";
    }

    void
    append(std::string &text, const std::vector<VtuField> &fields)
    {
      for (const VtuField &field : fields)
        append(
          text, field.name, field.values, field.n_components, field.components);
    }

    std::vector<double>
    coordinates(const std::vector<Point<3>> &points)
    {
      std::vector<double> x;
      x.reserve(3 * points.size());
      for (const Point<3> &p : points)
        for (unsigned int d = 0; d < 3; ++d)
          x.push_back(p[d]);
      return x;
    }

    /** What belongs to the file as a whole, with all digits. */
    template <typename T>
    std::string
    single(const std::string &name, const T value)
    {
      return std::string("<DataArray type=\"") + type_name<T> + "\" Name=\"" +
             name + "\" NumberOfTuples=\"1\" format=\"binary\">\n" +
             encoded(std::vector<T>{value}) + "\n</DataArray>\n";
    }
  } // namespace



  void
  VtuGrid::add_cell(const Shape shape, std::vector<unsigned int> nodes)
  {
    // VTK goes round, deal.II does not
    for (std::size_t i = 2;
         i < nodes.size() &&
         (shape == Shape::quadrilateral || shape == Shape::hexahedron);
         i += 4)
      std::swap(nodes[i], nodes[i + 1]);
    for (const unsigned int node : nodes)
      connectivity.push_back(static_cast<int>(node));
    offsets.push_back(static_cast<int>(connectivity.size()));
    shapes.push_back(shape);
  }



  std::string
  VtuGrid::text(const double time, const unsigned int increment) const
  {
    std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
      "byte_order=\"LittleEndian\" compressor=\"vtkZLibDataCompressor\">\n"
      "<UnstructuredGrid>\n<FieldData>\n" +
      single("TIME", time) + single("TimeValue", time) +
      single("CYCLE", static_cast<int>(increment)) +
      "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(points.size()) +
      "\" NumberOfCells=\"" + std::to_string(shapes.size()) + "\">\n<Points>\n";
    append(text, "Points", coordinates(points), 3);
    text += "</Points>\n<Cells>\n";
    append(text, "connectivity", connectivity);
    append(text, "offsets", offsets);
    append(text, "types", shapes);
    text += "</Cells>\n<PointData>\n";
    append(text, point_fields);
    text += "</PointData>\n<CellData>\n";
    append(text, cell_fields);
    for (const VtuIds &ids : cell_ids)
      append(text, ids.name, ids.values);
    return text + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }
} // namespace conetact
