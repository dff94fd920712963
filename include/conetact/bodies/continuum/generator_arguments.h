// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_generator_arguments_h
#define conetact_bodies_continuum_generator_arguments_h

#include "conetact/bodies/continuum/mesh_parameters.h"

namespace conetact::bodies
{
  /**
   * deal.II's mesh generators check their arguments in debug mode only; without
   * it a list of the wrong length, a radius of zero or a billion cells crash
   * the program. This checks what the entry Arguments holds before they are
   * called: every number is finite, numbers of cells are whole, lists have the
   * length that the generator expects, and the mesh has room in the memory.
   * The number and the form of arguments are left to deal.II. Throws
   * InputError.
   */
  void
  check_generator_arguments(const MeshParameters &parameters,
                            const unsigned int    dim);

  /**
   * Makes a block of many cells, whose arguments are right, one of fewer cells
   * that are refined: one cell refined six times is the 64 x 64 x 64
   * that were asked for, and deal.II makes them in a third of the time.
   */
  void
  refine_instead(MeshParameters &mesh, const unsigned int dim);

  /** "Did you mean 'hyper_cube'? ", or nothing. */
  std::string
  generator_hint(const std::string &name);

  /**
   * Throws InputError where a mesh of so many cells has no room in the memory.
   * `entry` is what makes it so large: "Global refinements".
   */
  void
  check_mesh_size(const MeshParameters &parameters,
                  const unsigned int    dim,
                  const double          n_cells,
                  const std::string    &entry);
} // namespace conetact::bodies

#endif
