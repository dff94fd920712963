// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_generator_table_h
#define conetact_bodies_continuum_generator_table_h

#include <vector>

namespace conetact::bodies
{
  using Numbers = std::vector<std::vector<double>>; ///< of each argument

  /** How a generator's arguments are read, and how many cells it makes. */
  struct GeneratorRow
  {
    const char *name;
    /**
     * A letter for each argument: x any number, r a positive one, z one that
     * is not negative, n number of cells, d the same with 0 for a default, i
     * id, p point, b true or false; lists: c of `dim` numbers of cells, C of
     * 2 dim of them (0 allowed), s cells or steps, S corners of a simplex, V
     * of a cell.
     */
    const char *kinds;
    int         smaller, larger; ///< arguments that must differ; -1: none
    double (*n_cells)(const Numbers &a, const unsigned int dim);
  };

  /** All meshes of deal.II that a scene may name. */
  const std::vector<GeneratorRow> &
  generator_table();

  double
  product(const std::vector<double> &factors);
} // namespace conetact::bodies

#endif
