// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/workers.h"

#include "conetact/base/communicator.h"
#include "conetact/base/process.h"

#include <sys/resource.h>

#include <exception>

namespace conetact::backends
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



  void
  wait_for_orders(const WorkTable &table)
  {
    for (Order order = next_order(); order.command != Command::end;
         order       = next_order())
      table.at(order.command)(order);
  }



  std::vector<double>
  peaks_of_processes()
  {
    const auto   n   = static_cast<int>(ProcessSession::n_processes());
    Communicator all = Communicator::of_first(n);
    rusage       usage;
    getrusage(RUSAGE_SELF, &usage);
    const Eigen::VectorXd peaks = all.gather_all(Eigen::VectorXd(
      Eigen::VectorXd::Constant(1,
                                1024. * static_cast<double>(usage.ru_maxrss))));
    return {peaks.begin(), peaks.end()};
  }
} // namespace conetact::backends
