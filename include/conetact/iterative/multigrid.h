// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_multigrid_h
#define conetact_iterative_multigrid_h

#include "conetact/iterative/coarse_correction.h"
#include "conetact/iterative/row_runs.h"
#include "conetact/iterative/smoothed_aggregation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <optional>

namespace conetact::iterative
{
  /** What Chebyshev's method needs, kept from one time to the next. */
  struct ChebyshevVectors
  {
    FloatVector d, z;
  };

  /**
   * Two steps of Chebyshev's method for A x = b, preconditioned by D, for
   * eigenvalues of D A up to `largest`. `multiply(x, y)` is y = A x;
   * `scale(r, prepare, use)` makes D r as NodeBlocks::for_products() does, so
   * that vectors are read once.
   */
  template <typename Multiply, typename Scale>
  class Chebyshev
  {
  public:
    using Index = Eigen::Index;

    Chebyshev(const Multiply   &m,
              const Scale      &s,
              const float       largest,
              ChebyshevVectors &vectors)
      : multiply(m)
      , scale(s)
      , theta((1 + 1 / range) * largest / 2)
      , delta((1 - 1 / range) * largest / 2)
      , d(vectors.d)
      , z(vectors.z)
    {}

    /** From x = 0; r is the residual at the end, b at the beginning. */
    void
    smooth_first(FloatVector &r, FloatVector &x)
    {
      x.resize(r.size());
      d.resize(r.size());
      scale(
        r,
        [](const Index, const Index) {},
        [&](const Index i, const auto &scaled) {
          d.segment(i, scaled.size()) = scaled / theta;
          x.segment(i, scaled.size()) = d.segment(i, scaled.size());
        });
      second_step(r, x);
      multiply(d, z);
      r -= z;
    }
    /** From x; r is overwritten. */
    void
    smooth_last(const FloatVector &b, FloatVector &r, FloatVector &x)
    {
      d.resize(r.size());
      multiply(x, r);
      scale(
        r,
        [&](const Index i, const Index n) {
          r.segment(i, n) = b.segment(i, n) - r.segment(i, n);
        },
        [&](const Index i, const auto &scaled) {
          d.segment(i, scaled.size()) = scaled / theta;
          x.segment(i, scaled.size()) += d.segment(i, scaled.size());
        });
      second_step(r, x);
    }

  private:
    void
    second_step(FloatVector &r, FloatVector &x)
    {
      const float sigma = theta / delta, rho = 1 / (2 * sigma - 1 / sigma);
      z.resize(r.size());
      multiply(d, z);
      scale(
        r,
        [&](const Index i, const Index n) {
          r.segment(i, n) -= z.segment(i, n);
        },
        [&](const Index i, const auto &scaled) {
          auto part = d.segment(i, scaled.size());
          part      = rho / sigma * part + 2 * rho / delta * scaled;
          x.segment(i, scaled.size()) += part;
        });
    }

    static constexpr float range = 20; ///< of eigenvalues that are smoothed
    const Multiply        &multiply;
    const Scale           &scale;
    const float            theta, delta;
    FloatVector           &d, &z;
  };

  /** Of vectors of which each process has a part. */
  inline double
  dot(const FloatVector &x, const FloatVector &y, const Communicator &processes)
  {
    double sum = 0;
    for_pieces(x, [&](const Eigen::Index i, const Eigen::Index n) {
      sum += static_cast<double>(x.segment(i, n).dot(y.segment(i, n)));
    });
    return processes.sum(sum);
  }

