// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_vtu_grid_h
#define conetact_base_vtu_grid_h

#include "conetact/base/points.h"

#include <string>
#include <vector>

namespace conetact
{
  /** A field of a grid, values point by point or cell by cell. */
  struct VtuField
  {
    std::string         name;
    unsigned int        n_components = 1; ///< 3: a vector, 9: a tensor by rows
    std::vector<double> values;
    /** Of each component, where x, y, z would be wrong. */
    std::vector<std::string> components = {};
    std::string              unit       = {}; ///< empty: not known

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &name &n_components &values &components &unit;
    }
  };

  /** Whole numbers of cells or points, such as ids. */
  struct VtuIds
  {
    std::string      name;
    std::vector<int> values;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &name &values;
    }
  };

  /**
   * Points, cells and fields of a picture, as VTK's unstructured grids are:
   * deal.II's writers know neither fields of cells nor double precision, and
   * double each point for each cell. The text is XML, behind which arrays stand
   * zipped in binary, positions and fields with all their digits.
   */
  struct VtuGrid
  {
    std::vector<Point<3>> points;
    std::vector<VtuField> point_fields;
    std::vector<VtuField> cell_fields;
    std::vector<VtuIds>   point_ids, cell_ids;

    /** Of each point of a body its node; it is not written. */
    std::vector<unsigned int>     nodes_of_points;
    static constexpr unsigned int no_node = -1;

    /** Of the file as a whole, to be read by people, and of its points; empty:
     * not known. */
    std::string units, unit_of_points;

    /** VTK's numbers; those of second degree have bent edges. */
    enum class Shape : unsigned char
    {
      vertex                    = 1,
      line                      = 3,
      triangle                  = 5,
      quadrilateral             = 9,
      tetrahedron               = 10,
      hexahedron                = 12,
      quadratic_triangle        = 22,
      quadratic_tetrahedron     = 24,
      biquadratic_quadrilateral = 28,
      triquadratic_hexahedron   = 29
    };
    /** `nodes` in deal.II's order. */
    void
    add_cell(const Shape shape, const std::vector<unsigned int> &nodes);
    std::size_t
    n_cells() const
    {
      return shapes.size();
    }

    /** Its first point. */
    const Point<3> &
    place_of_cell(const std::size_t cell) const
    {
      const int first = cell == 0 ? 0 : offsets[cell - 1];
      return points[static_cast<std::size_t>(
        connectivity[static_cast<std::size_t>(first)])];
    }

    /** The file, for a time and an increment (its time step). */
    std::string
    text(const double time, const unsigned int increment) const;

    /** Some of the cells, with their points. */
    VtuGrid
    part(const std::vector<unsigned int> &cells) const;

    /** The file that joins those of parts, which are beside it. */
    std::string
    text_of_parts(const std::vector<std::string> &files) const;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &points &point_fields &cell_fields &point_ids &cell_ids &units
        &unit_of_points &connectivity &offsets &shapes;
    }

  private:
    void
    add_vtk_cell(const Shape shape, const int *begin, const int *end);

    std::vector<int>   connectivity, offsets; ///< as VTK has them
    std::vector<Shape> shapes;
  };
} // namespace conetact

#endif
