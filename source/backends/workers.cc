// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/workers.h"

#include "conetact/base/communicator.h"
#include "conetact/base/process.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>

namespace conetact::backends
{
  namespace
  {
    bool left_alone = false;

    // Who waits looks again at once, then after an eighth of the time it has
    // waited: a core that the first process may need is idle.
    constexpr std::chrono::microseconds at_once{300}, longest_sleep{2000};

    void
    wait_asleep(MPI_Request &request)
    {
      using Clock      = std::chrono::steady_clock;
      const auto start = Clock::now();
      for (int done = 0;;)
        {
          MPI_Test(&request, &done, MPI_STATUS_IGNORE);
          if (done != 0)
            return;
          const auto waited =
            std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() -
                                                                  start);
          if (waited < at_once)
            std::this_thread::yield();
          else
            std::this_thread::sleep_for(std::min(waited / 8, longest_sleep));
        }
    }

    Order
    next_order()
    {
      Order       order;
      MPI_Request request;
      MPI_Ibcast(&order, sizeof(order), MPI_BYTE, 0, MPI_COMM_WORLD, &request);
      wait_asleep(request);
      return order;
    }
  } // namespace



  Together::Together(const Order &order)
    : exceptions(std::uncaught_exceptions())
  {
    Order       sent = order;
    MPI_Request request;
    MPI_Ibcast(&sent, sizeof(sent), MPI_BYTE, 0, MPI_COMM_WORLD, &request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
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
