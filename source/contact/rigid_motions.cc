// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/rigid_motions.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/unseen_motions.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /** Translations and rotations of a body: 3 in the plane, 6 in space. */
    constexpr Eigen::Index
    n_modes(const unsigned int dim)
    {
      return dim == 2 ? 3 : 6;
    }

    Tensor<1, 3>
    axis(const unsigned int k)
    {
      Tensor<1, 3> e;
      e[k] = 1;
      return e;
    }

    /** Whether mode k is one of a body of revolution round y. */
    bool
    is_axial(const unsigned int k)
    {
      return k == 1;
    }

    /**
     * Mode k of a body at p; rotations move its rim by about 1. What strains a
     * body of revolution is no motion: nothing.
     */
    Tensor<1, 3>
    mode(const unsigned int          k,
         const unsigned int          dim,
         const RigidMotions::Motion &frame,
         const Point<3>             &p)
    {
      if (frame.axisymmetric && !is_axial(k))
        return Tensor<1, 3>();
      if (k < dim)
        return axis(k);
      const Tensor<1, 3> about = axis(dim == 2 ? 2 : k - dim);
      return cross_product_3d(about, p - frame.centre) / frame.size;
    }

    Tensor<1, 3>
    displacement(const RigidMotions::Motion &motion, const Point<3> &p)
    {
      return motion.translation +
             cross_product_3d(motion.rotation, p - motion.centre);
    }

    RigidMotions::Motion
    frame_of(const Bodies &bodies, const unsigned int body)
    {
      const bodies::Structure &structure = *bodies.structures[body];
      RigidMotions::Motion     frame{
        body, structure.is_axisymmetric(), {}, {}, {}, 0};
      const unsigned int n = structure.n_nodes();
      if (bodies.is_rigid(body))
        frame.centre = structure.position(0); // its reference point
      for (unsigned int i = 0; i < n && !bodies.is_rigid(body); ++i)
        // Any point near the middle of the nodes will do.
        frame.centre += Tensor<1, 3>(structure.position(i)) / n;
      for (unsigned int i = 0; i < n; ++i)
        frame.size =
          std::max(frame.size, structure.position(i).distance(frame.centre));
      if (frame.size == 0)
        frame.size = 1; // an obstacle without extent: any lever will do
      return frame;
    }

    /** Eigenvalues of a sum of squares below this part of the largest are 0. */
    constexpr double rank_limit = 1e-12;

    struct Split
    {
      Eigen::MatrixXd null, range, pseudo_inverse;
    };

    /** The null space of a symmetric positive semidefinite matrix, and more. */
    Split
    split(const Eigen::MatrixXd &gram)
    {
      Split result{gram, gram, gram};
      if (gram.rows() == 0)
        return result;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
      // At least over 1, the square of a direction: where nothing is held the
      // largest eigenvalue is 0.
      const double limit =
        rank_limit * std::max(1., eigen.eigenvalues().maxCoeff());
      Eigen::Index n_null = 0;
      while (n_null < gram.rows() && eigen.eigenvalues()[n_null] < limit)
        ++n_null;
      const Eigen::Index    rank = gram.rows() - n_null;
      const Eigen::MatrixXd V    = eigen.eigenvectors().rightCols(rank);
      result.null                = eigen.eigenvectors().leftCols(n_null);
      result.range               = V;
      // Without the free motions: of all placements that fit the supports the
      // smallest.
      result.pseudo_inverse =
        V * eigen.eigenvalues().tail(rank).cwiseInverse().asDiagonal() *
        V.transpose();
      return result;
    }

    /** Modes that move no node are no motions, such as the spin of a bar. */
    Eigen::MatrixXd
    moving_nothing(const Bodies &bodies, const RigidMotions::Motion &frame)
    {
      const bodies::Structure &structure = *bodies.structures[frame.body];
      const Eigen::Index       n         = n_modes(bodies.dim);
      if (!structure.may_be_mechanism()) // nor is it a bar
        return {n, 0};
      Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(n, n);
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        {
          Eigen::MatrixXd modes(3, n);
          for (Eigen::Index k = 0; k < n; ++k)
            {
              const Tensor<1, 3> u = mode(static_cast<unsigned int>(k),
                                          bodies.dim,
                                          frame,
                                          structure.position(i));
              modes.col(k) << u[0], u[1], u[2];
            }
          moved += modes.transpose() * modes;
          for (unsigned int c = bodies.dim; c < structure.n_components(); ++c)
            if (structure.has_dof(i, c))
              moved(c, c) += 1;
        }
      return split(moved).null;
    }

    std::string
    direction_text(Tensor<1, 3> v)
    {
      v /= v.norm();
      for (unsigned int d = 0; d < 3; ++d)
        v[d] = std::round(1e4 * v[d]) / 1e4;
      for (unsigned int d = 3; d-- > 0;)
        if (v[d] != 0)
          return to_text(v);
      return to_text(v);
    }
  } // namespace

  RigidMotions::RigidMotions(const Bodies        &b,
                             const NodeRules     &r,
                             const ContactPoints &points,
                             const Coordinates   &coordinates)
    : bodies(b)
    , rules(r)
    , n_one(n_modes(b.dim))
  {
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        frames.push_back(frame_of(bodies, body));
        offset.push_back(coordinates.offset(body));
      }
    offset.push_back(coordinates.n_dofs());
    find_again(points);
    refuse_loose_bodies();
  }

  void
  RigidMotions::find_again(const ContactPoints &points)
  {
    find_held_and_free();
    tie(points);
    find_resisted();
    multiply_free();
    see_contacts(points);
  }

  /* What each mode moves the point p by, along a direction. */
  Eigen::RowVectorXd
  RigidMotions::row(const unsigned int  body,
                    const Point<3>     &p,
                    const Tensor<1, 3> &direction) const
  {
    AssertIndexRange(body, frames.size());
    Eigen::RowVectorXd result(n_one);
    for (unsigned int k = 0; k < n_one; ++k)
      result[k] = direction * mode(k, bodies.dim, frames[body], p);
    return result;
  }

  RigidMotions::Tie
  RigidMotions::make_tie(const pairing::ContactNode &node,
                         const Tensor<1, 3>         &direction) const
  {
    Tie tied{&node, direction, {}};
    pairing::for_each_side(node,
                           [&](const unsigned int body,
                               const unsigned int number,
                               const double       weight) {
                             tied.rows
                               .emplace(body, Eigen::RowVectorXd::Zero(n_one))
                               .first->second +=
                               row(body,
                                   bodies.structures[body]->position(number),
                                   weight * direction);
                           });
    return tied;
  }

  double
  RigidMotions::relative(const Tie &tied, const Amounts &amounts) const
  {
    AssertDimension(amounts.size(), held.rows());
    double sum = 0;
    for (const auto &[body, r] : tied.rows)
      sum += r.dot(amounts.segment(body * n_one, n_one));
    return sum;
  }

  void
  RigidMotions::add(const double factor, const Tie &tied, Amounts &sum) const
  {
    AssertDimension(sum.size(), held.rows());
    for (const auto &[body, r] : tied.rows)
      sum.segment(body * n_one, n_one) += factor * r.transpose();
  }

  /* Rows e . R of all held directions: their squares summed make a small matrix
     whose null space are the motions that no support resists. Rotations count
     in lengths, so that its eigenvalues compare. */
  void
  RigidMotions::find_held_and_free()
  {
    const auto  n_bodies = static_cast<Index>(frames.size());
    const Index n        = n_one * n_bodies;
    held                 = Eigen::MatrixXd::Zero(n, n);
    held_inverse         = held;
    for (const NodeRule &rule : rules.rules())
      {
        const Index first = rule.body * n_one;
        for (const HeldDirection &h : rule.held)
          {
            const Eigen::RowVectorXd e =
              row(rule.body,
                  bodies.structures[rule.body]->position(rule.node),
                  h.direction);
            held.block(first, first, n_one, n_one) += e.transpose() * e;
          }
        for (const NodeRule::HeldRotation &h : rule.rotations)
          // A rotation moves the rim by 1.
          held(first + h.component, first + h.component) += 1;
      }
    for (Index body = 0; body < n_bodies; ++body)
      if (frames[static_cast<std::size_t>(body)].axisymmetric)
        for (unsigned int k = 0; k < n_one; ++k)
          if (!is_axial(k)) // neither free nor ever moved
            held(body * n_one + k, body * n_one + k) = 1;
    hold_locked();
    for (Index body = 0; body < n_bodies; ++body)
      {
        const Eigen::MatrixXd none =
          moving_nothing(bodies, frames[static_cast<std::size_t>(body)]);
        held.block(body * n_one, body * n_one, n_one, n_one) +=
          none * none.transpose();
      }
    own_modes = Eigen::MatrixXd(n, 0);
    own_body.clear();
    for (Index body = 0; body < n_bodies; ++body)
      {
        const Index first = body * n_one;
        // Rank is a matter of each body alone.
        const Split parts = split(held.block(first, first, n_one, n_one));
        held_inverse.block(first, first, n_one, n_one) = parts.pseudo_inverse;
        const Index k                                  = own_modes.cols();
        own_modes.conservativeResize(n, k + parts.null.cols());
        own_modes.rightCols(parts.null.cols()).setZero();
        own_modes.block(first, k, n_one, parts.null.cols()) = parts.null;
        own_body.insert(own_body.end(),
                        static_cast<std::size_t>(parts.null.cols()),
                        static_cast<unsigned int>(body));
      }
  }

  void
  RigidMotions::hold_locked()
  {
    for (const Cut &cut : bodies.cuts)
      if (cut.opening)
        {
          const Index              first = cut.body * n_one;
          const Eigen::RowVectorXd e =
            row(cut.body, frames[cut.body].centre, cut.axis);
          held.block(first, first, n_one, n_one) += e.transpose() * e;
        }
  }

  /* Where nothing is tied all own motions are free, as they are. */
  void
  RigidMotions::tie(const ContactPoints &points)
  {
    ties.clear();
    free_body.clear();
    for (std::size_t i = points.size(); i < points.all().size(); ++i)
      {
        const contact::ContactPoint &point = points.all()[i];
        // as it was at the start: those that are found again are replaced
        const pairing::ContactNode &node =
          bodies.contact_nodes[static_cast<std::size_t>(point.node -
                                                        points.nodes().data())];
        for (const Tensor<1, 3> &direction : point.dual)
          ties.push_back(make_tie(node, direction));
      }
    find_assemblies();
    const Index k = own_modes.cols();
    if (ties.empty())
      {
        free_modes = own_modes;
        free_body  = own_body;
        free_parts = Eigen::MatrixXd::Identity(k, k);
        tied_parts = Eigen::MatrixXd(k, 0);
        return;
      }
    free_parts = tied_parts = Eigen::MatrixXd(k, 0);
    std::vector<std::vector<unsigned int>> assemblies(frames.size());
    for (unsigned int body = 0; body < frames.size(); ++body)
      assemblies[tied_with[body]].push_back(body);
    for (const auto &assembly : assemblies)
      if (!assembly.empty())
        find_tied(assembly);
    free_modes = own_modes * free_parts;
  }

  /* Each body counts for the first of those it is joined with. */
  void
  RigidMotions::find_assemblies()
  {
    tied_with.clear();
    for (unsigned int body = 0; body < frames.size(); ++body)
      tied_with.push_back(body);
    for (const Tie &tied : ties)
      for (const auto &[body, r] : tied.rows)
        {
          const unsigned int one   = tied_with[tied.node->body];
          const unsigned int other = tied_with[body];
          std::replace(tied_with.begin(),
                       tied_with.end(),
                       std::max(one, other),
                       std::min(one, other));
        }
  }

  /* Placements fit supports and ties; what both leave open is free. */
  void
  RigidMotions::find_tied(const std::vector<unsigned int> &assembly)
  {
    std::vector<Index> modes, own;
    const auto         is_locked = [&](const unsigned int body) {
      return std::any_of(bodies.cuts.begin(),
                         bodies.cuts.end(),
                         [&](const Cut &cut) {
                           return cut.opening && cut.body == body;
                         });
    };
    for (const unsigned int body : assembly)
      for (Index k = 0; k < n_one && !is_locked(body); ++k)
        modes.push_back(body * n_one + k);
    for (Index j = 0; j < own_modes.cols(); ++j)
      if (tied_with[own_body[static_cast<std::size_t>(j)]] == assembly.front())
        own.push_back(j);
    const auto      n    = static_cast<Index>(modes.size());
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
    for (const Tie &tied : ties)
      if (tied_with[tied.node->body] == assembly.front())
        {
          Amounts all = Amounts::Zero(held.rows());
          add(1, tied, all);
          const Eigen::VectorXd r = all(modes);
          gram += r * r.transpose();
        }
    held_inverse(modes, modes) =
      split(Eigen::MatrixXd(held(modes, modes)) + gram).pseudo_inverse;
    const Eigen::MatrixXd R     = own_modes(modes, own);
    const Split           parts = split(R.transpose() * gram * R);
    const auto append = [&](Eigen::MatrixXd &to, const Eigen::MatrixXd &what) {
      to.conservativeResize(own_modes.cols(), to.cols() + what.cols());
      to.rightCols(what.cols()).setZero();
      to(own, Eigen::lastN(what.cols())) = what;
    };
    append(free_parts, parts.null);
    append(tied_parts, parts.range);
    free_body.insert(free_body.end(),
                     static_cast<std::size_t>(parts.null.cols()),
                     assembly.front());
  }

  /* The same with springs: free motions are turned so that foundations resist
     some and do not see the others, which are told apart once for all: later
     on what a foundation does not see would be rounding. Only whether, not how
     strongly, matters here: stiffnesses are left out, or soft springs would be
     taken for none. */
  void
  RigidMotions::find_resisted()
  {
    Eigen::MatrixXd springs = Eigen::MatrixXd::Zero(held.rows(), held.cols());
    for (const bodies::Support &support : bodies.supports)
      if (support.stiffness)
        for (const bodies::SurfaceNode &node : support.surface.nodes)
          if ((*support.stiffness)(node.position) > 0)
            for (const bodies::Support::Held &along :
                 support.directions_at(node))
              {
                const Eigen::RowVectorXd r =
                  row(support.body, node.position, along.direction);
                const Index first = support.body * n_one;
                springs.block(first, first, n_one, n_one) += r.transpose() * r;
              }
    const Index     k      = free_modes.cols();
    Eigen::MatrixXd turned = Eigen::MatrixXd::Identity(k, k);
    loose_motions.clear();
    for (Index begin = 0, n = 0; begin < k; begin += n)
      {
        const auto body = free_body.begin() + begin;
        n               = std::find_if(body,
                         free_body.end(),
                         [&](const unsigned int b) { return b != *body; }) -
            body;
        const Eigen::MatrixXd one   = free_modes.middleCols(begin, n);
        const Split           parts = split(one.transpose() * springs * one);
        const Index           none  = parts.null.cols();
        if (none > 0 && none < n)
          turned.block(begin, begin, n, n) << parts.null, parts.range;
        for (Index j = 0; j < none; ++j)
          loose_motions.push_back(begin + j);
      }
    free_modes *= turned;
    if (ties.empty())
      own_modes = free_modes;
    else
      free_parts *= turned;
    without_springs =
      Eigen::MatrixXd::Identity(k, k)(Eigen::all, loose_motions);
  }

  /* One motion of all bodies at a time: they do not see each other. */
  void
  RigidMotions::multiply_free()
  {
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(held.rows(), held.cols());
    for (Index k = 0; k < n_one && free_modes.cols() > 0; ++k)
      {
        Amounts one = none();
        for (Index first = 0; first < one.size(); first += n_one)
          one[first + k] = 1;
        const Amounts products = resultants(field(one));
        for (Index first = 0; first < one.size(); first += n_one)
          gram.col(first + k).segment(first, n_one) =
            products.segment(first, n_one);
      }
    free_factors.compute(free_modes.transpose() * gram * free_modes);
    for (std::size_t body = 0; body < frames.size(); ++body)
      if (const Index first = static_cast<Index>(body) * n_one;
          bodies.is_rigid(body))
        gram.block(first, first, n_one, n_one).setIdentity();
    free_products = free_modes.transpose() * gram * free_modes;
  }

  /* G = H R, with masters as the other side. */
  void
  RigidMotions::see_contacts(const ContactPoints &points)
  {
    seen_by_contacts.setZero(points.n_unknowns(), free_modes.cols());
    Index i = 0;
    for (const ContactPoint &point : points)
      for (const Tensor<1, 3> &dual : point.dual)
        {
          const pairing::ContactNode &node = *point.node;
          pairing::for_each_side(node,
                                 [&](const unsigned int body,
                                     const unsigned int node_number,
                                     const double       weight) {
                                   seen_by_contacts.row(i) +=
                                     row(body,
                                         bodies.structures[body]->position(
                                           node_number),
                                         bodies.in_frame(body, weight * dual)) *
                                     free_modes.middleRows(body * n_one, n_one);
                                 });
          ++i;
        }
    forget_unseen(seen_by_contacts);
  }

  Eigen::MatrixXd
  RigidMotions::null_space() const
  {
    Eigen::MatrixXd result = seen_by_contacts * without_springs;
    forget_unseen(result);
    return result;
  }

  Eigen::MatrixXd
  RigidMotions::unseen() const
  {
    const Eigen::MatrixXd G = null_space();
    return without_springs * split(G.transpose() * G).null;
  }

  void
  RigidMotions::refuse_loose_bodies() const
  {
    std::vector<bool> reached(bodies.structures.size(), false);
    for (const pairing::ContactNode &node : bodies.contact_nodes)
      {
        const unsigned int one = tied_with[node.body];
        const unsigned int other =
          node.masters.empty() ? one : tied_with[node.master];
        // bodies that are tied reach each other only
        if (node.kind != pairing::ContactKind::tie || node.masters.empty() ||
            other != one)
          reached[one] = reached[other] = true;
      }
    const Eigen::MatrixXd loose = free_modes * without_springs;
    for (Index j = 0; j < loose.cols(); ++j)
      if (const Motion m = largest(loose.col(j)); !reached[tied_with[m.body]])
        throw InputError(
          "Nothing holds " + bodies.called(m.body) + " against moving " +
          describe(m) +
          ": no support, and no node of it faces anything in a Contact. " +
          (bodies.is_rigid(m.body) ? "Let it be less Free" : "Add a Support") +
          ", or a Contact; check Boundary ids, Reach and the bodies' "
          "places.");
  }

  /* Least squares: a rigid motion fits what supports prescribe only if they
     move as one. What is left is deformation. */
  RigidMotions::Amounts
  RigidMotions::placement(const double t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    Amounts amounts = locked();
    // the second time takes out the rounding of long sums
    for (unsigned int pass = 0; pass < 2; ++pass)
      {
        Amounts right = Amounts::Zero(held.rows());
        for (const NodeRule &rule : rules.rules())
          {
            const Index    first = rule.body * n_one;
            const Point<3> p =
              bodies.structures[rule.body]->position(rule.node);
            for (const HeldDirection &h : rule.held)
              {
                const Eigen::RowVectorXd e = row(rule.body, p, h.direction);
                right.segment(first, n_one) +=
                  (rules.displacement(rule, h, t) -
                   e.dot(amounts.segment(first, n_one))) *
                  e.transpose();
              }
            for (const NodeRule::HeldRotation &h : rule.rotations)
              right[first + h.component] +=
                rules.angle(h, p, t) * frames[rule.body].size -
                amounts[first + h.component];
          }
        for (const Tie &tied : ties)
          {
            const double moved =
              pairing::obstacle_displacement(*tied.node, t) * tied.direction;
            add(moved - relative(tied, amounts), tied, right);
          }
        // What is locked does not give way to the others.
        for (const Cut &cut : bodies.cuts)
          if (cut.opening)
            right.segment(cut.body * n_one, n_one).setZero();
        amounts += held_inverse * right;
      }
    return amounts;
  }

  RigidMotions::Amounts
  RigidMotions::locked() const
  {
    Amounts amounts = none();
    for (const Cut &cut : bodies.cuts)
      if (cut.opening)
        amounts.segment(cut.body * n_one, n_one) =
          *cut.opening *
          row(cut.body, frames[cut.body].centre, cut.axis).transpose();
    return amounts;
  }

  Tensor<1, 3>
  RigidMotions::at(const Amounts     &amounts,
                   const unsigned int body,
                   const unsigned int node) const
  {
    AssertDimension(amounts.size(), held.rows());
    AssertIndexRange(body, frames.size());
    return displacement(of_body(amounts, body),
                        bodies.structures[body]->position(node));
  }

  RigidMotions::Motion
  RigidMotions::of_body(const Amounts &amounts, const unsigned int body) const
  {
    AssertDimension(amounts.size(), held.rows());
    AssertIndexRange(body, frames.size());
    Motion motion = frames[body];
    for (unsigned int k = 0; k < n_one; ++k)
      if (const double amount = amounts[body * n_one + k];
          motion.axisymmetric && !is_axial(k))
        continue;
      else if (k < bodies.dim)
        motion.translation[k] = amount;
      else
        motion.rotation[bodies.dim == 2 ? 2 : k - bodies.dim] =
          amount / motion.size;
    return motion;
  }

  double
  RigidMotions::largest_size() const
  {
    double largest = 0;
    for (const Motion &frame : frames)
      largest = std::max(largest, frame.size);
    return largest;
  }

  Eigen::VectorXd
  RigidMotions::field(const Amounts &amounts) const
  {
    AssertDimension(amounts.size(), held.rows());
    Eigen::VectorXd u = Eigen::VectorXd::Zero(offset.back());
    for (unsigned int body = 0; body < frames.size(); ++body)
      {
        if (amounts.segment(body * n_one, n_one).isZero(0))
          continue;
        const bodies::Structure &structure = *bodies.structures[body];
        const unsigned int       n_c       = structure.n_components();
        const Motion             motion    = of_body(amounts, body);
        Index                    dof       = offset[body];
        for (unsigned int i = 0; i < structure.n_nodes(); ++i, dof += n_c)
          {
            const Tensor<1, 3> moved =
              displacement(motion, structure.position(i));
            for (unsigned int c = 0; c < bodies.dim; ++c)
              u[dof + c] = moved[c];
            for (unsigned int c = bodies.dim; c < n_c; ++c)
              if (structure.has_dof(i, c))
                // An amount is the way of the rim, a dof of rotation an angle.
                u[dof + c] = amounts[body * n_one + c] / frames[body].size;
          }
      }
    return u;
  }

  /* R^T f: forces along the translations, moments over the size along the
     rotations. */
  RigidMotions::Amounts
  RigidMotions::resultants(const Eigen::VectorXd &forces) const
  {
    AssertDimension(forces.size(), offset.back());
    Amounts sum = Amounts::Zero(held.rows());
    for (unsigned int body = 0; body < frames.size(); ++body)
      {
        const bodies::Structure &structure = *bodies.structures[body];
        const unsigned int       n_c       = structure.n_components();
        Index                    dof       = offset[body];
        for (unsigned int i = 0; i < structure.n_nodes(); ++i, dof += n_c)
          {
            Tensor<1, 3> force;
            for (unsigned int c = 0; c < bodies.dim; ++c)
              force[c] = forces[dof + c];
            if (force.norm_square() > 0)
              sum.segment(body * n_one, n_one) +=
                row(body, structure.position(i), force).transpose();
            for (unsigned int c = bodies.dim; c < n_c; ++c)
              sum[body * n_one + c] += forces[dof + c] / frames[body].size;
          }
      }
    return sum;
  }

  RigidMotions::Motion
  RigidMotions::motion(const Eigen::VectorXd &combination) const
  {
    AssertDimension(combination.size(), without_springs.cols());
    return largest(free_modes * (without_springs * combination));
  }

  RigidMotions::Motion
  RigidMotions::largest(const Amounts &modes) const
  {
    AssertDimension(modes.size(), held.rows());
    // Amounts are lengths, so that turns and translations compare.
    std::size_t best = 0;
    for (std::size_t body = 1; body < frames.size(); ++body)
      if (modes.segment(static_cast<Eigen::Index>(body) * n_one, n_one).norm() >
          // Of bodies that move alike the first is named, not one by rounding.
          1.001 * modes.segment(static_cast<Eigen::Index>(best) * n_one, n_one)
                    .norm())
        best = body;
    const auto body    = static_cast<unsigned int>(best);
    Motion     motion  = of_body(modes, body);
    motion.translation = bodies.in_space(body, motion.translation);
    motion.rotation    = bodies.in_space(body, motion.rotation);
    return motion;
  }

  std::string
  describe(const RigidMotions::Motion &motion)
  {
    const double translation = motion.translation.norm();
    const double rotation    = motion.size * motion.rotation.norm();
    const double small       = 1e-6 * std::max(translation, rotation);
    std::string  text;
    if (translation > small)
      text = "along " + direction_text(motion.translation);
    if (rotation > small)
      text += std::string(text.empty() ? "" : " and ") + "about " +
              direction_text(motion.rotation);
    return text;
  }
} // namespace conetact::contact
