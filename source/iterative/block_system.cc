// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/block_system.h"

#include "conetact/base/index.h"
#include "conetact/iterative/trilinos_levels.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/LU>

#include <algorithm>

namespace conetact::iterative
{
  namespace
  {
    using Eigen::Index;
    using solvers::NodeLaw;
    using solvers::SmallMatrix;
    using solvers::SmallVector;

    // Ten cycles of GMRES; each aims at four digits, where single precision
    // still has some to spare: what it leaves begins the next cycle.
    constexpr auto   most_iterations = 400u;
    constexpr double digits          = 1e-4;
  } // namespace

  template <int block>
  BlockSystem<block>::BlockSystem(BlockShare<block> given)
    : processes(given.processes)
    , first(given.first)
    , n(static_cast<int>(given.exists.size()))
    , n_nodes(n / block)
    , exists(given.exists)
    , contact(std::move(given.contact))
    , gmres(processes)
  {
    for (const int i : first)
      first_node.push_back(i / block);
    K = {std::move(given.K), first_node, processes};
    find_near_contact();
    find_scale();
    make_smoother(given.surface);
    make_levels(given.modes, given.side, given.preconditioner);
  }

  template <int block>
  std::size_t
  BlockSystem<block>::diagonal_block(const int i) const
  {
    AssertIndexRange(i, n_nodes);
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
    AssertDimension(x.size(), n);
    Array y(n);
    K.multiply(x.data(), y.data(), runs_of_K);
    return y;
  }

  template <int block>
  void
  BlockSystem<block>::find_near_contact()
  {
    std::vector<bool> touches(at(n_nodes), false);
    for (const std::vector<int> &node : contact)
      touches[at(node[0] / block)] = true;
    const auto &own = K.own_part();
    for (std::size_t i = 0; i < own.n_block_rows(); ++i)
      if (std::any_of(
            own.column.begin() + static_cast<std::ptrdiff_t>(own.start[i]),
            own.column.begin() + static_cast<std::ptrdiff_t>(own.start[i + 1]),
            [&](const int j) { return touches[at(j)]; }))
        near_contact.push_back(i);
  }

  template <int block>
  typename BlockSystem<block>::Array
  BlockSystem<block>::multiply_contact(const Array &x) const
  {
    AssertDimension(x.size(), n);
    Array y = Array::Zero(n);
    K.multiply(x.data(), y.data(), [&](const double *in, double *out) {
      K.own_part().multiply_some(near_contact, in, out);
    });
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

  /* The mean of the diagonal, as a power of two: K over it has the same digits,
     about one as its size and thus room for single precision. */
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
    runs_of_K = RowRuns<block, double>(K.own_part());
    runs_of_A = RowRuns<block, float>(A.own_part());
  }

  /* The bound of eigenvalues of D A serves all states: to hold unknowns makes
     their range smaller, and so does what is added to both A and its blocks. */
  template <int block>
  void
  BlockSystem<block>::make_smoother(const std::vector<int> &surface_nodes)
  {
    std::vector<FloatBlock> inverse;
    for (int i = 0; i < n_nodes; ++i)
      inverse.push_back(inverse_block(i, exists, FloatBlock::Zero()));
    D = NodeBlocks<block>(inverse);
    if (!surface_nodes.empty())
      {
        surface = std::make_unique<SurfaceSmoother<block>>(
          K, scale, surface_nodes, first_node[at(processes.rank())], processes);
        // Contacts are held: with open ones a body may move as it likes.
        surface->factorize(without_contact(), surface->no_blocks());
      }
    const auto product = [&](const FloatVector &x, FloatVector &y) {
      A.multiply(x.data(), y.data(), runs_of_A);
    };
    const auto blocks = [&](const FloatVector &x, FloatVector &y) {
      D.multiply(x, y);
    };
    const int begin = first[at(processes.rank())];
    largest_of_blocks =
      largest_eigenvalue(product, blocks, begin, n, processes);
    largest = largest_of_blocks;
    if (!surface)
      return;
    const FloatVector free = without_contact().template cast<float>();
    largest                = largest_eigenvalue(
      [&](const FloatVector &x, FloatVector &y) {
        product(x.cwiseProduct(free), y);
        y.array() *= free.array();
      },
      [&](const FloatVector &x, FloatVector &y) {
        blocks(x, y);
        surface->apply(x, y);
      },
      begin,
      n,
      processes);
  }

