// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_grid_messages_h
#define conetact_bodies_continuum_grid_messages_h

#include <exception>
#include <string>

namespace conetact::bodies
{
  /** "hexahedra" or "tetrahedra". */
  std::string
  cell_name(const unsigned int dim, const bool simplices);

  /** What deal.II has to say: one line, without banner and bounds. */
  std::string
  message_of(const std::exception &error);
} // namespace conetact::bodies

#endif
