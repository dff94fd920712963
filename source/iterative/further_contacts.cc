// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/further_contacts.h"

#include "conetact/base/index.h"
#include "conetact/base/team.h"
#include "conetact/iterative/flexible_gmres.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <utility>

namespace conetact::iterative
{
  using Eigen::Index;
  using Eigen::VectorXd;
  using solvers::NodeLaw;

  std::vector<Index>
  FurtherContacts::unknowns_of(const std::vector<Index> &nodes) const
  {
    std::vector<Index> unknowns;
    for (const Index i : nodes)
      for (Index k = layout.first[at(i)]; k < layout.first[at(i) + 1]; ++k)
        unknowns.push_back(k);
    return unknowns;
  }

  /* The order of all unknowns: the system's but for contact, reactions r of
     further contacts (zero here), contact nodes as the layout numbers them. */
  VectorXd
  FurtherContacts::join(const VectorXd &u, const VectorXd &v) const
  {
    AssertDimension(u.size(), H.cols());
    const Index n = layout.n_unknowns(), m = v.size(), n_own = n - m;
    const Index elsewhere     = u.size() - n_own;
    VectorXd    all           = VectorXd::Zero(elsewhere + m + n), contact(n);
    contact(unknowns_of(own)) = u.tail(n_own);
    contact(unknowns_of(further)) = v;
    all.head(elsewhere)           = u.head(elsewhere);
    all.tail(n)                   = contact;
    return all;
  }

  VectorXd
  FurtherContacts::with_displacements(const VectorXd &u) const
  {
    return join(u, H * u);
  }

  VectorXd
  FurtherContacts::with_forces(const VectorXd &f) const
  {
    return join(f, VectorXd::Zero(H.rows()));
  }

  /* The reverse of join(): what the system itself has of all unknowns. */
  VectorXd
  FurtherContacts::without(const VectorXd &x) const
  {
    const Index n_own = layout.n_unknowns() - H.rows();
    VectorXd    u(H.cols());
    u.head(u.size() - n_own) = x.head(u.size() - n_own);
    const VectorXd contact   = x.tail(layout.n_unknowns());
    u.tail(n_own)            = contact(unknowns_of(own));
    return u;
  }

  /* They stand before the contact nodes, which are the last unknowns of any
     LargeSystem. */
  VectorXd
  FurtherContacts::reactions(const VectorXd &x) const
  {
    return x.segment(x.size() - layout.n_unknowns() - H.rows(), H.rows());
  }



  namespace
  {
    /**
     * A closed contact gives way by this times r over the stiffness of its node
     * in Newton's matrix, in solutions not at all. Where the other contact of
     * the node sticks, too, nothing else would tell what either of them
     * carries, and one that cannot hold the node is to see it.
     */
    constexpr double softness = 1e-3;

    /** u as the system has it, and what belongs to further contacts. */
    struct Joined : solvers::LargeVector
    {
      solvers::LargeSystem::Kept u;
      VectorXd                   r, v;
    };

    /**
     * The matrix of (u, r, v), in this order,
     * @f[ \begin{pmatrix} K & -H^T & 0\\ -k H & 0 & k\\ 0 & 1 & 0
     *     \end{pmatrix}, @f]
     * whose last row says that what acts on further contacts is r, and whose
     * second one is v = H u times the stiffness k of each node: a force, like
     * all imbalances, so that one norm measures all of them. The system that is
     * given has K + H^T S H in place of K: it is solved with reactions
     * @f$\tilde r = r + S H u@f$.
     */
    class WithFurtherContacts : public solvers::LargeSystem
    {
    public:
      WithFurtherContacts(std::shared_ptr<const LargeSystem> all,
                          FurtherContacts                    given)
        : system(std::move(all))
        , contacts(std::move(given))
        , H(contacts.H)
        , S(contacts.S)
        , n_contact(contacts.layout.n_unknowns())
        , n_elsewhere(H.cols() - n_contact + H.rows())
        , own_unknowns(contacts.unknowns_of(contacts.own))
        , unknowns(contacts.unknowns_of(contacts.further))
        , stiffness(find_stiffness())
      {}

