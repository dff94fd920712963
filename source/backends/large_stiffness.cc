// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/large_stiffness.h"

#include "conetact/backends/multigrid.h"

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

    /** Unknowns that need no levels: solved directly. */
    constexpr Index small_enough = 600;

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

    /** Places of unknowns among those of nodes, each with as many. */
    struct Places
    {
      std::vector<int> of; ///< each unknown
      int              n_nodes = 0;
    };

    Places
    find_places(const std::vector<unsigned int> &node_of, const int block)
    {
      std::vector<unsigned int> nodes = node_of;
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      Places           places;
      std::vector<int> taken(nodes.size(), 0);
      places.n_nodes = static_cast<int>(nodes.size());
      for (const unsigned int node : node_of)
        {
          const auto i =
            std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
          int &next = taken[static_cast<std::size_t>(i)];
          places.of.push_back(static_cast<int>(i) * block + next++);
        }
      return places;
    }

    /** Both triangles, node by node. */
    template <int block>
    BlockMatrix<block, block, double>
    whole_matrix(const Eigen::SparseMatrix<double> &upper, const Places &places)
    {
      using Entry = Eigen::SparseMatrix<double>::InnerIterator;
      std::vector<std::vector<int>> neighbours(at(places.n_nodes));
      for (Index q = 0; q < upper.cols(); ++q)
        {
          const int j    = places.of[at(q)] / block;
          int       last = -1;
          for (Entry it(upper, q); it; ++it)
            if (const int i = places.of[at(it.row())] / block; i != last)
              {
                neighbours[at(i)].push_back(j);
                if (i != j)
                  neighbours[at(j)].push_back(i);
                last = i;
              }
        }
      BlockMatrix<block, block, double> A;
      for (std::vector<int> &row : neighbours)
        {
          std::sort(row.begin(), row.end());
          row.erase(std::unique(row.begin(), row.end()), row.end());
          A.start.push_back(A.start.back() + row.size());
          A.column.insert(A.column.end(), row.begin(), row.end());
          row = {};
        }
      A.allocate();
      const auto place = [&](const int i, const int j) {
        const auto begin =
          A.column.begin() + static_cast<std::ptrdiff_t>(A.start[at(i)]);
        const auto end =
          A.column.begin() + static_cast<std::ptrdiff_t>(A.start[at(i) + 1]);
        return static_cast<std::size_t>(std::lower_bound(begin, end, j) -
                                        A.column.begin());
      };
      for (Index q = 0; q < upper.cols(); ++q)
        {
          const int j = places.of[at(q)] / block, c = places.of[at(q)] % block;
          int       last = -1;
          std::size_t k = 0, k_transposed = 0;
          for (Entry it(upper, q); it; ++it)
            {
              const int i = places.of[at(it.row())] / block;
              const int r = places.of[at(it.row())] % block;
              if (i != last)
                {
                  k            = place(i, j);
                  k_transposed = place(j, i);
                  last         = i;
                }
              A.block(k)(r, c)            = it.value();
              A.block(k_transposed)(c, r) = it.value();
            }
        }
      return A;
    }



    template <int block>
    class BlockSystem : public solvers::LargeSystem
    {
    public:
      BlockSystem(LargeStiffness given)
        : contact(std::move(given.contact))
        , places(find_places(given.node_of, block))
        , n(places.n_nodes * block)
      {
        K = whole_matrix<block>(given.upper, places);
        Eigen::SparseMatrix<double>().swap(given.upper); // it is large
        find_scale();
        make_smoother();
        make_levels(given.modes);
      }

      Index
      n_unknowns() const override
      {
        return static_cast<Index>(places.of.size());
      }
      Array
      multiply(const Array &u) const override
      {
        const Array x = scatter(u);
        Array       y(n);
        K.multiply(x.data(), y.data());
        return gather(y);
      }
      Array
      diagonal() const override
      {
        Array d(n);
        for (int i = 0; i < places.n_nodes; ++i)
          d.segment<block>(i * block) = K.block(diagonal_block(i)).diagonal();
        return gather(d);
      }
      std::optional<Step>
      solve(const std::vector<NodeLaw> &laws,
            const Array                &f,
            const double                precision) const override;

    private:
      using FloatBlock = Eigen::Matrix<float, block, block>;

      /** Rows of a node that stay: y_u += S x_u + Q y_k. */
      struct NodeRows
      {
        std::vector<int> stays, known; ///< places
        SmallMatrix      S, Q;
      };
      /** The linear system of a step. */
      struct System
      {
        Array                                   free; ///< 1 or 0 [-]
        FloatVector                             free_float;
        std::vector<NodeRows>                   rows;
        Array                                   known, right_hand_side;
        std::vector<std::pair<int, FloatBlock>> D; ///< of contact nodes
      };

      Array
      scatter(const Array &u) const
      {
        Array x = Array::Zero(n);
        for (std::size_t q = 0; q < places.of.size(); ++q)
          x[places.of[q]] = u[static_cast<Index>(q)];
        return x;
      }
      Array
      gather(const Array &x) const
      {
        Array u(n_unknowns());
        for (std::size_t q = 0; q < places.of.size(); ++q)
          u[static_cast<Index>(q)] = x[places.of[q]];
        return u;
      }
      /** The place of a contact unknown. */
      int
      place(const Index k) const
      {
        return places.of[at(n_unknowns() - contact.n_unknowns() + k)];
      }
      std::size_t
      diagonal_block(const int i) const
      {
        std::size_t k = K.start[at(i)];
        while (K.column[k] != i)
          ++k;
        return k;
      }
      void
      find_scale();
      void
      make_smoother();
      void
      make_levels(const Eigen::MatrixXd &modes);
      /** Of the matrix with all contact nodes held. */
      void
      held_row(const int i, SparseRow &row) const;
      FloatBlock
      inverse_block(const int i, const Array &free, const FloatBlock &S) const;
      System
      system_of(const std::vector<NodeLaw> &laws, const Array &f) const;
      void
      add_node(const Index    i,
               const NodeLaw &law,
               const Array   &y,
               System        &system) const;
      /** The blocks of the smoother where a law has changed them. */
      void
      set_blocks(System &system) const;
      /** Turns K x (both over a unit of stiffness) into rows of the laws. */
      template <typename Vector>
      void
      add_laws(const System &system,
               const double  unit,
               const Vector &x,
               Vector       &y) const;
      Array
      multiply(const System &system, const Array &x) const;
      FloatVector
      precondition(const System &system, const FloatVector &r) const;
      FloatVector
      gmres(const System      &system,
            const FloatVector &b,
            const double       goal,
            unsigned int      &iterations) const;
      Step
      refine(const System &system, const double precision) const;

      const solvers::ContactSystem      contact;
      const Places                      places;
      const int                         n; ///< places
      BlockMatrix<block, block, double> K;
      double                            scale = 1; ///< of K, a power of two
      BlockMatrix<block, block, float>  A;         ///< K over it
      std::vector<FloatBlock>           D;
      float                             largest = 1; ///< eigenvalue of D A
      Array                             all_held;    ///< 0 at contact unknowns
      std::unique_ptr<CoarseLevels<block, 3 * (block - 1)>> levels;
      Eigen::LDLT<Eigen::MatrixXd>                          whole; ///< of few
    };



    template <int block>
    void
    BlockSystem<block>::find_scale()
    {
      double sum = 0;
      for (int i = 0; i < places.n_nodes; ++i)
        sum += K.block(diagonal_block(i)).trace();
      scale = sum > 0 ? std::exp2(std::round(
                          std::log2(sum / static_cast<double>(n_unknowns())))) :
                        1.;
      A     = K.template cast<float>();
      for (float &a : A.value)
        a = static_cast<float>(a / scale);
    }

    /* Its bound serves all states: what is held makes the range of eigenvalues
       smaller, and so does what is added to blocks as to their smoother. */
    template <int block>
    void
    BlockSystem<block>::make_smoother()
    {
      all_held = Array::Zero(n);
      for (const int p : places.of)
        all_held[p] = 1;
      D.resize(at(places.n_nodes));
      for (int i = 0; i < places.n_nodes; ++i)
        D[at(i)] = inverse_block(i, all_held, FloatBlock::Zero());
      largest = largest_eigenvalue(
        [&](const FloatVector &x, FloatVector &y) {
          A.multiply(x.data(), y.data());
        },
        [&](const FloatVector &x, FloatVector &y) {
          multiply_blocks<block>(D, x, y);
        },
        n);
      for (Index k = 0; k < contact.n_unknowns(); ++k)
        all_held[place(k)] = 0;
    }

    template <int block>
    void
    BlockSystem<block>::held_row(const int i, SparseRow &row) const
    {
      row.columns.clear();
      row.values.clear();
      const int node = i / block;
      for (std::size_t k = K.start[at(node)]; k < K.start[at(node) + 1]; ++k)
        for (int c = 0; c < block; ++c)
          {
            const int    j    = K.column[k] * block + c;
            const double held = all_held[i] * all_held[j];
            double       a    = K.block(k)(i % block, c) / scale;
            if (i == j && a == 0)
              a = 1; // no unknown at all
            row.columns.push_back(j);
            row.values.push_back(i == j ? a : held * a);
          }
    }

    template <int block>
    void
    BlockSystem<block>::make_levels(const Eigen::MatrixXd &modes)
    {
      const auto row_of = [&](const int i, SparseRow &row) {
        held_row(i, row);
      };
      if (n <= small_enough)
        {
          Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
          SparseRow       row;
          for (int i = 0; i < n; ++i)
            {
              held_row(i, row);
              for (std::size_t k = 0; k < row.columns.size(); ++k)
                dense(i, row.columns[k]) = row.values[k];
            }
          whole.compute(dense);
          return;
        }
      Eigen::MatrixXd scattered(n, modes.cols());
      for (Index j = 0; j < modes.cols(); ++j)
        scattered.col(j) = scatter(modes.col(j));
      const SmoothedAggregation aggregates(n, block, row_of, scattered);
      levels =
        std::make_unique<CoarseLevels<block, 3 * (block - 1)>>(aggregates,
                                                               places.n_nodes);
    }

    /* Of what is free; zero elsewhere. */
    template <int block>
    typename BlockSystem<block>::FloatBlock
    BlockSystem<block>::inverse_block(const int         i,
                                      const Array      &free,
                                      const FloatBlock &S) const
    {
      FloatBlock a = A.block(diagonal_block(i));
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
    BlockSystem<block>::add_node(const Index    i,
                                 const NodeLaw &law,
                                 const Array   &y,
                                 System        &system) const
    {
      std::vector<Index> stays, known;
      NodeRows           rows;
      for (Index k = 0; k < law.h.size(); ++k)
        {
          const int p = place(contact.first[at(i)] + k);
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
      system.free  = Array::Zero(n);
      system.known = Array::Zero(n);
      for (const int p : places.of)
        system.free[p] = 1;
      for (Index i = 0; i < contact.n_nodes(); ++i)
        for (Index k = 0; k < laws[at(i)].h.size(); ++k)
          if (const NodeLaw &law = laws[at(i)]; law.d.row(k).isZero(0))
            {
              const int p     = place(contact.first[at(i)] + k);
              system.free[p]  = 0;
              system.known[p] = law.h(k) / law.p(k, k);
            }
      Array y(n);
      K.multiply(system.known.data(), y.data());
      system.right_hand_side = -scatter(f) - y;
      for (Index i = 0; i < contact.n_nodes(); ++i)
        add_node(i, laws[at(i)], y, system);
      system.right_hand_side.array() *= system.free.array();
      system.free_float = system.free.template cast<float>();
      set_blocks(system);
      return system;
    }

    template <int block>
    void
    BlockSystem<block>::set_blocks(System &system) const
    {
      std::vector<FloatBlock> S(at(places.n_nodes), FloatBlock::Zero());
      for (const NodeRows &rows : system.rows)
        {
          // Only its symmetric part makes a smoother, and if it is positive.
          const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(
            .5 * (rows.S + rows.S.transpose()));
          const SmallMatrix positive =
            eigen.eigenvectors() *
            eigen.eigenvalues().cwiseMax(0.).asDiagonal() *
            eigen.eigenvectors().transpose() / scale;
          const int i = rows.stays[0] / block;
          for (std::size_t a = 0; a < rows.stays.size(); ++a)
            for (std::size_t b = 0; b < rows.stays.size(); ++b)
              S[at(i)](rows.stays[a] % block, rows.stays[b] % block) +=
                static_cast<float>(
                  positive(static_cast<Index>(a), static_cast<Index>(b)));
        }
      for (Index i = 0; i < contact.n_nodes(); ++i)
        {
          const int node = place(contact.first[at(i)]) / block;
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
    solvers::LargeSystem::Array
    BlockSystem<block>::multiply(const System &system, const Array &x) const
    {
      Array y(n);
      K.multiply(x.data(), y.data());
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
          for (Index i = 0; i <= k; ++i)
            {
              H(i, k) =
                w.template cast<double>().dot(V[at(i)].template cast<double>());
              w -= static_cast<float>(H(i, k)) * V[at(i)];
            }
          H(k + 1, k) = w.template cast<double>().norm();
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
    solvers::LargeSystem::Step
    BlockSystem<block>::refine(const System &system,
                               const double  precision) const
    {
      Step         result{system.known};
      Array        x     = Array::Zero(n);
      Array        r     = system.right_hand_side;
      const double start = r.norm(), goal = precision * start;
      double       left = start, before = left;
      while (left > goal && result.iterations < most_iterations)
        {
          const FloatVector b = (r / left).template cast<float>();
          x +=
            (left / scale) *
            gmres(system, b, std::max(goal / left, digits), result.iterations)
              .template cast<double>();
          before = left;
          r      = system.right_hand_side - multiply(system, x);
          left   = r.norm();
          if (!(left < .5 * before)) // all there is to gain
            break;
        }
      result.du += x;
      result.error = start > 0 ? left / start : 0.;
      return result;
    }

    template <int block>
    std::optional<solvers::LargeSystem::Step>
    BlockSystem<block>::solve(const std::vector<NodeLaw> &laws,
                              const Array                &f,
                              const double                precision) const
    {
      Step step = refine(system_of(laws, f), precision);
      if (!step.du.allFinite())
        return {};
      step.du = gather(step.du);
      return step;
    }
  } // namespace



  std::shared_ptr<const solvers::LargeSystem>
  make_large_system(LargeStiffness given, const unsigned int dim)
  {
    if (dim == 2)
      return std::make_shared<BlockSystem<2>>(std::move(given));
    return std::make_shared<BlockSystem<3>>(std::move(given));
  }
} // namespace conetact::backends
