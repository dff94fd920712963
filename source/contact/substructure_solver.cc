// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/substructure_solver.h"

#include "conetact/contact/interface_sum.h"
#include "conetact/contact/interfaces.h"

#include <algorithm>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using SparseMatrix = Eigen::SparseMatrix<double>;
    using Map          = Substructure::Map;

    std::unique_ptr<SchurSolver>
    condense(const Substructure &part, const InterfaceOrder &order)
    {
      const Substructure matrix = sorted(part, order);
      return std::make_unique<SchurSolver>(matrix.upper,
                                           order.n_interface,
                                           matrix.node_of);
    }

    // T of all uses, from the unknowns (E, C) to those of the interface.
    std::vector<Map>
    interface_maps(const Substructures &substructures,
                   const Interfaces    &interfaces)
    {
      std::vector<Map> maps;
      for (std::size_t k = 0; k < substructures.parts.size(); ++k)
        for (const Map &T : substructures.parts[k].uses)
          maps.push_back(interface_rows(T, interfaces, k));
      return maps;
    }
  } // namespace



  SubstructureSolver::SubstructureSolver(const Substructures &substructures)
    : n(static_cast<Index>(substructures.node_of.size()))
  {
    if (substructures.parts[0].uses.empty())
      {
        parts.push_back(
          {std::make_unique<SchurSolver>(substructures.parts[0].upper,
                                         substructures.n_schur,
                                         substructures.parts[0].node_of),
           {}});
        return;
      }
    const Interfaces interfaces = find_interfaces(substructures);
    n_E                         = interfaces.n_E;
    kept                        = interfaces.kept;
    auto               maps     = interface_maps(substructures, interfaces);
    const InterfaceSum summation(maps);
    SparseMatrix       upper = summation.pattern();
    std::size_t        use   = 0;
    for (std::size_t k = 0; k < substructures.parts.size(); ++k)
      {
        const Substructure &part = substructures.parts[k];
        parts.push_back({condense(part, interfaces.of_part[k]), {}});
        const MatrixXd S = parts[k].solver->take_schur_complement();
        for (const Map &T : part.uses)
          {
            summation.add(use, maps[use], S, upper);
            parts[k].members.push_back(
              {inside_rows(T, interfaces, k), std::move(maps[use++])});
          }
        n_repeated += static_cast<unsigned int>(part.uses.size()) - 1;
      }
    // a class is ordered as one node
    std::vector<unsigned int> nodes;
    for (const Index i : summation.first_of_class())
      nodes.push_back(substructures.node_of[kept[i]]);
    sum = std::make_unique<SchurSolver>(upper, substructures.n_schur, nodes);
  }



  FactorEstimate
  SubstructureSolver::estimate(const Substructures &substructures)
  {
    const auto &all = substructures.parts;
    if (all[0].uses.empty())
      return SchurSolver::estimate(all[0].upper,
                                   substructures.n_schur,
                                   all[0].node_of);
    const auto     orders = find_interfaces(substructures).of_part;
    FactorEstimate result = estimate_sum(substructures);
    for (std::size_t k = 0; k < all.size(); ++k)
      {
        const Substructure part = sorted(all[k], orders[k]);
        result += SchurSolver::estimate(part.upper,
                                        orders[k].n_interface,
                                        part.node_of);
        result.n_shared += static_cast<unsigned int>(all[k].uses.size()) - 1;
      }
    return result;
  }



  FactorEstimate
  SubstructureSolver::estimate_sum(const Substructures &substructures)
  {
    return InterfaceSum(
             interface_maps(substructures, find_interfaces(substructures)))
      .estimate(substructures.n_schur);
  }



  MatrixXd
  SubstructureSolver::take_schur_complement()
  {
    return (is_whole() ? parts[0].solver : sum)->take_schur_complement();
  }



  SubstructureSolver::Columns
  SubstructureSolver::loaded_columns(const Part     &part,
                                     const MatrixXd &b,
                                     const MatrixXd &u)
  {
    const Member &first = part.members[0];
    const Index   most  = static_cast<Index>(part.members.size()) * b.cols();
    Columns       columns;
    columns.loads.resize(first.inside.rows(), most);
    columns.displacements.resize(first.interface.rows(), most);
    Index count = 0;
    for (const Member &member : part.members)
      for (Index k = 0; k < b.cols(); ++k)
        {
          auto load         = columns.loads.col(count);
          auto displacement = columns.displacements.col(count);
          load              = member.inside * b.col(k);
          displacement      = member.interface * u.col(k);
          if (load.isZero(0.) && displacement.isZero(0.))
            continue;
          columns.origin.emplace_back(&member, k);
          ++count;
        }
    columns.loads.conservativeResize(Eigen::NoChange, count);
    columns.displacements.conservativeResize(Eigen::NoChange, count);
    return columns;
  }



  MatrixXd
  SubstructureSolver::condensed_forces(const MatrixXd &b) const
  {
    MatrixXd       f       = b(kept, Eigen::all);
    const MatrixXd at_rest = MatrixXd::Zero(f.rows(), f.cols());
    for (const Part &part : parts)
      {
        const Columns  columns = loaded_columns(part, b, at_rest);
        const MatrixXd reduced = part.solver->reduce(columns.loads);
        for (std::size_t k = 0; k < columns.origin.size(); ++k)
          {
            const auto &[member, column] = columns.origin[k];
            f.col(column) += member->interface.transpose() *
                             reduced.col(static_cast<Index>(k));
          }
      }
    return f;
  }



  MatrixXd
  SubstructureSolver::reduce(const MatrixXd &b) const
  {
    return is_whole() ? parts[0].solver->reduce(b) :
                        sum->reduce(condensed_forces(b));
  }



  MatrixXd
  SubstructureSolver::expand(const MatrixXd &b, const MatrixXd &u_C) const
  {
    if (is_whole())
      return parts[0].solver->expand(b, u_C);
    const MatrixXd u = n_E == 0 ? u_C : sum->expand(condensed_forces(b), u_C);
    MatrixXd       result = MatrixXd::Zero(n, b.cols());
    for (const Part &part : parts)
      {
        const Columns  columns = loaded_columns(part, b, u);
        const MatrixXd expanded =
          part.solver->expand(columns.loads, columns.displacements);
        for (std::size_t k = 0; k < columns.origin.size(); ++k)
          {
            const auto &[member, column] = columns.origin[k];
            result.col(column) +=
              member->inside.transpose() * expanded.col(static_cast<Index>(k));
          }
      }
    result(kept, Eigen::all) = u;
    return result;
  }



  double
  SubstructureSolver::factor_bytes() const
  {
    double bytes = is_whole() ? 0. : sum->factor_bytes();
    for (const Part &part : parts)
      bytes += part.solver->factor_bytes();
    return bytes;
  }



  double
  SubstructureSolver::factor_operations() const
  {
    double operations = is_whole() ? 0. : sum->factor_operations();
    for (const Part &part : parts)
      operations += part.solver->factor_operations();
    return operations;
  }



  SchurWork
  SubstructureSolver::work() const
  {
    SchurWork all;
    for (const Part &part : parts)
      all += part.solver->work();
    return all;
  }
} // namespace conetact