      Index
      n_unknowns() const override
      {
        return n_elsewhere + H.rows() + n_contact;
      }
      Kept
      keep(const Array &x) const override
      {
        return make(system->keep(system->own(contacts.without(x))),
                    contacts.reactions(x),
                    x.tail(n_contact)(unknowns));
      }
      Array
      numbers(const Kept &x) const override
      {
        return whole(system->all(system->numbers(in(x).u)), in(x).r, in(x).v);
      }
      Array
      of_contact(const Kept &x) const override
      {
        Array contact(n_contact);
        contact(own_unknowns) = system->of_contact(in(x).u);
        contact(unknowns)     = in(x).v;
        return contact;
      }
      Kept
      add(const Kept &x, const double factor, const Kept &y) const override
      {
        return make(system->add(in(x).u, factor, in(y).u),
                    in(x).r + factor * in(y).r,
                    in(x).v + factor * in(y).v);
      }
      double
      product_elsewhere(const Kept &x, const Kept &y) const override
      {
        return system->product_elsewhere(in(x).u, in(y).u) +
               in(x).r.dot(in(y).r);
      }
      Kept
      multiply(const Kept &x) const override
      {
        const Array there = seen(in(x).u);
        return make(system->add(system->multiply(in(x).u),
                                -1,
                                of_reactions(in(x).r + S.cwiseProduct(there))),
                    stiffness.cwiseProduct(in(x).v - there),
                    in(x).r);
      }
      Array
      diagonal() const override
      {
        // A reaction has no stiffness, but its row is the imbalance k (v - H
        // u): that of its node lets it compare with forces.
        return whole(system->diagonal(), stiffness, stiffness);
      }
      std::optional<Step>
      solve(const std::vector<NodeLaw> &laws,
            const Kept                 &f,
            const Precision            &precision) const override;

    private:
      /** A linear system of Newton's method. */
      struct Newton
      {
        std::vector<NodeLaw> own, further;
        const Joined        &f;
        Precision            precision;
        unsigned int         iterations = 0;
        double               error      = 0;
        bool                 is_finite  = true;
      };

      static const Joined &
      in(const Kept &x)
      {
        return static_cast<const Joined &>(*x);
      }
      static Kept
      make(Kept u, Array r, Array v)
      {
        const auto made = std::make_shared<Joined>();
        made->u         = std::move(u);
        made->r         = std::move(r);
        made->v         = std::move(v);
        return made;
      }
      /** All unknowns, from those of the system and of further contacts. */
      Array
      whole(const Array &own, const Array &r, const Array &v) const
      {
        Array all                          = contacts.with_forces(own);
        all.segment(n_elsewhere, H.rows()) = r;
        auto contact                       = all.tail(n_contact);
        contact(unknowns)                  = v;
        return all;
      }
      /** H u. */
      Array
      seen(const Kept &u) const
      {
        return H * system->all(system->numbers(u));
      }
      /** H^T r. */
      Kept
      of_reactions(const Array &r) const
      {
        return system->keep(system->own(H.transpose() * r));
      }
      Array
      find_stiffness() const;
      std::vector<NodeLaw>
      laws_of(const std::vector<NodeLaw> &laws,
              const std::vector<Index>   &nodes) const;
      Kept
      answer(const Array &r, const bool is_loaded, Newton &newton) const;
      Array
      law_of(const Newton &newton, const Array &v, const Array &r) const;
      Array
      known_reactions(const Newton &newton, const Array &gap) const;
      Kept
      find_reactions(Newton &newton, Array &r) const;

      const std::shared_ptr<const LargeSystem> system;
      const FurtherContacts                    contacts;
      const FurtherContacts::Rows             &H;
      const Array                             &S;
      const Index              n_contact, n_elsewhere; ///< unknowns
      const std::vector<Index> own_unknowns, unknowns; ///< of contact nodes
      const Array              stiffness;              ///< along each row of H
    };

