// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/generator_table.h"

#include <algorithm>
#include <cmath>

namespace conetact::bodies
{
  namespace
  {
    double
    few(const Numbers &, const unsigned int)
    {
      return 100;
    }

    /** Cells around a ring if no number is given: as wide as it is thick. */
    double
    around(const double given, const double inner, const double outer)
    {
      return given > 0 ? given :
                         std::ceil(M_PI * (outer + inner) / (outer - inner));
    }

    std::vector<GeneratorRow>
    straight_meshes()
    {
      using A = const Numbers &;
      using D = const unsigned int;
      return {{"hyper_cube", "xxb", 0, 1, few},
              {"subdivided_hyper_cube",
               "nxxb",
               1,
               2,
               [](A a, D dim) { return std::pow(a[0][0], dim); }},
              {"hyper_rectangle", "ppb", -1, -1, few},
              {"subdivided_hyper_rectangle",
               "sppb",
               -1,
               -1,
               [](A a, D) { return product(a[0]); }},
              {"subdivided_hyper_cube_with_simplices",
               "nxxb",
               1,
               2,
               [](A a, D dim) {
                 return (dim == 2 ? 2 : 5) * std::pow(a[0][0], dim);
               }},
              {"subdivided_hyper_rectangle_with_simplices",
               "cppb",
               -1,
               -1,
               [](A a, D dim) { return (dim == 2 ? 2 : 5) * product(a[0]); }},
              {"cheese",
               "c",
               -1,
               -1,
               [](A a, D) {
                 double n = 1;
                 for (const double holes : a[0])
                   n *= 2 * holes + 1;
                 return n;
               }},
              {"general_cell", "Vb", -1, -1, few},
              {"hyper_cross",
               "Cb",
               -1,
               -1,
               [](A a, D) {
                 double n = 1;
                 for (const double arm : a[0])
                   n += arm;
                 return n;
               }},
              {"simplex", "S", -1, -1, few},
              {"enclosed_hyper_cube", "xxrb", 0, 1, few},
              {"hyper_L", "xxb", 0, 1, few},
              {"hyper_cube_slit", "xxb", 0, 1, few}};
    }

    std::vector<GeneratorRow>
    round_meshes()
    {
      using A = const Numbers &;
      using D = const unsigned int;
      return {{"plate_with_a_hole",
               "rrzzzzpiirnb",
               0,
               1,
               [](A a, D dim) {
                 const auto pads = [&](const std::size_t i,
                                       const std::size_t k) {
                   return 4 + (a[i][0] + a[k][0]) / a[1][0];
                 };
                 return pads(2, 3) * pads(4, 5) * (dim == 3 ? a[10][0] : 1);
               }},
              {"channel_with_cylinder",
               "rnzb",
               -1,
               -1,
               [](A a, D dim) { return (dim == 3 ? 40 : 8) * (50 + a[1][0]); }},
              {"hyper_ball", "prb", -1, -1, few},
              {"quarter_hyper_ball", "pr", -1, -1, few},
              {"half_hyper_ball", "pr", -1, -1, few},
              {"cylinder", "rr", -1, -1, few},
              {"truncated_cone", "rrr", -1, -1, [](A a, D) {
                 return 1 + a[2][0] / std::max(a[0][0], a[1][0]);
               }}};
    }

    std::vector<GeneratorRow>
    shells_and_rings()
    {
      using A = const Numbers &;
      using D = const unsigned int;
      return {{"hyper_shell",
               "prrdb",
               1,
               2,
               [](A a, D dim) {
                 return dim == 3 ? std::max(100., a[3][0]) :
                                   around(a[3][0], a[1][0], a[2][0]);
               }},
              {"half_hyper_shell",
               "pzrdb",
               1,
               2,
               [](A a, D) { return around(a[3][0], a[1][0], a[2][0]); }},
              {"quarter_hyper_shell",
               "pzrdb",
               1,
               2,
               [](A a, D) { return around(a[3][0], a[1][0], a[2][0]); }},
              {"cylinder_shell",
               "rrrdd",
               1,
               2,
               [](A a, D) {
                 const double ring   = around(a[3][0], a[1][0], a[2][0]);
                 const double length = M_PI * (a[1][0] + a[2][0]) / ring;
                 return ring * (a[4][0] > 0 ? a[4][0] : 1 + a[0][0] / length);
               }},
              {"hyper_cube_with_cylindrical_hole",
               "rrrnb",
               0,
               1,
               [](A a, D dim) { return 8 * (dim == 3 ? a[3][0] : 1); }},
              {"concentric_hyper_shells",
               "prrnzdb",
               1,
               2,
               [](A a, D dim) {
                 return a[3][0] * (dim == 3 ?
                                     std::max(100., a[5][0]) :
                                     around(a[5][0], a[1][0], a[2][0]));
               }},
              {"moebius", "nxrr", 3, 2, [](A a, D) { return a[0][0]; }},
              {"torus", "rrnr", 1, 0, [](A a, D) { return 5 * a[2][0]; }}};
    }
  } // namespace



  const std::vector<GeneratorRow> &
  generator_table()
  {
    static const std::vector<GeneratorRow> table = [] {
      std::vector<GeneratorRow> rows;
      for (const auto &some :
           {straight_meshes(), round_meshes(), shells_and_rings()})
        rows.insert(rows.end(), some.begin(), some.end());
      return rows;
    }();
    return table;
  }



  double
  product(const std::vector<double> &factors)
  {
    double n = 1;
    for (const double factor : factors)
      n *= factor;
    return n;
  }
} // namespace conetact::bodies
