// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/block_system.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace conetact::backends
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;
    using solvers::NodeLaw;
    using solvers::SmallMatrix;
    using solvers::SmallVector;

    // Of GMRES. Vectors of a cycle are kept twice, before and after the
    // preconditioner; in single precision it gains so much at a time.
    constexpr int    cycle_length    = 40;
    constexpr auto   most_iterations = 400u;
    constexpr double digits          = 1e-4;

    std::size_t
    at(const Index i)
    {
      return static_cast<std::size_t>(i);
    }

    /**
     * Pieces that stay in the cache; sums over them in single precision are
     * exact enough.
     */
    template <typename F>
    void
    for_pieces(const FloatVector &w, const F &f)
    {
      constexpr Index piece = 512;
      for (Index i = 0; i < w.size(); i += piece)
        f(i, std::min(piece, w.size() - i));
    }

    /** w -= c v, and (w, next) of what is left. */
    double
    subtract_and_project(const double       c,
                         const FloatVector &v,
                         const FloatVector &next,
                         FloatVector       &w)
    {
      double sum = 0;
      for_pieces(w, [&](const Index i, const Index n) {
        w.segment(i, n) -= static_cast<float>(c) * v.segment(i, n);
        sum += static_cast<double>(w.segment(i, n).dot(next.segment(i, n)));
      });
      return sum;
    }
  } // namespace



  /** Of each column of K, own ones before those of others. */
  template <int block>
  struct BlockSystem<block>::Columns
  {
    std::vector<double> number; ///< among those of all
    std::vector<double> held;   ///< 0 at contact unknowns, else 1
  };



  template <int block>
  BlockSystem<block>::BlockSystem(BlockShare<block> given)
    : processes(given.processes)
    , first(given.first)
    , n(static_cast<int>(given.exists.size()))
    , n_nodes(n / block)
    , exists(given.exists)
    , contact(std::move(given.contact))
  {
    std::vector<int> first_node = first;
    for (int &i : first_node)
      i /= block;
    K = {std::move(given.K), first_node, processes};
    K.share_equal_rows();
    find_scale();
    make_smoother();
    make_levels(given.modes);
  }



  template <int block>
  std::size_t
  BlockSystem<block>::diagonal_block(const int i) const
  {
    const auto &own = K.own_part();
    std::size_t k   = own.start[at(i)];
    while (own.column[k] != i)
      ++k;
    return k;
  }



  template <int block>
  typename BlockSystem<block>::Array
  BlockSystem<block>::multiply(const Array &x) const
  {
    Array y(n);
    K.multiply(x.data(), y.data());
    return y;
  }



  template <int block>
  typename BlockSystem<block>::Array
  BlockSystem<block>::diagonal() const
  {
    Array d(n);
    for (int i = 0; i < n_nodes; ++i)
      d.segment<block>(i * block) =
        K.own_part().block(at(i), diagonal_block(i)).diagonal();
    return d;
  }



  template <int block>
  void
  BlockSystem<block>::find_scale()
  {
    double sum = 0;
    for (int i = 0; i < n_nodes; ++i)
      sum += K.own_part().block(at(i), diagonal_block(i)).trace();
    sum                     = processes.sum(sum);
    const double n_unknowns = processes.sum(exists.sum());
    scale = sum > 0 ? std::exp2(std::round(std::log2(sum / n_unknowns))) : 1.;
    A     = K.template cast<float>();
    A.for_all_numbers([&](float &a) { a = static_cast<float>(a / scale); });
  }



  /* Its bound serves all states: what is held makes the range of eigenvalues
     smaller, and so does what is added to blocks as to their smoother. */
  template <int block>
  void
  BlockSystem<block>::make_smoother()
  {
    D.resize(at(n_nodes));
    for (int i = 0; i < n_nodes; ++i)
      D[at(i)] = inverse_block(i, exists, FloatBlock::Zero());
    largest = largest_eigenvalue(
      [&](const FloatVector &x, FloatVector &y) {
        A.multiply(x.data(), y.data());
      },
      [&](const FloatVector &x, FloatVector &y) {
        multiply_blocks<block>(D, x, y);
      },
      first[at(processes.rank())],
      n,
      processes);
  }



  template <int block>
  void
  BlockSystem<block>::held_row(const Columns &columns,
                               const int      i,
                               SparseRow     &row) const
  {
    row.columns.clear();
    row.values.clear();
    K.for_row(at(i / block), [&](const int node, const auto &values) {
      for (int c = 0; c < block; ++c)
        {
          const int    j    = node * block + c;
          const double held = columns.held[at(i)] * columns.held[at(j)];
          double       a    = values(i % block, c) / scale;
          if (i == j && a == 0)
            a = 1; // no unknown at all
          row.columns.push_back(static_cast<int>(columns.number[at(j)]));
          row.values.push_back(i == j ? a : held * a);
        }
    });
  }



  template <int block>
  void
  BlockSystem<block>::make_levels(const Eigen::MatrixXd &modes)
  {
    Columns columns;
    columns.held.assign(exists.begin(), exists.end());
    for (const std::vector<int> &node : contact)
      for (const int p : node)
        columns.held[at(p)] = 0;
    columns.held = K.of_columns(std::move(columns.held));
    for (int i = 0; i < n; ++i)
      columns.number.push_back(first[at(processes.rank())] + i);
    columns.number    = K.of_columns(std::move(columns.number));
    const auto row_of = [&](const int i, SparseRow &row) {
      held_row(columns, i, row);
    };
    if (first.back() <= small_enough)
      {
        Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
        SparseRow       row;
        for (int i = 0; i < n; ++i)
          {
            row_of(i, row);
            for (std::size_t k = 0; k < row.columns.size(); ++k)
              dense(i, row.columns[k]) = row.values[k];
          }
        whole.compute(dense);
        return;
      }
    const SmoothedAggregation aggregates(
      first, block, row_of, modes, processes);
    levels = std::make_unique<CoarseLevels<block, 3 * (block - 1)>>(aggregates,
                                                                    processes);
  }



  /* Of what is free; zero elsewhere. */
  template <int block>
  typename BlockSystem<block>::FloatBlock
  BlockSystem<block>::inverse_block(const int         i,
                                    const Array      &free,
                                    const FloatBlock &S) const
  {
    FloatBlock a = A.own_part().block(at(i), diagonal_block(i));
    a += S;
    for (int r = 0; r < block; ++r)
      if (free[i * block + r] == 0)
        {
          a.row(r).setZero();
          a.col(r).setZero();
          a(r, r) = 1;
        }
    FloatBlock inverse = a.inverse();
    for (int r = 0; r < block; ++r)
      if (free[i * block + r] == 0)
        inverse(r, r) = 0;
    return inverse;
  }

  /* Rows with D = 0 say what an unknown is; of the others, (P + D K) du = h,
     D is made one. */
  template <int block>
  void
  BlockSystem<block>::add_node(const std::vector<int> &node,
                               const NodeLaw          &law,
                               const Array            &y,
                               System                 &system) const
  {
    std::vector<Index> stays, known;
    NodeRows           rows;
    for (Index k = 0; k < law.h.size(); ++k)
      {
        const int p = node[at(k)];
        if (system.free[p] == 0)
          {
            known.push_back(k);
            rows.known.push_back(p);
          }
        else
          {
            stays.push_back(k);
            rows.stays.push_back(p);
          }
      }
    if (stays.empty())
      return;
    const SmallMatrix own = law.d(stays, stays);
    const SmallMatrix one = own.inverse();
    rows.S                = one * law.p(stays, stays);
    rows.Q                = one * law.d(stays, known);
    SmallVector h         = law.h(stays);
    for (std::size_t k = 0; k < known.size(); ++k)
      h -= system.known[rows.known[k]] * law.p(stays, known[k]) +
           y[rows.known[k]] * law.d(stays, known[k]);
    h = one * h;
    for (std::size_t k = 0; k < stays.size(); ++k)
      system.right_hand_side[rows.stays[k]] =
        h(static_cast<Index>(k)) - y[rows.stays[k]];
    if (!rows.S.isZero(0) || !rows.Q.isZero(0))
      system.rows.push_back(std::move(rows));
  }

  template <int block>
  typename BlockSystem<block>::System
  BlockSystem<block>::system_of(const std::vector<NodeLaw> &laws,
                                const Array                &f) const
  {
    System system;
    system.free  = exists;
    system.known = Array::Zero(n);
    for (std::size_t i = 0; i < contact.size(); ++i)
      for (Index k = 0; k < laws[i].h.size(); ++k)
        if (const NodeLaw &law = laws[i]; law.d.row(k).isZero(0))
          {
            const int p     = contact[i][at(k)];
            system.free[p]  = 0;
            system.known[p] = law.h(k) / law.p(k, k);
          }
    const Array y          = multiply(system.known);
    system.right_hand_side = -f - y;
    for (std::size_t i = 0; i < contact.size(); ++i)
      add_node(contact[i], laws[i], y, system);
    system.right_hand_side.array() *= system.free.array();
    system.free_float = system.free.template cast<float>();
    set_blocks(system);
    return system;
  }

  template <int block>
  void
  BlockSystem<block>::set_blocks(System &system) const
  {
    std::vector<FloatBlock> S(at(n_nodes), FloatBlock::Zero());
    for (const NodeRows &rows : system.rows)
      {
        // Only its symmetric part makes a smoother, and if it is positive.
        const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(
          .5 * (rows.S + rows.S.transpose()));
        const SmallMatrix positive =
          eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.).asDiagonal() *
          eigen.eigenvectors().transpose() / scale;
        const int i = rows.stays[0] / block;
        for (std::size_t a = 0; a < rows.stays.size(); ++a)
          for (std::size_t b = 0; b < rows.stays.size(); ++b)
            S[at(i)](rows.stays[a] % block, rows.stays[b] % block) +=
              static_cast<float>(
                positive(static_cast<Index>(a), static_cast<Index>(b)));
      }
    for (const std::vector<int> &places : contact)
      {
        const int node = places[0] / block;
        system.D.emplace_back(node,
                              inverse_block(node, system.free, S[at(node)]));
      }
  }

  /* y_u += S x_u + Q y_k, and nothing where unknowns are held. */
  template <int block>
  template <typename Vector>
  void
  BlockSystem<block>::add_laws(const System &system,
                               const double  unit,
                               const Vector &x,
                               Vector       &y) const
  {
    using Number = typename Vector::Scalar;
    for (const NodeRows &rows : system.rows)
      {
        SmallVector in(static_cast<Index>(rows.stays.size()));
        SmallVector held(static_cast<Index>(rows.known.size()));
        for (Index k = 0; k < in.size(); ++k)
          in(k) = x[rows.stays[at(k)]] / unit;
        for (Index k = 0; k < held.size(); ++k)
          held(k) = y[rows.known[at(k)]];
        const SmallVector more = rows.S * in + rows.Q * held;
        for (Index k = 0; k < in.size(); ++k)
          y[rows.stays[at(k)]] += static_cast<Number>(more(k));
      }
    y.array() *= system.free.template cast<Number>().array();
  }

  template <int block>
  typename BlockSystem<block>::Array
  BlockSystem<block>::multiply(const System &system, const Array &x) const
  {
    Array y = multiply(x);
    add_laws(system, 1., x, y);
    return y;
  }

  template <int block>
  FloatVector
  BlockSystem<block>::precondition(const System      &system,
                                   const FloatVector &b) const
  {
    const auto multiply = [&](const FloatVector &x, FloatVector &y) {
      A.multiply(x.data(), y.data());
      for (const NodeRows &rows : system.rows)
        for (std::size_t k = 0; k < rows.stays.size(); ++k)
          for (std::size_t l = 0; l < rows.stays.size(); ++l)
            y[rows.stays[k]] +=
              static_cast<float>(
                .5 *
                (rows.S(static_cast<Index>(k), static_cast<Index>(l)) +
                 rows.S(static_cast<Index>(l), static_cast<Index>(k))) /
                scale) *
              x[rows.stays[l]];
    };
    const auto scaled = [&](const FloatVector &r, FloatVector &z) {
      multiply_blocks<block>(D, r, z);
      for (const auto &[i, own] : system.D)
        z.segment<block>(i * block).noalias() =
          own * r.segment<block>(i * block);
    };
    Chebyshev   smoother(multiply, scaled, largest);
    FloatVector r = b, x(n), coarse(n);
    smoother.smooth_first(r, x);
    r.array() *= system.free_float.array();
    if (levels)
      levels->correct(r, coarse);
    else
      coarse = whole.solve(r.cast<double>()).template cast<float>();
    x.array() += system.free_float.array() * coarse.array();
    smoother.smooth_last(b, r, x);
    return x;
  }

  /* One after the other, as Gram and Schmidt do it in the modified way; or all
     at once, and once more for the sake of rounding: two messages. */
  template <int block>
  double
  BlockSystem<block>::orthogonalize(const std::vector<FloatVector> &V,
                                    FloatVector                    &w,
                                    Eigen::Ref<Array>               along) const
  {
    if (processes.size() == 1)
      {
        along(0) = subtract_and_project(0, V.front(), V.front(), w);
        for (std::size_t i = 1; i < V.size(); ++i)
          along(static_cast<Index>(i)) = subtract_and_project(
            along(static_cast<Index>(i) - 1), V[i - 1], V[i], w);
        return std::sqrt(
          subtract_and_project(along(along.size() - 1), V.back(), w, w));
      }
    const Index n_along = along.size();
    Array       parts(n_along + 1);
    along.setZero();
    for (int pass = 0; pass < 2; ++pass)
      {
        parts.setZero();
        for_pieces(w, [&](const Index begin, const Index size) {
          const auto piece = w.segment(begin, size);
          for (Index i = 0; i < n_along; ++i)
            parts(i) +=
              static_cast<double>(piece.dot(V[at(i)].segment(begin, size)));
          parts(n_along) += static_cast<double>(piece.squaredNorm());
        });
        processes.sum(parts.data(), parts.size());
        along += parts.head(n_along);
        for_pieces(w, [&](const Index begin, const Index size) {
          for (Index i = 0; i < n_along; ++i)
            w.segment(begin, size) -=
              static_cast<float>(parts(i)) * V[at(i)].segment(begin, size);
        });
      }
    return std::sqrt(
      std::max(parts(n_along) - parts.head(n_along).squaredNorm(), 0.));
  }



  /* For |b| = 1 and K over its scale: what is left of b is at most `goal`,
     or what a cycle leaves. */
  template <int block>
  FloatVector
  BlockSystem<block>::gmres(const System      &system,
                            const FloatVector &b,
                            const double       goal,
                            unsigned int      &iterations) const
  {
    std::vector<FloatVector> V = {b}, Z;
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(cycle_length + 1, cycle_length);
    VectorXd        g = VectorXd::Zero(cycle_length + 1);
    g(0)              = 1;
    std::vector<Eigen::JacobiRotation<double>> turns(cycle_length);
    Index                                      k = 0;
    for (; k < cycle_length && std::abs(g(k)) > goal; ++k, ++iterations)
      {
        Z.push_back(precondition(system, V.back()));
        FloatVector w(n);
        A.multiply(Z.back().data(), w.data());
        add_laws(system, scale, Z.back(), w);
        H(k + 1, k) = orthogonalize(V, w, H.col(k).head(k + 1));
        if (!std::isfinite(H(k + 1, k)))
          break;
        V.push_back(w / static_cast<float>(std::max(H(k + 1, k), 1e-30)));
        for (Index i = 0; i < k; ++i)
          H.col(k).applyOnTheLeft(i, i + 1, turns[at(i)].adjoint());
        turns[at(k)].makeGivens(H(k, k), H(k + 1, k));
        H.col(k).applyOnTheLeft(k, k + 1, turns[at(k)].adjoint());
        g.applyOnTheLeft(k, k + 1, turns[at(k)].adjoint());
      }
    const VectorXd y =
      H.topLeftCorner(k, k).template triangularView<Eigen::Upper>().solve(
        g.head(k));
    FloatVector x = FloatVector::Zero(n);
    for (Index i = 0; i < k; ++i)
      x += static_cast<float>(y(i)) * Z[at(i)];
    return x;
  }

  /* Single precision gains some digits at a time, of what double precision
     finds to be left. */
  template <int block>
  typename BlockSystem<block>::Step
  BlockSystem<block>::refine(const System &system, const double precision) const
  {
    Step         result{system.known};
    Array        x     = Array::Zero(n);
    Array        r     = system.right_hand_side;
    const double start = norm(r), goal = precision * start;
    double       left = start, before = left;
    while (left > goal && result.iterations < most_iterations)
      {
        const FloatVector b = (r / left).template cast<float>();
        x += (left / scale) *
             gmres(system, b, std::max(goal / left, digits), result.iterations)
               .template cast<double>();
        before = left;
        r      = system.right_hand_side - multiply(system, x);
        left   = norm(r);
        if (!(left < .5 * before)) // all there is to gain
          break;
      }
    result.du += x;
    result.error = start > 0 ? left / start : 0.;
    return result;
  }


  template <int block>
  typename BlockSystem<block>::Step
  BlockSystem<block>::solve(const std::vector<NodeLaw> &laws,
                            const Array                &f,
                            const double                precision) const
  {
    return refine(system_of(laws, f), precision);
  }

  template class BlockSystem<2>;
  template class BlockSystem<3>;
} // namespace conetact::backends
