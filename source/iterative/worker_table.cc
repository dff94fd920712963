// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/vtu_pieces.h"
#include "conetact/base/workers.h"
#include "conetact/condensed/mumps.h"
#include "conetact/iterative/large_stiffness.h"

namespace conetact
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
    iterative::SystemParts parts;
    condensed::MumpsParts  solvers;
    const auto go_along = [&](const Order &o) { parts.go_along(o); };
    wait_for_orders({
      {Command::make_plane, [&](const Order &o) { parts.make(o, 2); }},
      {Command::make_space, [&](const Order &o) { parts.make(o, 3); }},
      {Command::keep, go_along},
      {Command::numbers, go_along},
      {Command::of_contact, go_along},
      {Command::add, go_along},
      {Command::product_elsewhere, go_along},
      {Command::multiply, go_along},
      {Command::diagonal, go_along},
      {Command::solve, go_along},
      {Command::forget_vector, go_along},
      {Command::forget, [&](const Order &o) { parts.forget(o); }},
      {Command::make_mumps, [&](const Order &o) { solvers.make(o); }},
      {Command::call_mumps, [&](const Order &o) { solvers.call(o); }},
      {Command::draw, &draw_piece},
      {Command::report, [](const Order &) { needs_of_processes(); }},
    });
  }
} // namespace conetact
