// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/block_schur.h"

#include <algorithm>
#include <set>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using SparseMatrix = Eigen::SparseMatrix<double>;

    struct Block
    {
      SparseMatrix              upper;
      Index                     n_schur;
      std::vector<unsigned int> node_of;
    };

    // `unknowns`, ascending, are coupled with no others.
    Block
    extract(const SparseMatrix              &upper,
            const Index                      n_schur,
            const std::vector<unsigned int> &node_of,
            const std::vector<Index>        &unknowns)
    {
      const auto         n = static_cast<Index>(unknowns.size());
      std::vector<Index> place(node_of.size());
      Block              block{SparseMatrix(n, n), 0, {}};
      for (Index k = 0; k < n; ++k)
        {
          const Index i = unknowns[k];
          place[i]      = k;
          block.n_schur += i >= upper.cols() - n_schur;
          block.node_of.push_back(node_of[i]);
          block.upper.startVec(k);
          for (SparseMatrix::InnerIterator entry(upper, i); entry; ++entry)
            block.upper.insertBackByOuterInnerUnordered(k, place[entry.row()]) =
              entry.value();
        }
      block.upper.finalize();
      return block;
    }

    unsigned int
    count_bodies(const std::vector<Index>        &unknowns,
                 const std::vector<unsigned int> &body_of)
    {
      std::set<unsigned int> bodies;
      for (const Index i : unknowns)
        bodies.insert(body_of[i]);
      return static_cast<unsigned int>(bodies.size());
    }
  } // namespace



  BlockSchurSolver::BlockSchurSolver(const SparseMatrix              &upper,
                                     const Index                      n_last,
                                     const std::vector<unsigned int> &node_of,
                                     const std::vector<unsigned int> &body_of)
    : n(upper.cols())
    , n_schur(n_last)
  {
    const auto groups = find_equal_blocks(upper, n_schur, body_of);
    if (groups.empty())
      parts.push_back(
        {std::make_unique<SchurSolver>(upper, n_schur, node_of), {}});
    for (const EqualBlocks &blocks : groups)
      append(upper, node_of, blocks);

    n_all_bodies = static_cast<unsigned int>(
      std::set<unsigned int>(body_of.begin(), body_of.end()).size());
    for (const EqualBlocks &blocks : groups)
      for (std::size_t k = 1; k < blocks.size(); ++k)
        n_shared += count_bodies(blocks[k], body_of);
  }



  void
  BlockSchurSolver::append(const SparseMatrix              &upper,
                           const std::vector<unsigned int> &node_of,
                           const EqualBlocks               &blocks)
  {
    const Block block = extract(upper, n_schur, node_of, blocks[0]);
    Part        part;
    part.solver =
      std::make_unique<SchurSolver>(block.upper, block.n_schur, block.node_of);
    for (const std::vector<Index> &unknowns : blocks)
      {
        Member member{unknowns, {}};
        for (auto i = unknowns.end() - block.n_schur; i != unknowns.end(); ++i)
          member.schur.push_back(*i - (n - n_schur));
        part.members.push_back(std::move(member));
      }
    parts.push_back(std::move(part));
  }



  FactorEstimate
  BlockSchurSolver::estimate(const SparseMatrix              &upper,
                             const Index                      n_schur,
                             const std::vector<unsigned int> &node_of,
                             const std::vector<unsigned int> &body_of)
  {
    const auto groups = find_equal_blocks(upper, n_schur, body_of);
    if (groups.empty())
      return SchurSolver::estimate(upper, n_schur, node_of);
    FactorEstimate sum;
    for (const EqualBlocks &blocks : groups)
      {
        const Block block = extract(upper, n_schur, node_of, blocks[0]);
        const auto  part =
          SchurSolver::estimate(block.upper, block.n_schur, block.node_of);
        sum.factor_bytes += part.factor_bytes;
        sum.working_bytes += part.working_bytes;
        sum.flops += part.flops;
      }
    return sum;
  }



  MatrixXd
  BlockSchurSolver::take_schur_complement()
  {
    if (parts[0].members.empty())
      return parts[0].solver->take_schur_complement();
    MatrixXd S = MatrixXd::Zero(n_schur, n_schur);
    for (const Part &part : parts)
      {
        const MatrixXd S_part = part.solver->take_schur_complement();
        for (const Member &member : part.members)
          S(member.schur, member.schur) = S_part;
      }
    return S;
  }



  std::vector<BlockSchurSolver::Column>
  BlockSchurSolver::loaded_columns(const Part     &part,
                                   const MatrixXd &b,
                                   const MatrixXd &u_C)
  {
    std::vector<Column> columns;
    for (const Member &member : part.members)
      for (Index k = 0; k < b.cols(); ++k)
        if ((b(member.unknowns, k).array() != 0).any() ||
            (u_C(member.schur, k).array() != 0).any())
          columns.push_back({&member, k});
    return columns;
  }



  MatrixXd
  BlockSchurSolver::reduce(const MatrixXd &b) const
  {
    if (parts[0].members.empty())
      return parts[0].solver->reduce(b);
    MatrixXd result = MatrixXd::Zero(n_schur, b.cols());
    for (const Part &part : parts)
      {
        // no displacements: as yet the rows of this part are zero
        const auto  columns   = loaded_columns(part, b, result);
        const Index n_columns = static_cast<Index>(columns.size());
        MatrixXd    loads(part.members[0].unknowns.size(), n_columns);
        for (Index k = 0; k < n_columns; ++k)
          loads.col(k) = b(columns[k].member->unknowns, columns[k].column);
        const MatrixXd reduced = part.solver->reduce(loads);
        for (Index k = 0; k < n_columns; ++k)
          result(columns[k].member->schur, columns[k].column) = reduced.col(k);
      }
    return result;
  }



  MatrixXd
  BlockSchurSolver::expand(const MatrixXd &b, const MatrixXd &u_C) const
  {
    if (parts[0].members.empty())
      return parts[0].solver->expand(b, u_C);
    MatrixXd u = MatrixXd::Zero(n, b.cols());
    for (const Part &part : parts)
      {
        const auto  columns   = loaded_columns(part, b, u_C);
        const Index n_columns = static_cast<Index>(columns.size());
        MatrixXd    loads(part.members[0].unknowns.size(), n_columns);
        MatrixXd    contact(part.members[0].schur.size(), n_columns);
        for (Index k = 0; k < n_columns; ++k)
          {
            const auto &[member, column] = columns[k];
            loads.col(k)                 = b(member->unknowns, column);
            contact.col(k)               = u_C(member->schur, column);
          }
        const MatrixXd expanded = part.solver->expand(loads, contact);
        for (Index k = 0; k < n_columns; ++k)
          u(columns[k].member->unknowns, columns[k].column) = expanded.col(k);
      }
    return u;
  }



  double
  BlockSchurSolver::factor_bytes() const
  {
    double sum = 0;
    for (const Part &part : parts)
      sum += part.solver->factor_bytes();
    return sum;
  }



  double
  BlockSchurSolver::factor_operations() const
  {
    double sum = 0;
    for (const Part &part : parts)
      sum += part.solver->factor_operations();
    return sum;
  }



  SchurWork
  BlockSchurSolver::work() const
  {
    SchurWork sum;
    for (const Part &part : parts)
      sum += part.solver->work();
    return sum;
  }
} // namespace conetact
