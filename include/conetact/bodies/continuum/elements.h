// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_elements_h
#define conetact_bodies_continuum_elements_h

#include "conetact/bodies/continuum/element_formulation.h"

#include <memory>
#include <vector>

namespace conetact::bodies
{
  /** One row for each kind of element. */
  template <int dim>
  struct ElementRow
  {
    const char *name;
    bool        is_simplex; ///< of triangles and tetrahedra
    const char *description;
    std::unique_ptr<ElementFormulation<dim>> (*create)(const ElasticMaterial &);
    bool         goes_round = true; ///< also for bodies of revolution
    unsigned int degree     = 1;    ///< of displacements
  };
  /** A material, and how cells that are made of it strain. */
  template <int dim>
  struct Phase
  {
    ElasticMaterial                          material;
    std::unique_ptr<ElementFormulation<dim>> element;
  };
  template <int dim>
  using Phases = std::vector<Phase<dim>>;

  template <int dim>
  const std::vector<ElementRow<dim>> &
  element_table();
  /** The first row for such cells and displacements. */
  template <int dim>
  const ElementRow<dim> &
  default_element(const bool simplices, const unsigned int degree);
} // namespace conetact::bodies

#endif
