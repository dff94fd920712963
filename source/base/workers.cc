// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/workers.h"

#include "conetact/base/communicator.h"
#include "conetact/base/process.h"

#include <deal.II/base/exceptions.h>

#include <sys/resource.h>

#include <algorithm>
#include <exception>

namespace conetact
{
  namespace
  {
    bool left_alone = false;

    /* All processes are asked by the same call. */
    void
    broadcast(Order &order)
    {
      std::vector<MPI_Request> request(1);
      MPI_Ibcast(
        &order, sizeof(order), MPI_BYTE, 0, MPI_COMM_WORLD, &request[0]);
      Communicator::wait(request);
    }

    Order
    next_order()
    {
      Order order;
      broadcast(order);
      return order;
    }
  } // namespace



  Together::Together(const Order &order)
    : exceptions(std::uncaught_exceptions())
  {
    Order sent = order;
    broadcast(sent);
  }



  Together::~Together()
  {
    if (std::uncaught_exceptions() > exceptions)
      left_alone = true;
  }



  bool
  Together::is_possible()
  {
    return ProcessSession::n_processes() > 1 && !left_alone;
  }



  int
  processes_for(const Eigen::Index n_unknowns, const Eigen::Index fewest)
  {
    Assert(fewest > 0, dealii::ExcMessage("A process is worth some unknowns."));
    if (!Together::is_possible())
      return 1;
    return static_cast<int>(std::clamp<Eigen::Index>(
      n_unknowns / fewest,
      1,
      static_cast<Eigen::Index>(ProcessSession::n_processes())));
  }



  void
  wait_for_orders(const WorkTable &table)
  {
    for (Order order = next_order(); order.command != Command::end;
         order       = next_order())
      table.at(order.command)(order);
  }



  std::vector<Needs>
  needs_of_processes()
  {
    const auto n   = static_cast<int>(ProcessSession::n_processes());
    const auto all = Communicator::of_first(n);
    rusage     usage;
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval &t) {
      return static_cast<double>(t.tv_sec) +
             1e-6 * static_cast<double>(t.tv_usec);
    };
    Eigen::VectorXd own(2);
    own << 1024. * static_cast<double>(usage.ru_maxrss),
      seconds(usage.ru_utime) + seconds(usage.ru_stime);
    const Eigen::VectorXd found = all.gather_all(own);
    std::vector<Needs>    needs;
    for (Eigen::Index p = 0; p < n; ++p)
      needs.push_back({found(2 * p), found(2 * p + 1)});
    return needs;
  }
} // namespace conetact
