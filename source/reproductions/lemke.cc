// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/reproductions/lemke.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <utility>

namespace conetact::reproductions
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** Tables of up to this many rows are shown in full. */
    constexpr Index small_table = 12;

    /** A pair x, z of the complementarity problem. */
    struct Pair
    {
      Index node;
      int   side; ///< 0: normal, else slip along +t or -t
    };

    std::string
    number(const double x, const char *format = "%11.5g")
    {
      char text[32];
      std::snprintf(text, sizeof(text), format, x);
      return text;
    }



    class Lemke : public load_path::PathFollower
    {
    public:
      Lemke(std::shared_ptr<const solvers::ContactSystem> s,
            load_path::PathOptions                        path,
            LemkeOptions                                  o);

      load_path::PathResult
      follow(const load_path::PathStage   &stage,
             const load_path::PathVisitor &visit) override;

    private:
      // columns: x, z, p, then the constant part and the tightening
      Index
      p_column() const
      {
        return 2 * n;
      }
      VectorXd
      right_hand_side() const
      {
        return table.col(2 * n + 1) + table.col(2 * n + 2);
      }
      VectorXd
      in_pairs(const VectorXd &forces) const;
      void
      set_up(const load_path::PathStage &stage);
      Index
      leading_row(const Index column) const;
      void
      pivot(const Index row, const Index column);
      load_path::PathPoint
      point(const VectorXd &basic) const;
      load_path::PathState
      state(const Index node) const;
      void
      finish(const load_path::PathStage   &stage,
             const Index                   column,
             const bool                    ray,
             const load_path::PathVisitor &visit,
             load_path::PathResult        &result);

      std::string
      name(const Index variable) const;
      void
      say(const std::string &line) const;
      void
      show_table() const;

      std::shared_ptr<const solvers::ContactSystem> system;
      load_path::PathOptions                        path_options;
      LemkeOptions                                  options;
      std::vector<Pair>                             pairs;
      Index                                         n;
      MatrixXd                                      R, table;
      std::vector<Index> basis;  ///< variable of each row
      std::vector<bool>  active; ///< z of a pair is not zero
    };



    Lemke::Lemke(std::shared_ptr<const solvers::ContactSystem> s,
                 load_path::PathOptions                        path,
                 LemkeOptions                                  o)
      : system(std::move(s))
      , path_options(std::move(path))
      , options(std::move(o))
    {
      if (system->form != solvers::Form::stiffness)
        throw std::invalid_argument("Lemke's method needs the stiffness form.");
      for (Index i = 0; i < system->n_nodes(); ++i)
        if (system->n_tangents(i) > 1)
          throw std::invalid_argument("Lemke's method is for two dimensions.");
      for (const int side : {0, 1, -1})
        for (Index i = 0; i < system->n_nodes(); ++i)
          if (side == 0 || system->n_tangents(i) == 1)
            pairs.push_back({i, side});
      n = static_cast<Index>(pairs.size());
      R.resize(n, n);
      for (Index j = 0; j < n; ++j)
        {
          const Pair p = pairs[static_cast<std::size_t>(j)];
          R.col(j) =
            p.side == 0 ?
              in_pairs(system->matrix.col(system->normal(p.node))) :
              VectorXd(p.side *
                       in_pairs(system->matrix.col(system->first[p.node])));
        }
    }



    /** x of the reactions r; linear. */
    VectorXd
    Lemke::in_pairs(const VectorXd &r) const
    {
      VectorXd x(n);
      for (Index a = 0; a < n; ++a)
        {
          const Pair p = pairs[static_cast<std::size_t>(a)];
          x(a)         = r(system->normal(p.node));
          if (p.side != 0)
            x(a) =
              system->mu(p.node) * x(a) + p.side * r(system->first[p.node]);
        }
      return x;
    }



    void
    Lemke::set_up(const load_path::PathStage &stage)
    {
      table.resize(n, 2 * n + 3);
      table.leftCols(n).setIdentity();
      table.middleCols(n, n)    = -R;
      table.col(p_column())     = in_pairs(stage.rate);
      table.col(p_column() + 1) = in_pairs(-stage.load);
      table.col(p_column() + 2).setConstant(options.weight);
      if (path_options.cohesion.size() > 0)
        for (Index a = 0; a < n; ++a)
          if (const Pair p = pairs[static_cast<std::size_t>(a)]; p.side != 0)
            table(a, p_column() + 1) += path_options.cohesion(p.node);
      basis.clear();
      for (Index a = 0; a < n; ++a)
        basis.push_back(a);
      active.assign(pairs.size(), false);
    }



    /** The row whose basic variable vanishes first; -1: a ray. */
    Index
    Lemke::leading_row(const Index column) const
    {
      const VectorXd b = right_hand_side();
      const double   zero =
        options.accuracy *
        std::max(1e-300, table.col(column).cwiseAbs().maxCoeff());
      double smallest = std::numeric_limits<double>::infinity();
      Index  result   = -1;
      for (Index i = 0; i < n; ++i)
        if (table(i, column) > zero)
          {
            const double ratio = std::max(0., b(i)) / table(i, column);
            if (ratio < smallest)
              {
                smallest = ratio;
                result   = i;
              }
          }
      return result;
    }



    void
    Lemke::pivot(const Index row, const Index column)
    {
      table.row(row) /= table(row, column);
      const Eigen::RowVectorXd lead = table.row(row);
      VectorXd                 c    = table.col(column);
      c(row)                        = 0;
      table.noalias() -= c * lead;
      basis[static_cast<std::size_t>(row)] = column;
    }



    load_path::PathState
    Lemke::state(const Index node) const
    {
      bool open = false;
      int  slip = 0;
      for (std::size_t a = 0; a < pairs.size(); ++a)
        if (active[a] && pairs[a].node == node)
          {
            open = open || pairs[a].side == 0;
            slip += pairs[a].side;
          }
      if (open)
        return slip == 0 ? load_path::PathState::open :
               slip > 0  ? load_path::PathState::open_plus :
                           load_path::PathState::open_minus;
      return slip == 0 ? load_path::PathState::stick :
             slip > 0  ? load_path::PathState::slip_plus :
                         load_path::PathState::slip_minus;
    }



    /** Displacements and reactions where the basic variables have values. */
    load_path::PathPoint
    Lemke::point(const VectorXd &basic) const
    {
      VectorXd x = VectorXd::Zero(2 * n + 1);
      for (Index i = 0; i < n; ++i)
        x(basis[static_cast<std::size_t>(i)]) = basic(i);
      load_path::PathPoint result;
      result.v = VectorXd::Zero(system->n_unknowns());
      result.r = result.v;
      for (Index a = 0; a < n; ++a)
        {
          const Pair  p = pairs[static_cast<std::size_t>(a)];
          const Index u =
            p.side == 0 ? system->normal(p.node) : system->first[p.node];
          result.v(u) += (p.side < 0 ? -1 : 1) * x(n + a);
          // r_t = (x+ - x-) / 2
          result.r(u) += p.side == 0 ? x(a) : .5 * p.side * x(a);
        }
      for (Index i = 0; i < system->n_nodes(); ++i)
        result.state.push_back(state(i));
      return result;
    }



    std::string
    Lemke::name(const Index variable) const
    {
      if (variable == p_column())
        return "p";
      const Pair  p = pairs[static_cast<std::size_t>(variable % n)];
      std::string result(1, variable < n ? 'x' : 'z');
      result += p.side == 0 ? "n" : "t";
      result += std::to_string(p.node + 1);
      return p.side == 0 ? result : result + (p.side > 0 ? "+" : "-");
    }



    void
    Lemke::say(const std::string &line) const
    {
      if (options.log)
        options.log(line);
    }



    void
    Lemke::show_table() const
    {
      if (n > small_table || !options.log)
        return;
      std::string head = "basis     ";
      for (Index j = 0; j <= p_column(); ++j)
        head += std::string(11 - name(j).size(), ' ') + name(j);
      say(head + "       Rc+Fc");
      const VectorXd b = right_hand_side();
      for (Index i = 0; i < n; ++i)
        {
          std::string line = name(basis[static_cast<std::size_t>(i)]);
          line.resize(10, ' ');
          for (Index j = 0; j <= p_column(); ++j)
            line += number(table(i, j));
          say(line + number(b(i)));
        }
    }



    /** Takes p out of the basis; `column` would have entered. */
    void
    Lemke::finish(const load_path::PathStage   &stage,
                  const Index                   column,
                  const bool                    ray,
                  const load_path::PathVisitor &visit,
                  load_path::PathResult        &result)
    {
      const auto found = std::find(basis.begin(), basis.end(), p_column());
      const auto row   = found - basis.begin();
      const bool stays = found == basis.end();
      if (!stays)
        {
          const double zero =
            options.accuracy * table.col(column).cwiseAbs().maxCoeff();
          if (std::abs(table(row, column)) <= zero)
            {
              say(
                "ray, the leading element in the row of p is zero: mechanism");
              const VectorXd rates = -table.col(column);
              result.outcome       = load_path::PathOutcome::limit_load;
              result.mechanism     = point(rates).v;
              if (column >= n && column < 2 * n)
                {
                  const Pair  p = pairs[static_cast<std::size_t>(column - n)];
                  const Index u = p.side == 0 ? system->normal(p.node) :
                                                system->first[p.node];
                  result.mechanism(u) += p.side < 0 ? -1 : 1;
                }
              result.mechanism /= result.mechanism.lpNorm<Eigen::Infinity>();
              return;
            }
          pivot(row, column);
          show_table();
        }
      say(ray ? "criterion 2: a ray, no further change" :
                "criterion 1: p has passed its target");
      // without the tightening
      load_path::PathPoint end =
        point(table.col(p_column() + 1) -
              (stage.end - stage.begin) * table.col(p_column()));
      end.parameter               = stage.end;
      load_path::PathPoint before = end;
      end.residual =
        load_path::path_residual(*system,
                                 path_options,
                                 stage.load +
                                   (stage.end - stage.begin) * stage.rate,
                                 before,
                                 end);
      if (visit)
        visit(end);
      result.outcome   = ray ? load_path::PathOutcome::no_further_change :
                               load_path::PathOutcome::target_reached;
      result.parameter = stage.end;
    }



    load_path::PathResult
    Lemke::follow(const load_path::PathStage   &stage,
                  const load_path::PathVisitor &visit)
    {
      load_path::PathResult result;
      result.parameter = stage.begin;
      set_up(stage);
      if (right_hand_side().minCoeff() < 0)
        {
          result.reason =
            "The constant loads open or move contact nodes, where "
            "Lemke's method must start with all of them stuck. "
            "Take a larger tightening weight, or load path.";
          return result;
        }
      show_table();
      double length = 0;
      Index  column = p_column();
      for (Index k = 1; k <= 50 * n + 100; ++k)
        {
          const Index row = leading_row(column);
          if (row < 0)
            {
              finish(stage, column, true, visit, result);
              return result;
            }
          const auto found  = std::find(basis.begin(), basis.end(), p_column());
          const double step = right_hand_side()(row) / table(row, column);
          const double next =
            found == basis.end() ?
              step :
              length - step * table(found - basis.begin(), column);
          if (next > stage.end - stage.begin)
            {
              finish(stage, column, false, visit, result);
              return result;
            }
          const Index left = basis[static_cast<std::size_t>(row)];
          if (left == p_column())
            {
              result.reason = "The load parameter of Lemke's method has come "
                              "back to its start.";
              return result;
            }
          length                          = next;
          result.parameter                = stage.begin + length;
          const Index                pair = left % n;
          const load_path::PathState from =
            state(pairs[static_cast<std::size_t>(pair)].node);
          pivot(row, column);
          say("step " + std::to_string(k) +
              ": p = " + number(result.parameter, "%.15g") + ", " + name(left) +
              " leaves, " + name(column) + " has entered");
          show_table();
          active[static_cast<std::size_t>(pair)] = left < n;
          load_path::PathPoint event             = point(right_hand_side());
          event.parameter                        = result.parameter;
          const Index node = pairs[static_cast<std::size_t>(pair)].node;
          event.changes    = {{node, from, state(node)}};
          if (visit)
            visit(event);
          column = left < n ? left + n : left - n;
        }
      result.reason = "Lemke's method makes pivots without end.";
      return result;
    }
  } // namespace



  std::unique_ptr<load_path::PathFollower>
  make_lemke_follower(std::shared_ptr<const solvers::ContactSystem> system,
                      const load_path::PathOptions &path_options,
                      const LemkeOptions           &options)
  {
    return std::make_unique<Lemke>(std::move(system), path_options, options);
  }
} // namespace conetact::reproductions