    /* The mean of the diagonal of K over the unknowns that a node sees, weighed
       with squares of H. One number for all rows of a node, so that forces and
       displacements keep their directions. */
    VectorXd
    WithFurtherContacts::find_stiffness() const
    {
      const Array diagonal = system->diagonal();
      Array       result(H.rows());
      Index       row = 0;
      for (const Index i : contacts.further)
        {
          const Index n =
            contacts.layout.first[at(i) + 1] - contacts.layout.first[at(i)];
          double sum = 0, squares = 0;
          for (Index k = row; k < row + n; ++k)
            for (FurtherContacts::Rows::InnerIterator entry(H, k); entry;
                 ++entry)
              {
                const double square = entry.value() * entry.value();
                sum += square * diagonal[entry.col()];
                squares += square;
              }
          result.segment(row, n).setConstant(squares > 0 ? sum / squares :
                                                           diagonal.mean());
          row += n;
        }
      return result;
    }

    std::vector<NodeLaw>
    WithFurtherContacts::laws_of(const std::vector<NodeLaw> &laws,
                                 const std::vector<Index>   &nodes) const
    {
      std::vector<NodeLaw> result;
      for (const Index i : nodes)
        result.push_back(laws[at(i)]);
      return result;
    }

    /* The change of u that r + S H u makes, which is r here: K du = H^T r - f
       elsewhere with the K of the system, and the laws of the other contacts,
       which are those of their reactions K du - H^T r:
       P du + D (K du) = h + D H^T r. Without loads, h = 0 and f = 0: the answer
       is linear in r, and its precision has no force to refer to. */
    solvers::LargeSystem::Kept
    WithFurtherContacts::answer(const Array &r,
                                const bool   is_loaded,
                                Newton      &newton) const
    {
      const Array          forces = H.transpose() * r;
      std::vector<NodeLaw> laws   = newton.own;
      Index first = H.cols() - static_cast<Index>(own_unknowns.size());
      for (NodeLaw &law : laws)
        {
          const Index n = law.h.size();
          if (!is_loaded)
            law.h.setZero();
          law.h += law.d * forces.segment(first, n);
          first += n;
        }
      Kept f = system->keep(system->own(-forces));
      if (is_loaded)
        f = system->add(newton.f.u, 1, f);
      Precision precision = newton.precision;
      if (!is_loaded)
        precision.forces = 0;
      const auto step = system->solve(laws, f, precision);
      newton.is_finite &= step.has_value();
      if (!step)
        return system->keep(Array::Zero(system->n_own()));
      newton.iterations += step->iterations;
      newton.error = std::max(newton.error, step->error);
      return step->du;
    }

    /* P dv + D dr of the further contacts. Rows with D = 0 say where a node is:
       they become softer. */
    VectorXd
    WithFurtherContacts::law_of(const Newton &newton,
                                const Array  &v,
                                const Array  &r) const
    {
      Array result(H.rows());
      Index row = 0;
      for (const NodeLaw &law : newton.further)
        {
          const Index n = law.h.size();
          result.segment(row, n) =
            law.p * v.segment(row, n) + law.d * r.segment(row, n);
          for (Index k = 0; k < n; ++k)
            if (law.d.row(k).isZero(0))
              result[row + k] += softness * r[row + k];
          row += n;
        }
      return result;
    }

    /* r + S v of contacts whose law is P = D S, whatever u: those that are
       open, S = 0, or give way by S; 0 of others. */
    VectorXd
    WithFurtherContacts::known_reactions(const Newton &newton,
                                         const Array  &gap) const
    {
      constexpr double rounding = 1e-12;
      Array            result   = Array::Zero(H.rows());
      Index            row      = 0;
      for (const NodeLaw &law : newton.further)
        {
          const Index n = law.h.size();
          if ((law.p - law.d * S.segment(row, n).asDiagonal()).norm() <=
              rounding * law.p.norm())
            result.segment(row, n) =
              law.d.inverse() * (law.h + law.p * gap.segment(row, n));
          row += n;
        }
      return result;
    }

