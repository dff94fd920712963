// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_shared_system_h
#define conetact_backends_shared_system_h

#include "conetact/backends/elements.h"
#include "conetact/base/communicator.h"
#include "conetact/solvers/large_system.h"

#include <memory>
#include <vector>

namespace conetact::backends
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
  };

  /**
   * A BlockSystem whose vectors are those of all places on the first process.
   * All processes call the same functions; what others give and get is empty.
   */
  class SharedSystem
  {
  public:
    using Array     = Eigen::VectorXd;
    using Step      = solvers::LargeSystem::Step;
    using Precision = solvers::LargeSystem::Precision;

    virtual ~SharedSystem() = default;
    virtual Array
    multiply(Array x) const = 0;
    virtual Array
    diagonal() const = 0;
    virtual Step
    solve(const std::vector<solvers::NodeLaw> &laws,
          Array                                f,
          const Precision                     &precision) const = 0;
  };

  /** The other processes give nothing: an empty system. */
  std::unique_ptr<SharedSystem>
  share_system(WholeSystem       &&whole,
               const unsigned int  dim,
               const Communicator &processes);
} // namespace conetact::backends

#endif
