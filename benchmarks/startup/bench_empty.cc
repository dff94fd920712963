// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The least that a program linked to deal.II does: one entry declared and read,
// no MPI.

#include <deal.II/base/parameter_handler.h>

int
main()
{
  dealii::ParameterHandler prm;
  prm.declare_entry("Entry", "1");
  return prm.get_integer("Entry") == 1 ? 0 : 1;
}