    /* GMRES in single precision gains some digits at a time. Its matrix is r ->
       P H u(r) + D (r - S H u(r)), each product a solution of the system. What
       the result changes of u needs none more: by linearity it is made of the
       answers that were asked for, which are kept, a vector of all unknowns for
       each iteration of a cycle. */
    solvers::LargeSystem::Kept
    WithFurtherContacts::find_reactions(Newton &newton, Array &r) const
    {
      constexpr double       digits = 1e-4;
      constexpr unsigned int most   = 3; // cycles
      const Array            gap    = newton.f.r.cwiseQuotient(stiffness);
      Array                  h(H.rows());
      Index                  row = 0;
      for (const NodeLaw &law : newton.further)
        {
          h.segment(row, law.h.size()) = law.h;
          row += law.h.size();
        }
      Array      with_springs = known_reactions(newton, gap);
      const auto without = [&](const Array &reactions, const Array &there) {
        return Array(reactions - S.cwiseProduct(there));
      };
      // Reactions of further contacts are few, and each process has all of
      // them: it iterates by itself. Messages are those of product().
      FlexibleGmres                       gmres((Communicator()));
      std::vector<std::pair<Array, Kept>> responses; // to changes of reactions
      const auto product = [&](const FloatVector &x, FloatVector &y) {
        const Array change = x.cast<double>();
        const Kept  du     = answer(change, false, newton);
        const Array there  = seen(du);
        responses.emplace_back(change, du);
        y = law_of(newton, there, without(change, there)).cast<float>();
      };
      const auto as_it_is = [](const FloatVector &x, FloatVector &y) { y = x; };
      Kept       du       = answer(with_springs, true, newton);
      double     start    = h.norm();
      for (unsigned int i = 0;; ++i)
        {
          const Array there = seen(du);
          r                 = without(with_springs, there);
          const Array  left = h - law_of(newton, there - gap, r);
          const double size = left.norm();
          start             = std::max(start, size);
          const double goal = newton.precision.relative * start;
          if (i == most || !(size > goal) || !newton.is_finite)
            return du;
          unsigned int iterations = 0;
          responses.clear();
          Array part = size * gmres
                                .solve((left / size).cast<float>(),
                                       std::max(goal / size, digits),
                                       product,
                                       as_it_is,
                                       iterations)
                                .cast<double>();
          // Machines may have rounded in different ways, and how often the loop
          // runs decides on messages: all take the numbers of the first
          // process.
          team().broadcast(part);
          // The changes are Krylov's vectors, as nothing preconditions them:
          // orthonormal, and parts of r along them are scalar products.
          for (const auto &[change, response] : responses)
            {
              const double much = change.dot(part);
              with_springs += much * change;
              du = system->add(du, much, response);
            }
          newton.is_finite &= with_springs.allFinite();
        }
    }

    std::optional<solvers::LargeSystem::Step>
    WithFurtherContacts::solve(const std::vector<NodeLaw> &laws,
                               const Kept                 &f,
                               const Precision            &precision) const
    {
      Newton     newton{laws_of(laws, contacts.own),
                    laws_of(laws, contacts.further),
                    in(f),
                    precision};
      Array      r;
      const Kept du = find_reactions(newton, r);
      if (!newton.is_finite)
        return {};
      // The imbalance of v = H u goes in this step, too.
      const Array v = seen(du) - in(f).r.cwiseQuotient(stiffness);
      return Step{make(du, r, v), newton.iterations, newton.error};
    }
  } // namespace



  std::shared_ptr<const solvers::LargeSystem>
  make_with_further_contacts(std::shared_ptr<const solvers::LargeSystem> system,
                             FurtherContacts                             given)
  {
    return std::make_shared<WithFurtherContacts>(std::move(system),
                                                 std::move(given));
  }
} // namespace conetact::iterative
