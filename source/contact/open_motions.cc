// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/open_motions.h"

#include "conetact/solvers/unloaded.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** A reaction below this part of the largest force is rounding, and presses
     * nothing. */
    constexpr double nothing = 1e-12;

    /** Friction that is closer to its limit than this part of it is at the
     * limit. */
    constexpr double at_limit = 1e-9;

    /** A motion below this part of the way is rounding. */
    constexpr double way_rounding = 1e-12;

    MatrixXd
    stacked(const std::vector<Eigen::RowVectorXd> &rows, const Index n_columns)
    {
      MatrixXd result(static_cast<Index>(rows.size()), n_columns);
      for (std::size_t i = 0; i < rows.size(); ++i)
        result.row(static_cast<Index>(i)) = rows[i];
      return result;
    }

    /**
     * An orthonormal basis of what rows do not see. Squares of rows are small
     * and cheap, but know singular values to the root of rounding only: they
     * choose what may be unseen (`nearly`), and the rows themselves tell of
     * that what it is (`zero`). Both are over the largest singular value, 1 at
     * least.
     */
    MatrixXd
    null_of(const MatrixXd &rows)
    {
      constexpr double zero = 1e-9, nearly = 1e-3;
      if (rows.cols() == 0 || rows.rows() == 0)
        return MatrixXd::Identity(rows.cols(), rows.cols());
      const Eigen::SelfAdjointEigenSolver<MatrixXd> squares(rows.transpose() *
                                                            rows);
      const VectorXd &values = squares.eigenvalues();
      const double    most   = std::max(1., std::sqrt(values.maxCoeff()));
      const Index    n = (values.array() <= std::pow(nearly * most, 2)).count();
      const MatrixXd near = squares.eigenvectors().leftCols(n);
      if (n == 0)
        return near;
      MatrixXd seen             = MatrixXd::Zero(std::max(rows.rows(), n), n);
      seen.topRows(rows.rows()) = rows * near;
      const Eigen::JacobiSVD<MatrixXd> svd(seen, Eigen::ComputeFullV);
      const Index n_seen = (svd.singularValues().array() > zero * most).count();
      return near * svd.matrixV().rightCols(n - n_seen);
    }
  } // namespace

  namespace
  {
    /** Whether friction or a layer of a candidate depends on how far it slips:
     * that way is no open one. */
    bool
    depends_on_slip(const solvers::NodalLaws &laws,
                    const Index               i,
                    const double              r_n,
                    const double              slip)
    {
      const double s = r_n + laws.bond(i, slip, 0).value;
      return laws.limit(i, s, slip, 0).by_slip != 0 ||
             laws.layer(i, r_n, slip).by_slip != 0;
    }
  } // namespace

  bool
  carries_nothing(const double reaction, const double largest_force)
  {
    Assert(largest_force >= 0,
           dealii::ExcMessage("The largest force is an amount."));
    return std::abs(reaction) <= nothing * largest_force;
  }

  bool
  is_at_limit(const VectorXd &friction, const double largest_friction)
  {
    return friction.norm() >= (1 - at_limit) * largest_friction;
  }

  /* Rows G of contacts that press, and of tangents that stick, must not move
     (`opposed`): open motions are their null space. Others may become larger,
     and smaller by the room that they have (`bounded`): gaps, and slips along
     their directions. */
  OpenMotions::OpenMotions(const RigidMotions          &m,
                           const ContactPoints         &points,
                           const solvers::ContactState &state,
                           const double                 largest_force,
                           const solvers::NodalLaws    *laws)
    : motions(m)
  {
    if (motions.unresisted().cols() == 0)
      return;
    const MatrixXd                  seen = motions.null_space();
    std::vector<Eigen::RowVectorXd> opposed, bounded;
    std::vector<double>             rooms;
    const auto bound = [&](const Eigen::RowVectorXd &row, const double r) {
      bounded.push_back(row);
      rooms.push_back(std::max(0., r));
    };
    for (Index i = 0; i < points.layout().n_nodes(); ++i)
      {
        const Index first = points[i].first, n = points[i].normal();
        if (laws != nullptr && laws->is_apart(i))
          continue;
        if (laws != nullptr && laws->is_joined(i))
          {
            for (Index k = first; k <= n; ++k)
              opposed.push_back(seen.row(k));
            continue;
          }
        if (carries_nothing(state.r[n], largest_force))
          {
            const double set = // of what stays compressed
              laws != nullptr ? laws->layer(i, 0, 0).closing : 0.;
            bound(seen.row(n), state.v[n] + set);
            continue;
          }
        opposed.push_back(seen.row(n));
        const bool bonded = points[i].node->bond != nullptr;
        // Without friction the tangents are free: nothing opposes a slip.
        if (points[i].mu == 0 && !bonded)
          continue;
        // The slip may become longer or shorter along its direction, not turn:
        // that would turn friction. What sticks may slip at its limit.
        const VectorXd friction = -state.r.segment(first, n - first);
        const bool     slips =
          !carries_nothing(friction.norm(), largest_force) &&
          (state.node[static_cast<std::size_t>(i)] ==
             solvers::NodeState::slip ||
           // Limits with cohesion are known to the solver alone.
           (!bonded && is_at_limit(friction, points[i].mu * state.r[n])));
        const VectorXd along = friction.normalized();
        const VectorXd slip  = state.v.segment(first, n - first);
        const bool     is_free =
          slips && !(laws != nullptr &&
                     depends_on_slip(*laws, i, state.r[n], slip.norm()));
        if (is_free)
          bound(along.transpose() * seen.middleRows(first, n - first),
                along.dot(slip));
        for (Index k = first; k < n && !is_free; ++k)
          opposed.push_back(seen.row(k));
        if (is_free && n - first == 2)
          opposed.push_back(along[0] * seen.row(first + 1) -
                            along[1] * seen.row(first));
      }
    open = motions.unresisted() * null_of(stacked(opposed, seen.cols()));
    if (!exist())
      return;
    // Orthonormal in the products P of motions with each other, open^T P open =
    // 1: shortest amounts are shortest ways.
    const Eigen::SelfAdjointEigenSolver<MatrixXd> squares(
      open.transpose() * motions.products_of_free() * open);
    open *= squares.operatorInverseSqrt();
    rows =
      stacked(bounded, seen.cols()) * motions.unresisted().transpose() * open;
    room = Eigen::Map<VectorXd>(rooms.data(), rows.rows());
    // Rooms are differences of positions, and these are known to the rounding
    // of what has moved and of the size of bodies.
    touching =
      1e-10 * solvers::largest(state.v) + 1e-13 * motions.largest_size();
  }

  /* Looks for a way y with rows y >= 0 where there is no room. Such ways make a
     cone: if there is any but 0, there is one with a component of 1 or -1 at
     least, which makes y_j >= 1 or -y_j >= 1 one more row. */
  VectorXd
  OpenMotions::elsewhere() const
  {
    std::vector<Eigen::RowVectorXd> in_the_way;
    for (Index i = 0; i < room.size(); ++i)
      if (room[i] <= touching)
        in_the_way.push_back(rows.row(i));
    in_the_way.emplace_back();
    VectorXd left  = VectorXd::Zero(static_cast<Index>(in_the_way.size()));
    left.tail<1>() = -VectorXd::Ones(1);
    for (Index j = 0; j < open.cols(); ++j)
      for (const double sign : {1., -1.})
        {
          in_the_way.back() = sign * Eigen::RowVectorXd::Unit(open.cols(), j);
          if (const auto y =
                solvers::shortest_way_out(stacked(in_the_way, open.cols()),
                                          left))
            return open * *y;
        }
    return {};
  }

  /* The least |way + open y| with rows y + room >= 0. Without rows y = -open^T
     P a, with the amounts a of motions in the way; the rest is the shortest
     step from there into what the rows allow. */
  VectorXd
  OpenMotions::shortening(const VectorXd &way) const
  {
    const VectorXd so_far = motions.free_in(way);
    VectorXd       y =
      -open.transpose() * (motions.products_of_free() * so_far).eval();
    VectorXd left = room;
    if (room.size() > 0) // BLAS takes no empty matrix
      left += rows * y;
    const auto out = solvers::shortest_way_out(rows, left);
    if (!out)
      return {};
    const VectorXd change = open * (y + *out);
    return solvers::largest(change) <= way_rounding * solvers::largest(way) ?
             VectorXd() :
             change;
  }
} // namespace conetact::contact
