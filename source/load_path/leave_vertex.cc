// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/leave_vertex.h"

#include <algorithm>
#include <limits>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** Entries of a direction below this share of the largest are none. */
    constexpr double round_off = 1e-11;
    /** Steps that differ by less, relatively, are one. */
    constexpr double tie = 1e-9;

    /** Positions of the values that vanish first along a ray; none: never. */
    std::vector<Index>
    first_to_vanish(const VectorXd &value,
                    const VectorXd &direction,
                    double         &step)
    {
      const double smallest = round_off * direction.lpNorm<Eigen::Infinity>();
      const auto   vanishes_at = [&](const Index a) {
        return direction(a) < -smallest ?
                   value(a) / -direction(a) :
                   std::numeric_limits<double>::infinity();
      };
      step = std::numeric_limits<double>::infinity();
      for (Index a = 0; a < value.size(); ++a)
        step = std::min(step, vanishes_at(a));
      std::vector<Index> result;
      for (Index a = 0; a < value.size(); ++a)
        if (const double at = vanishes_at(a);
            at < std::numeric_limits<double>::infinity() &&
            at <= step * (1 + tie))
          result.push_back(a);
      return result;
    }

    /** Of a line the half in which all these values grow. */
    bool
    make_grow(Ray &line, const std::vector<Index> &growing)
    {
      if (line.value(growing.front()) < 0)
        {
          line.value = -line.value;
          line.p     = -line.p;
        }
      const double smallest = round_off * line.value.lpNorm<Eigen::Infinity>();
      return std::all_of(growing.begin(), growing.end(), [&](const Index a) {
        return line.value(a) > smallest;
      });
    }
  } // namespace



  VectorXd
  Ray::z() const
  {
    VectorXd result = value;
    for (Index a = 0; a < result.size(); ++a)
      if (!moves[static_cast<std::size_t>(a)])
        result(a) = 0;
    return result;
  }



  Ray
  line_of(const MatrixXd &M, const VectorXd &q, const std::vector<bool> &moves)
  {
    eigen_assert(static_cast<Index>(moves.size()) == M.rows());
    const Index n = q.size();
    // Without units: z in those of x, and p' in those of x, too.
    const auto   not_zero = [](const double x) { return x > 0 ? x : 1.; };
    const double z_scale = not_zero(M.size() > 0 ? M.cwiseAbs().maxCoeff() : 0),
                 p_scale = not_zero(n > 0 ? q.cwiseAbs().maxCoeff() : 0);
    MatrixXd equations(n + 1, n); // transposed: a column is x - M z - q p' = 0
    for (Index a = 0; a < n; ++a)
      if (moves[static_cast<std::size_t>(a)])
        equations.row(a) = -M.col(a).transpose() / z_scale;
      else
        equations.row(a) = VectorXd::Unit(n, a).transpose();
    equations.row(n) = -q.transpose() / p_scale;
    // The last column of Q is orthogonal to all equations.
    const Eigen::ColPivHouseholderQR<MatrixXd> factor(equations);
    const VectorXd null = factor.householderQ() * VectorXd::Unit(n + 1, n);
    Ray            result{moves, null.head(n), null(n) / p_scale};
    for (Index a = 0; a < n; ++a)
      if (moves[static_cast<std::size_t>(a)])
        result.value(a) /= z_scale;
    return result;
  }



  bool
  leave_vertex(const MatrixXd &M,
               const VectorXd &q,
               const VectorXd &weight,
               Ray            &ray)
  {
    eigen_assert(M.rows() == M.cols());
    eigen_assert(q.size() == M.rows());
    eigen_assert(weight.size() == M.rows());
    VectorXd    value = weight;
    const Index most  = 50 + 20 * q.size();
    for (Index k = 0; k < most; ++k)
      {
        double                   step;
        const std::vector<Index> vanish =
          first_to_vanish(value, ray.value, step);
        if (vanish.empty())
          return true;
        value += step * ray.value;
        std::vector<bool> moves = ray.moves;
        for (const Index a : vanish)
          {
            value(a) = 0;
            moves[static_cast<std::size_t>(a)] =
              !ray.moves[static_cast<std::size_t>(a)];
          }
        ray = line_of(M, q, moves);
        if (!make_grow(ray, vanish))
          return false;
      }
    return false;
  }
} // namespace conetact::load_path
