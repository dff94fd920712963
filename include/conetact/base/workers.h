// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_workers_h
#define conetact_base_workers_h

#include <Eigen/Core>

#include <functional>
#include <map>
#include <vector>

namespace conetact
{
  /**
   * What the processes of a run do together. The first one runs the program;
   * all others wait for what it asks for: a row of a table.
   */
  enum class Command : int
  {
    make_plane, ///< a large system with nodes of 2 unknowns,
    make_space, ///< 3 unknowns, by `value` processes
    keep,       ///< vectors of it, and what LargeSystem does with them
    numbers,
    of_contact,
    add,
    product_elsewhere,
    multiply,
    diagonal,
    solve,
    forget_vector,
    forget,     ///< the system
    make_mumps, ///< an instance of `value` processes
    call_mumps, ///< its job `value`
    draw,       ///< a picture in `value` pieces
    report,     ///< what they have needed
    end
  };

  /** A command, which system it is about, and a number. */
  struct Order
  {
    Command command = Command::end;
    int     number  = 0;
    int     value   = 0;
    int     to = 0, x = 0, y = 0; ///< vectors of the system
    double  factor = 0;
  };

  /**
   * On the first process: sends an order to all others, which go about it.
   * Whoever leaves its scope by an exception has left the others alone; nothing
   * can be asked of them any more.
   */
  class Together
  {
  public:
    explicit Together(const Order &order);
    ~Together();
    Together(const Together &) = delete;
    Together &
    operator=(const Together &) = delete;

    /** Whether others still do what they are asked for. */
    static bool
    is_possible();

  private:
    int exceptions;
  };

  /** Processes that share so many unknowns: each has `fewest` at least. */
  int
  processes_for(const Eigen::Index n_unknowns, const Eigen::Index fewest);

  using WorkTable = std::map<Command, std::function<void(const Order &)>>;

  /**
   * On all processes but the first: does what it asks for until it ends, and
   * sleeps where it asks for nothing.
   */
  void
  wait_for_orders(const WorkTable &table);

  /** That with the table of all there is (worker_table.cc). */
  void
  work();

  /** What a process has needed so far. */
  struct Needs
  {
    double peak_memory = 0; ///< [bytes]
    double cpu_seconds = 0;
  };
  /** Of each process; the first one asks. */
  std::vector<Needs>
  needs_of_processes();
} // namespace conetact

#endif
