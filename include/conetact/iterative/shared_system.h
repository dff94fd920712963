// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_shared_system_h
#define conetact_iterative_shared_system_h

#include "conetact/base/communicator.h"
#include "conetact/iterative/elements.h"
#include "conetact/iterative/preconditioner.h"
#include "conetact/solvers/large_system.h"

#include <memory>
#include <optional>
#include <vector>

namespace conetact::iterative
{
  /** What the first process has of a system before others get their shares. */
  struct WholeSystem
  {
    Elements elements; ///< of K
    /** Of each unknown, node by node; process p has those from first[p] on. */
    std::vector<int> places;
    std::vector<int> first;
    Eigen::MatrixXd  modes; ///< in these places
    /** Places of the unknowns of contact nodes. */
    std::vector<std::vector<int>> contact;
    /** Places of nodes that are smoothed together. */
    std::vector<int> surface;
    Preconditioner   preconditioner = Preconditioner::aggregation;
    /** Of each place that of its node, see aggregates(); empty: all on one. */
    Eigen::VectorXd side;
  };

  /**
   * A BlockSystem and vectors of it that are kept: numbers name them, of which
   * each process has its places. All processes call the same functions; Arrays
   * that others than the first one give and get are empty.
   */
  class SharedSystem
  {
  public:
    using Array     = Eigen::VectorXd;
    using Precision = solvers::LargeSystem::Precision;

    virtual ~SharedSystem() = default;
    virtual void
    keep(Array x, const int to) = 0;
    virtual Array
    numbers(const int x) const = 0;
    virtual Array
    of_contact(const int x) const = 0;
    virtual void
    add(const int x, double factor, const int y, const int to) = 0;
    virtual double
    product_elsewhere(const int x, const int y) const = 0;
    virtual void
    multiply(const int x, const int to) = 0;
    virtual void
    forget(const int x) = 0;
    virtual Array
    diagonal() const = 0;
    /** What was found; nothing if it is not finite. */
    struct Found
    {
      unsigned int iterations = 0;
      double       error      = 0;
    };
    virtual std::optional<Found>
    solve(const std::vector<solvers::NodeLaw> &laws,
          const int                            f,
          const Precision                     &precision,
          const int                            to) = 0;
  };

  /** The other processes give nothing: an empty system. */
  std::unique_ptr<SharedSystem>
  share_system(WholeSystem       &&whole,
               const unsigned int  dim,
               const Communicator &processes);
} // namespace conetact::iterative

#endif
