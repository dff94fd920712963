// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_large_stiffness_h
#define conetact_iterative_large_stiffness_h

#include "conetact/iterative/elements.h"
#include "conetact/iterative/preconditioner.h"
#include "conetact/solvers/contact_problem.h"
#include "conetact/solvers/large_system.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace conetact::iterative
{
  /** What a LargeSystem is made of. */
  struct LargeStiffness
  {
    Elements                  elements; ///< of K
    std::vector<unsigned int> node_of;  ///< of each unknown, any numbers
    solvers::ContactSystem    contact;  ///< layout of the last unknowns
    /** Rigid motions, each of all unknowns: made one by one, as there is no
     * need for the memory of all of them. */
    std::vector<std::function<Eigen::VectorXd()>> modes;
    /** Nodes that are solved for together: see SurfaceSmoother. */
    std::set<unsigned int> surface;
    /** Nodes of coarse levels have those of one side; less than 0: a node with
     * one unknown that many see, by itself on each level. Empty: all on one. */
    std::map<unsigned int, int> side;
    /** Of a node, to share nodes among processes. */
    std::function<std::array<double, 3>(const unsigned int node)> position;
    /** Any but the first is of one process. */
    Preconditioner preconditioner = Preconditioner::aggregation;
  };

  /**
   * Solves the linear systems of Newton's method by GMRES (Saad, SIAM J. Sci.
   * Comput. 14 (1993) 461-469, with a preconditioner that may vary). Unknowns
   * that a law determines by itself (closed gaps, stuck slips) are eliminated,
   * slipping and open nodes have rows
   * @f$(K\,\delta u)_i + S_i\,\delta u_i + q_i (K\,\delta u)_n = h_i@f$.
   *
   * The preconditioner is one cycle of multigrid in single precision. Maps
   * between its levels are made once, as if nothing touched; what the state of
   * contacts changes of the matrix is projected to all levels in each step, at
   * the cost of a surface (ContactChange), so that iterations depend neither on
   * the state nor on the mesh. Its smoother, Chebyshev's method on the blocks
   * of nodes, leaves out what is held and knows S. Nodes have `dim` unknowns at
   * most, 2 or 3.
   *
   * Of many processes, which all call this and all functions of the system,
   * each has the rows and vectors of its nodes; what is given, and what comes
   * out of the system, is the same on each. A small system is each process's
   * own.
   */
  std::shared_ptr<const solvers::LargeSystem>
  make_large_system(LargeStiffness &&given, const unsigned int dim);

  /** Processes of this run that share a system of so many unknowns. */
  int
  useful_processes(const Eigen::Index n_unknowns);
} // namespace conetact::iterative

#endif