  template <int block>
  void
  BlockSystem<block>::make_levels(const Eigen::MatrixXd  &modes,
                                  const std::vector<int> &side,
                                  const Preconditioner    kind)
  {
    if (first.back() <= small_enough)
      {
        whole.compute(held_matrix());
        return;
      }
    std::vector<int> nodes;
    for (const std::vector<int> &node : contact)
      nodes.push_back(node[0] / block);
    if (kind == Preconditioner::trilinos_ml)
      {
        levels = std::make_unique<TrilinosLevels<block>>(
          K, scale, exists, modes, nodes);
        return;
      }
    auto own = std::make_unique<CoarseLevels<block, 3 * (block - 1)>>(
      LevelAbove<block>{K, scale, D, largest_of_blocks, modes, side},
      processes);
    own->follow(A, nodes, first_node);
    levels = std::move(own);
    K.forget_rows();
    A.forget_rows();
  }

  /* 1 for all unknowns but those of contact. */
  template <int block>
  typename BlockSystem<block>::Array
  BlockSystem<block>::without_contact() const
  {
    Array free = exists;
    for (const std::vector<int> &node : contact)
      for (const int p : node)
        free[p] = 0;
    return free;
  }

  template <int block>
  Eigen::MatrixXd
  BlockSystem<block>::held_matrix() const
  {
    const Array     free   = without_contact();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n_nodes; ++i)
      K.for_row(at(i), [&](const int j, const auto &values) {
        matrix.block<block, block>(i * block, j * block) = values / scale;
      });
    const Array diagonal = matrix.diagonal();
    matrix               = free.asDiagonal() * matrix * free.asDiagonal();
    for (int i = 0; i < n; ++i)
      if (matrix(i, i) == 0)
        matrix(i, i) = diagonal(i) == 0 ? 1. : diagonal(i);
    return matrix;
  }

  /* It inverts A_ii + S among free unknowns, and is zero elsewhere. */
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
        }
    for (int r = 0; r < block; ++r)
      if (a(r, r) == 0) // held, or of a mechanism: nothing resists
        a(r, r) = 1;
    FloatBlock inverse = a.inverse();
    for (int r = 0; r < block; ++r)
      if (free[i * block + r] == 0)
        inverse(r, r) = 0;
    return inverse;
  }

  /* The law P du + D (K du) = h of unknowns u that stay, over D_uu, is
     (K du)_u + S du_u + Q (K du)_k = h', S = D_uu^-1 P_uu, Q = D_uu^-1 D_uk: a
     row of K as all others. Of held unknowns k, y has what they do: K du_k. */
  template <int block>
  void
  BlockSystem<block>::add_node(const std::size_t i,
                               const NodeLaw    &law,
                               const Array      &y,
                               System           &system) const
  {
    AssertIndexRange(i, contact.size());
    const std::vector<int> &node = contact[i];
    std::vector<Index>      stays, known;
    NodeRows                rows;
    rows.node = i;
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
    AssertDimension(f.size(), n);
    System system;
    system.free  = exists;
    system.known = Array::Zero(n);
    for (std::size_t i = 0; i < contact.size(); ++i)
      for (Index k = 0; k < laws[i].h.size(); ++k)
        if (const NodeLaw &law = laws[i]; law.d.row(k).isZero(0))
          {
            // Such a law says what one unknown is: row k of P is diagonal.
            const int p     = contact[i][at(k)];
            system.free[p]  = 0;
            system.known[p] = law.h(k) / law.p(k, k);
          }
    // K u = K_uu u + K_uk u_k: what is held acts as a load on the rest.
    const Array y          = multiply_contact(system.known);
    system.right_hand_side = -f - y;
    for (std::size_t i = 0; i < contact.size(); ++i)
      add_node(i, laws[i], y, system);
    system.right_hand_side.array() *= system.free.array();
    system.free_float = system.free.template cast<float>();
    set_states(system);
    return system;
  }

  template <int block>
  void
  BlockSystem<block>::set_states(const System &system) const
  {
    std::vector<NodeState<block>> states;
    for (const std::vector<int> &places : contact)
      {
        const Index i = places[0] / block * block;
        states.push_back({(exists - system.free)
                            .template segment<block>(i)
                            .template cast<float>(),
                          FloatBlock::Zero()});
      }
    for (const NodeRows &rows : system.rows)
      {
        // Friction makes S unsymmetric, maybe indefinite. Smoother and levels
        // are those of symmetric positive matrices: they get that part of S.
        const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(
          .5 * (rows.S + rows.S.transpose()));
        const SmallMatrix positive =
          eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.).asDiagonal() *
          eigen.eigenvectors().transpose() / scale;
        FloatBlock &added = states[rows.node].added;
        for (std::size_t a = 0; a < rows.stays.size(); ++a)
          for (std::size_t b = 0; b < rows.stays.size(); ++b)
            added(rows.stays[a] % block, rows.stays[b] % block) +=
              static_cast<float>(
                positive(static_cast<Index>(a), static_cast<Index>(b)));
      }
    for (std::size_t i = 0; i < contact.size(); ++i)
      {
        const int node = contact[i][0] / block;
        D.set(at(node), inverse_block(node, system.free, states[i].added));
      }
    if (surface)
      {
        auto added = surface->no_blocks();
        for (std::size_t i = 0; i < contact.size(); ++i)
          if (const auto k = surface->find(contact[i][0] / block); k >= 0)
            added.col(k) = states[i].added.reshaped();
        surface->factorize(system.free, added);
      }
    if (levels)
      levels->set_states(states, is_hard);
  }

  /* y = K x becomes y_u + S x_u + Q y_k; rows of held unknowns, whose y_k this
     takes, become zero last. */
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

  /* A V-cycle for the symmetric part of the laws, without Q: GMRES makes up for
     the rest. */
  template <int block>
  void
  BlockSystem<block>::precondition(const System      &system,
                                   const FloatVector &b,
                                   FloatVector       &result) const
  {
    const auto multiply = [&](const FloatVector &x, FloatVector &y) {
      A.multiply(x.data(), y.data(), runs_of_A);
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
    const auto scaled =
      [&](const FloatVector &r, const auto &prepare, const auto &use) {
        if (!surface)
          return D.for_products(r, prepare, use);
        // As a whole, not in pieces: nodes of the surface are solved together.
        FloatVector &z = vectors.scaled;
        z.resize(n);
        prepare(0, n);
        D.multiply(r, z);
        surface->apply(r, z);
        use(0, z.head(n));
      };
    Chebyshev    smoother(multiply, scaled, largest, vectors.smoothing);
    FloatVector &r = vectors.r, &coarse = vectors.coarse;
    r = b;
    coarse.resize(n);
    smoother.smooth_first(r, result);
    r.array() *= system.free_float.array();
    if (levels)
      levels->correct(r, coarse);
    else
      coarse = whole.solve(r.cast<double>()).template cast<float>();
    result.array() += system.free_float.array() * coarse.array();
    smoother.smooth_last(b, r, result);
  }

  /* Iterative refinement: GMRES solves A x = r / |r| in single precision, the
     residual is made in double precision, which decides what is accurate. */
  template <int block>
  typename BlockSystem<block>::Step
  BlockSystem<block>::solve(const std::vector<NodeLaw> &laws,
                            const Array                &f,
                            const Precision            &precision) const
  {
    const System system = system_of(laws, f);
    Step         result{system.known};
    Array        x     = Array::Zero(n);
    Array        r     = system.right_hand_side;
    const double start = norm(r);
    const double goal =
      precision.relative *
      (precision.forces > 0 ? std::min(start, precision.forces) : start);
    const auto multiplied = [&](const FloatVector &z, FloatVector &w) {
      A.multiply(z.data(), w.data(), runs_of_A);
      add_laws(system, scale, z, w);
    };
    const auto preconditioned = [&](const FloatVector &v, FloatVector &z) {
      precondition(system, v, z);
    };
    double left = start, before = left;
    while (left > goal && result.iterations < most_iterations)
      {
        const FloatVector b = (r / left).template cast<float>();
        x += (left / scale) * gmres
                                .solve(b,
                                       std::max(goal / left, digits),
                                       multiplied,
                                       preconditioned,
                                       result.iterations)
                                .template cast<double>();
        before = left;
        r      = multiply(x);
        add_laws(system, 1., x, r);
        r    = system.right_hand_side - r;
        left = norm(r);
        if (!(left < .5 * before)) // rounding, or a hopeless system
          break;
      }
    result.du += x;
    result.error = start > 0 ? left / start : 0.;
    is_hard      = result.iterations > FlexibleGmres::cycle_length;
    return result;
  }
  template class BlockSystem<2>;
  template class BlockSystem<3>;
} // namespace conetact::iterative
