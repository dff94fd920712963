// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/vtu_grid.h"

#include <deal.II/base/exceptions.h>

#include <libdeflate.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <new>

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

    /** Arrays in zlib's format, one behind the other. */
    class Zipper
    {
    public:
      Zipper()
        : compressor(libdeflate_alloc_compressor(fast),
                     &libdeflate_free_compressor)
      {
        if (!compressor)
          throw std::bad_alloc();
      }

      /**
       * What vtkZLibDataCompressor reads: the number of blocks, their size,
       * that of the last one if it is shorter, zipped sizes; then the blocks.
       */
      void
      append(const unsigned char *data, const std::size_t size)
      {
        std::vector<std::uint32_t> head = {
          static_cast<std::uint32_t>((size + block_size - 1) / block_size),
          block_size,
          static_cast<std::uint32_t>(size % block_size)};
        const std::size_t start = bytes.size();
        head.resize(head.size() + head[0]);
        bytes.resize(start + sizeof(std::uint32_t) * head.size());
        for (std::size_t b = 0; b < head[0]; ++b)
          head[3 + b] = static_cast<std::uint32_t>(
            append_block(data + b * block_size,
                         std::min(block_size, size - b * block_size)));
        std::memcpy(&bytes[start],
                    head.data(),
                    sizeof(std::uint32_t) * head.size());
      }

      std::string bytes;

    private:
      static constexpr int fast = 1;

      /** The size of the zipped block. */
      std::size_t
      append_block(const unsigned char *data, const std::size_t size)
      {
        const std::size_t start = bytes.size();
        const std::size_t room =
          libdeflate_zlib_compress_bound(compressor.get(), size);
        bytes.resize(start + room);
        const std::size_t n = libdeflate_zlib_compress(
          compressor.get(), data, size, &bytes[start], room);
        bytes.resize(start + n);
        return n;
      }

      std::unique_ptr<libdeflate_compressor,
                      decltype(&libdeflate_free_compressor)>
        compressor;
    };

    std::string
    opening(const std::string &type)
    {
      return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
             "\" version=\"0.1\" byte_order=\"LittleEndian\" "
             "compressor=\"vtkZLibDataCompressor\">\n";
    }

    /** `tag`: of arrays, or of those of parts. */
    template <typename T>
    std::string
    begin_array(const std::string &tag, const std::string &name)
    {
      return '<' + tag + " type=\"" + type_name<T> + "\" Name=\"" + name + '"';
    }

    /** What a field is to readers. */
    template <typename T>
    std::string
    heading(const std::string              &tag,
            const std::string              &name,
            const unsigned int              n_components = 1,
            const std::vector<std::string> &components   = {})
    {
      std::string text = begin_array<T>(tag, name) + " NumberOfComponents=\"" +
                         std::to_string(n_components) + '"';
      for (std::size_t c = 0; c < components.size(); ++c)
        text +=
          " ComponentName" + std::to_string(c) + "=\"" + components[c] + '"';
      return text;
    }

    /** As VTK's own writer does it: ParaView shows it beside the name. */
    std::string
    information(const std::string &unit)
    {
      return unit.empty() ? "" :
                            "<InformationKey name=\"UNITS_LABEL\" "
                            "location=\"vtkDataArray\">" +
                              unit + "</InformationKey>\n";
    }

    /** Text, and the arrays that it names by their place behind it. */
    class Writer
    {
    public:
      void
      add(const std::string &more)
      {
        text += more;
      }
      template <typename T>
      void
      add_array(const std::string    &name,
                const std::vector<T> &values,
                const unsigned int    n_components = 1,
                const std::string    &unit         = {})
      {
        add(heading<T>("DataArray", name, n_components));
        add_values(values, unit);
      }
      void
      add_arrays(const std::vector<VtuField> &fields,
                 const std::vector<VtuIds>   &ids)
      {
        for (const VtuField &field : fields)
          {
            add(heading<double>(
              "DataArray", field.name, field.n_components, field.components));
            add_values(field.values, field.unit);
          }
        for (const VtuIds &numbers : ids)
          add_array(numbers.name, numbers.values);
      }
      /** What belongs to the file as a whole, with all digits. */
      template <typename T>
      void
      add_single(const std::string &name, const T value)
      {
        add(begin_array<T>("DataArray", name) + " NumberOfTuples=\"1\"");
        add_values(std::vector<T>{value});
      }
      /** VTK ends each text with a zero. */
      void
      add_text(const std::string &name, const std::string &value)
      {
        add("<Array type=\"String\" Name=\"" + name +
            "\" NumberOfTuples=\"1\"");
        add_bytes(value.c_str(), value.size() + 1);
        add("</Array>\n");
      }
      std::string
      file() const
      {
        return text + "<AppendedData encoding=\"raw\">\n_" + arrays.bytes +
               "\n</AppendedData>\n</VTKFile>\n";
      }

    private:
      template <typename T>
      void
      add_values(const std::vector<T> &values, const std::string &unit = {})
      {
        add_bytes(values.data(), sizeof(T) * values.size());
        add(information(unit) + "</DataArray>\n");
      }
      void
      add_bytes(const void *data, const std::size_t size)
      {
        add(" format=\"appended\" offset=\"" +
            std::to_string(arrays.bytes.size()) + "\">\n");
        arrays.append(static_cast<const unsigned char *>(data), size);
      }

      std::string text;
      Zipper      arrays;
    };

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

    /** Values of some points or cells. */
    template <typename T>
    std::vector<T>
    of_some(const std::vector<T>            &values,
            const unsigned int               n_components,
            const std::vector<unsigned int> &some)
    {
      std::vector<T> result;
      result.reserve(n_components * some.size());
      for (const std::size_t i : some)
        result.insert(result.end(),
                      values.begin() +
                        static_cast<std::ptrdiff_t>(i * n_components),
                      values.begin() +
                        static_cast<std::ptrdiff_t>((i + 1) * n_components));
      return result;
    }

    std::vector<VtuField>
    of_some(const std::vector<VtuField>     &fields,
            const std::vector<unsigned int> &some)
    {
      std::vector<VtuField> result;
      for (const VtuField &field : fields)
        result.push_back({field.name,
                          field.n_components,
                          of_some(field.values, field.n_components, some),
                          field.components,
                          field.unit});
      return result;
    }

    std::vector<VtuIds>
    of_some(const std::vector<VtuIds>       &ids,
            const std::vector<unsigned int> &some)
    {
      std::vector<VtuIds> result;
      for (const VtuIds &numbers : ids)
        result.push_back({numbers.name, of_some(numbers.values, 1, some)});
      return result;
    }

    /** An array of parts, by what tells it from others. */
    std::string
    of_parts(const std::string &heading, const std::string &unit = {})
    {
      return heading + (unit.empty() ?
                          "/>\n" :
                          ">\n" + information(unit) + "</PDataArray>\n");
    }

    std::string
    of_parts(const std::vector<VtuField> &fields,
             const std::vector<VtuIds>   &ids)
    {
      std::string text;
      for (const VtuField &field : fields)
        text += of_parts(heading<double>("PDataArray",
                                         field.name,
                                         field.n_components,
                                         field.components),
                         field.unit);
      for (const VtuIds &numbers : ids)
        text += of_parts(heading<int>("PDataArray", numbers.name));
      return text;
    }

    /** VTK goes round, deal.II does not. Empty: the order is the same. */
    const std::vector<std::size_t> &
    order_of_vtk(const VtuGrid::Shape shape)
    {
      using Shape = VtuGrid::Shape;
      static const std::map<Shape, std::vector<std::size_t>> orders = {
        {Shape::quadrilateral, {0, 1, 3, 2}},
        {Shape::hexahedron, {0, 1, 3, 2, 4, 5, 7, 6}},
        {Shape::biquadratic_quadrilateral, {0, 1, 3, 2, 6, 5, 7, 4, 8}},
        {Shape::triquadratic_hexahedron,
         {0,  1,  3,  2,  4,  5,  7,  6,  10, 9,  11, 8,  14, 13,
          15, 12, 16, 17, 19, 18, 20, 21, 22, 23, 24, 25, 26}}};
      static const std::vector<std::size_t> same;
      const auto                            found = orders.find(shape);
      return found == orders.end() ? same : found->second;
    }
  } // namespace

  void
  VtuGrid::add_cell(const Shape shape, const std::vector<unsigned int> &nodes)
  {
    const std::vector<std::size_t> &order = order_of_vtk(shape);
    Assert(order.empty() || order.size() == nodes.size(),
           dealii::ExcMessage("Each node of a cell has its place."));
    std::vector<int> in_vtk(nodes.begin(), nodes.end());
    for (std::size_t i = 0; i < order.size(); ++i)
      in_vtk[i] = static_cast<int>(nodes[order[i]]);
    add_vtk_cell(shape, in_vtk.data(), in_vtk.data() + in_vtk.size());
  }



  void
  VtuGrid::add_vtk_cell(const Shape shape, const int *begin, const int *end)
  {
    connectivity.insert(connectivity.end(), begin, end);
    offsets.push_back(static_cast<int>(connectivity.size()));
    shapes.push_back(shape);
  }



  VtuGrid
  VtuGrid::part(const std::vector<unsigned int> &cells) const
  {
    constexpr int             none = -1;
    VtuGrid                   result;
    std::vector<int>          number(points.size(), none);
    std::vector<unsigned int> its_points;
    std::vector<int>          nodes;
    for (const unsigned int cell : cells)
      {
        nodes.clear();
        for (int k = cell == 0 ? 0 : offsets[cell - 1]; k < offsets[cell]; ++k)
          {
            const auto point = static_cast<std::size_t>(
              connectivity[static_cast<std::size_t>(k)]);
            if (number[point] == none)
              {
                number[point] = static_cast<int>(its_points.size());
                its_points.push_back(static_cast<unsigned int>(point));
              }
            nodes.push_back(number[point]);
          }
        result.add_vtk_cell(shapes[cell],
                            nodes.data(),
                            nodes.data() + nodes.size());
      }
    result.points         = of_some(points, 1, its_points);
    result.point_fields   = of_some(point_fields, its_points);
    result.point_ids      = of_some(point_ids, its_points);
    result.cell_fields    = of_some(cell_fields, cells);
    result.cell_ids       = of_some(cell_ids, cells);
    result.units          = units;
    result.unit_of_points = unit_of_points;
    return result;
  }



  std::string
  VtuGrid::text(const double time, const unsigned int increment) const
  {
    Writer writer;
    writer.add(opening("UnstructuredGrid") +
               "<UnstructuredGrid>\n<FieldData>\n");
    writer.add_single("TIME", time);
    writer.add_single("TimeValue", time);
    writer.add_single("CYCLE", static_cast<int>(increment));
    if (!units.empty())
      writer.add_text("units", units);
    writer.add("</FieldData>\n<Piece NumberOfPoints=\"" +
               std::to_string(points.size()) + "\" NumberOfCells=\"" +
               std::to_string(shapes.size()) + "\">\n<Points>\n");
    writer.add_array("Points", coordinates(points), 3, unit_of_points);
    writer.add("</Points>\n<Cells>\n");
    writer.add_array("connectivity", connectivity);
    writer.add_array("offsets", offsets);
    writer.add_array("types", shapes);
    writer.add("</Cells>\n<PointData>\n");
    writer.add_arrays(point_fields, point_ids);
    writer.add("</PointData>\n<CellData>\n");
    writer.add_arrays(cell_fields, cell_ids);
    writer.add("</CellData>\n</Piece>\n</UnstructuredGrid>\n");
    return writer.file();
  }



  std::string
  VtuGrid::text_of_parts(const std::vector<std::string> &files) const
  {
    std::string text =
      opening("PUnstructuredGrid") +
      "<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n" +
      of_parts(heading<double>("PDataArray", "Points", 3), unit_of_points) +
      "</PPoints>\n<PPointData>\n" + of_parts(point_fields, point_ids) +
      "</PPointData>\n<PCellData>\n" + of_parts(cell_fields, cell_ids) +
      "</PCellData>\n";
    for (const std::string &file : files)
      text += "<Piece Source=\"" + file + "\"/>\n";
    return text + "</PUnstructuredGrid>\n</VTKFile>\n";
  }
} // namespace conetact