  /**
   * The largest eigenvalue of D A, both symmetric, but for some percent; of n
   * unknowns this process has those from `first`. By Lanczos' method, as part
   * of that of conjugate gradients: eigenvectors that live on a few nodes of
   * many, such as those that a tie has, are found as fast as others.
   */
  template <typename Multiply, typename Scale>
  float
  largest_eigenvalue(const Multiply     &multiply,
                     const Scale        &scale,
                     const Eigen::Index  first,
                     const Eigen::Index  n,
                     const Communicator &processes)
  {
    constexpr int steps = 15;
    FloatVector   r(n), z(n), q(n);
    // any vector that is no eigenvector
    for (Eigen::Index i = 0; i < n; ++i)
      r[i] = 1 + static_cast<float>(((first + i) * 7919) % 1009) / 1009 -
             2 * static_cast<float>((first + i) % 2);
    scale(r, z);
    FloatVector         p   = z;
    double              rho = dot(r, z, processes), before = 0;
    std::vector<double> diagonal, beside;
    for (int k = 0; k < steps; ++k)
      {
        multiply(p, q);
        const double energy = dot(p, q, processes);
        if (!(energy > 0)) // nothing is left but motions without strain
          break;
        const double step = rho / energy;
        diagonal.push_back(1 / step + before);
        r -= static_cast<float>(step) * q;
        scale(r, z);
        const double next = dot(r, z, processes), beta = next / rho;
        if (!(beta > 0))
          break;
        beside.push_back(std::sqrt(beta) / step);
        before = beta / step;
        p      = z + static_cast<float>(beta) * p;
        rho    = next;
      }
    if (diagonal.empty())
      return 1;
    const auto size = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
    eigen.computeFromTridiagonal(
      Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size),
      Eigen::Map<const Eigen::VectorXd>(beside.data(), size - 1),
      Eigen::EigenvaluesOnly);
    return 1.1f * static_cast<float>(eigen.eigenvalues().maxCoeff());
  }

  /**
   * The levels below the finest one, whose nodes have `fine` unknowns:
   * aggregates with `coarse` unknowns each, in single precision; the coarsest
   * one is solved directly. Levels of few unknowns are whole: each process has
   * all of them and does the same, which takes less time than messages.
   */
  template <int fine, int coarse>
  class CoarseLevels : public CoarseCorrection<fine>
  {
  public:
    CoarseLevels(const LevelAbove<fine> &finest, const Communicator &processes);

    /**
     * `nodes`: the contact nodes of this process, by their rows in A, the
     * finest matrix, whose rows of processes begin at `first`.
     */
    void
    follow(const DistributedMatrix<fine, fine, float> &A,
           const std::vector<int>                     &nodes,
           const std::vector<int>                     &first);
    /**
     * Makes levels those of the present states of these nodes. Not `exactly`:
     * unless they are those of states that differ from these but little. The
     * finest level alone has these then, which takes no iteration more.
     */
    void
    set_states(const std::vector<NodeState<fine>> &states,
               const bool                          exactly) override;
    /** x = P (cycle of the levels below) P^T r. */
    void
    correct(const FloatVector &r, FloatVector &x) override;

  private:
    struct Level
    {
      DistributedMatrix<coarse, coarse, float> A;
      RowRuns<coarse, float>                   runs;
      NodeBlocks<coarse>                       D;
      float                                    largest = 1;
      int                                      begin   = 0; ///< own rows
      /// those that states change
      std::vector<std::vector<Eigen::Matrix<float, coarse, coarse>>> free_rows;
      /// from and to the next one
      DistributedMatrix<coarse, coarse, float> P;
      TransposedMatrix<coarse, coarse, float>  R;
      FloatVector                              b, r, x, c;
      ChebyshevVectors                         smoothing;
      bool is_whole = false, is_first_whole = false;
    };
    void
    cycle(const std::size_t level);
    /** Puts a level below all others; of its rows remains what this process
     * has of the level. Whether there should be none below it. */
    template <int size>
    bool
    add_level(CoarseLevel<size, coarse>             &&next,
              DistributedMatrix<size, coarse, float> &P,
              TransposedMatrix<coarse, size, float>  &R,
              LevelRows<coarse>                      &rows);
    void
    make_smoother(Level                                           &level,
                  const DistributedMatrix<coarse, coarse, double> &A);
    bool
    have_states_like(const std::vector<NodeState<fine>> &states) const;
    void
    change_rows(Level &level, const SomeRows<coarse, coarse> &change);
    /** Of those that share a level. */
    Communicator
    sharers(const Level &level) const
    {
      return level.is_whole ? Communicator() : processes;
    }
    /** b of a level, from the residual above it. */
    template <typename Matrix>
    void
    restrict_to(Level &level, const Matrix &restriction, const FloatVector &r);

    Communicator                           processes;
    DistributedMatrix<fine, coarse, float> P;
    TransposedMatrix<coarse, fine, float>  R;
    std::vector<Level>                     below;
    ContactChange<fine, coarse>            contact;
    Eigen::MatrixXd                        coarsest_matrix; ///< without states
    Eigen::LDLT<Eigen::MatrixXd>           coarsest;
    /** Of the levels, once there are any. */
    std::optional<std::vector<NodeState<fine>>> shown;
  };

  extern template class CoarseLevels<2, 3>;
  extern template class CoarseLevels<3, 6>;
} // namespace conetact::iterative

#endif
