// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/large_stiffness.h"
#include "conetact/backends/mumps.h"
#include "conetact/backends/workers.h"
#include "conetact/base/vtu_pieces.h"

namespace conetact::backends
{
  namespace
  {
    void
    draw_piece(const Order &order)
    {
      const auto processes = Communicator::of_first(order.value);
      if (processes.is_member())
        write_own_piece(processes);
    }
  } // namespace



  void
  work()
  {
    SystemParts parts;
    MumpsParts  solvers;
    wait_for_orders({
      {Command::make_plane, [&](const Order &o) { parts.make(o, 2); }},
      {Command::make_space, [&](const Order &o) { parts.make(o, 3); }},
      {Command::multiply, [&](const Order &o) { parts.multiply(o); }},
      {Command::diagonal, [&](const Order &o) { parts.diagonal(o); }},
      {Command::solve, [&](const Order &o) { parts.solve(o); }},
      {Command::forget, [&](const Order &o) { parts.forget(o); }},
      {Command::make_mumps, [&](const Order &o) { solvers.make(o); }},
      {Command::call_mumps, [&](const Order &o) { solvers.call(o); }},
      {Command::draw, &draw_piece},
      {Command::report, [](const Order &) { needs_of_processes(); }},
    });
  }
} // namespace conetact::backends
