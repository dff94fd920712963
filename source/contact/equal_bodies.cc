// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/equal_bodies.h"

#include "conetact/backends/free_motion.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <set>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    // A body that is moved by many times its size, or turned, has this error
    // in the coordinates of its nodes, over the size of its cells.
    constexpr double round_off = 1e-12;

    Eigen::Matrix3Xd
    positions(const bodies::Structure &body)
    {
      Eigen::Matrix3Xd x(3, body.n_nodes());
      for (unsigned int i = 0; i < body.n_nodes(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          x(c, i) = body.position(i)[c];
      // about their centre: where a body stands does not matter
      return x.colwise() - Eigen::Vector3d(x.rowwise().mean());
    }

    bool
    fits(const Eigen::Matrix3Xd &x, const Eigen::Matrix3Xd &y)
    {
      // much more than round-off: whether they are equal the forces say
      return (x - y).cwiseAbs().maxCoeff() <=
             1e3 * round_off * x.cwiseAbs().maxCoeff();
    }

    // The rotation that brings the points x nearest to y (Kabsch).
    Eigen::Matrix3d
    rotation(const Eigen::Matrix3Xd &x, const Eigen::Matrix3Xd &y)
    {
      // points on a line do not tell how they are turned about it
      if ((x - y).cwiseAbs().maxCoeff() <= round_off * x.cwiseAbs().maxCoeff())
        return Eigen::Matrix3d::Identity();
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(y * x.transpose(),
                                                  Eigen::ComputeFullU |
                                                    Eigen::ComputeFullV);
      const Eigen::Matrix3d                   V = svd.matrixV().transpose();
      Eigen::Matrix3d                         U = svd.matrixU();
      // A reflection is not a turn.
      if ((U * V).determinant() < 0)
        U.col(2) = -U.col(2);
      return U * V;
    }

    Tensor<2, 3>
    to_tensor(const Eigen::Matrix3d &Q)
    {
      Tensor<2, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i][j] = Q(i, j);
      return result;
    }

    /** A turn or reflection, and which node of one body comes to lie on which
     * of the other. */
    struct Isometry
    {
      Eigen::Matrix3d           Q;
      std::vector<unsigned int> partner;
    };

    /** Nodes in the order of their heights along a direction without order. */
    std::vector<unsigned int>
    sorted(const Eigen::Matrix3Xd &x)
    {
      const Eigen::VectorXd heights =
        x.transpose() * Eigen::Vector3d(.5773, .7548, .3119);
      std::vector<unsigned int> order(static_cast<std::size_t>(x.cols()));
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(),
                order.end(),
                [&](const unsigned int a, const unsigned int b) {
                  return heights[a] < heights[b];
                });
      return order;
    }

    /** Empty unless each node of Q x lies on one of y. */
    std::vector<unsigned int>
    partners(const Eigen::Matrix3Xd &Qx, const Eigen::Matrix3Xd &y)
    {
      const auto of_x = sorted(Qx), of_y = sorted(y);
      if (!fits(Qx(Eigen::all, of_x), y(Eigen::all, of_y)))
        return {};
      std::vector<unsigned int> partner(of_x.size());
      for (std::size_t k = 0; k < of_x.size(); ++k)
        partner[of_x[k]] = of_y[k];
      return partner;
    }

    /**
     * What may bring x onto y: principal axes onto each other either way
     * round; and where those are not unique, as of a cube, the axes of the
     * scene in any order and sense.
     */
    std::vector<Eigen::Matrix3d>
    candidates(const Eigen::Matrix3Xd &x, const Eigen::Matrix3Xd &y)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of_x(x *
                                                                x.transpose()),
        of_y(y * y.transpose());
      std::vector<Eigen::Matrix3d> all;
      if (!(of_x.eigenvalues() - of_y.eigenvalues())
             .isZero(1e-9 * of_x.eigenvalues().maxCoeff()))
        return all;
      const auto add = [&](const Eigen::Matrix3d &from,
                           const Eigen::Matrix3d &to) {
        for (unsigned int senses = 0; senses < 8; ++senses)
          {
            Eigen::Vector3d sign;
            for (unsigned int d = 0; d < 3; ++d)
              sign[d] = (senses >> d) % 2 == 0 ? 1 : -1;
            all.push_back(to * sign.asDiagonal() * from.transpose());
          }
      };
      add(of_x.eigenvectors(), of_y.eigenvectors());
      Eigen::Matrix3d    turned;
      std::array<int, 3> axes{{0, 1, 2}};
      do
        {
          for (int d = 0; d < 3; ++d)
            turned.col(d) =
              Eigen::Vector3d::Unit(axes[static_cast<unsigned>(d)]);
          add(Eigen::Matrix3d::Identity(), turned);
        }
      while (std::next_permutation(axes.begin(), axes.end()));
      return all;
    }

    /** Directions that supports hold on a body, and masters of its nodes. */
    std::size_t
    count_rules(const Bodies      &bodies,
                const Coordinates &coordinates,
                const unsigned int body)
    {
      std::size_t n = 0;
      for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
        if (const NodeRule *rule = coordinates.rule(body, i))
          n += rule->held.size() + rule->masters.size();
      return n;
    }

    /** Whether supports hold the nodes of both bodies alike. */
    bool
    are_held_alike(const Coordinates &coordinates,
                   const unsigned int one,
                   const unsigned int other,
                   const Isometry    &isometry)
    {
      const Tensor<2, 3> Q = to_tensor(isometry.Q);
      for (unsigned int i = 0; i < isometry.partner.size(); ++i)
        {
          const NodeRule *a = coordinates.rule(one, i);
          const NodeRule *b = coordinates.rule(other, isometry.partner[i]);
          if (a == nullptr && b == nullptr)
            continue;
          if (a == nullptr || b == nullptr || a->held.size() != b->held.size())
            return false;
          for (const HeldDirection &held : a->held)
            if (!is_spanned(Q * held.direction, directions(b->held)))
              return false;
        }
      return true;
    }

    /** None: the bodies differ. */
    std::optional<Isometry>
    isometry(const Bodies      &bodies,
             const Coordinates &coordinates,
             const unsigned int one,
             const unsigned int other)
    {
      // most bodies that differ are told apart without any search
      if (count_rules(bodies, coordinates, one) !=
          count_rules(bodies, coordinates, other))
        return {};
      const Eigen::Matrix3Xd x = positions(*bodies.structures[one]);
      const Eigen::Matrix3Xd y = positions(*bodies.structures[other]);
      Isometry               turned{rotation(x, y), {}};
      if (fits(turned.Q * x, y))
        {
          turned.partner.resize(static_cast<std::size_t>(x.cols()));
          std::iota(turned.partner.begin(), turned.partner.end(), 0u);
          if (are_held_alike(coordinates, one, other, turned))
            return turned;
        }
      for (const Eigen::Matrix3d &Q : candidates(x, y))
        {
          const Isometry found{Q, partners(Q * x, y)};
          if (!found.partner.empty() &&
              are_held_alike(coordinates, one, other, found))
            return found;
        }
      return {};
    }

    /** The frame of the body that an isometry leads to. */
    BodyFrame
    composed(const BodyFrame &frame, const Isometry &isometry)
    {
      BodyFrame result{to_tensor(isometry.Q) * frame.axes, {}};
      for (unsigned int k = 0; k < isometry.partner.size(); ++k)
        result.order.push_back(isometry.partner[frame.node(k)]);
      return result;
    }

    // The same numbers for each body.
    VectorXd
    displacement_without_order(const BodyCoordinates &own,
                               const std::size_t      n_bodies)
    {
      VectorXd p(own.n_unknowns());
      for (std::size_t body = 0; body < n_bodies; ++body)
        {
          const Index n                 = own.end(body) - own.begin(body);
          p.segment(own.begin(body), n) = backends::numbers_without_order(n);
        }
      return p;
    }

    bool
    are_equal(const Eigen::Ref<const VectorXd> &a,
              const Eigen::Ref<const VectorXd> &b)
    {
      return (a - b).cwiseAbs().maxCoeff() <=
             round_off * a.cwiseAbs().maxCoeff();
    }
  } // namespace



  bool
  may_have_equals(const Bodies &bodies)
  {
    std::set<unsigned int> sizes;
    for (std::size_t body = 0; body < bodies.structures.size(); ++body)
      if (!bodies.is_at_rest(body) &&
          !sizes.insert(bodies.structures[body]->n_nodes()).second)
        return true;
    return false;
  }



  std::vector<BodyFrame>
  body_frames(const Bodies &bodies, const Coordinates &coordinates)
  {
    std::vector<BodyFrame> frames;
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        const unsigned int n = bodies.structures[body]->n_nodes();
        frames.push_back({to_tensor(Eigen::Matrix3d::Identity()), {}});
        for (unsigned int model = 0; model < body; ++model)
          if (bodies.structures[model]->n_nodes() == n)
            if (const auto found = isometry(bodies, coordinates, model, body))
              {
                frames.back() = composed(frames[model], *found);
                break;
              }
      }
    return frames;
  }



  std::vector<std::vector<unsigned int>>
  find_equal_bodies(const ElasticSystem &elastic, const BodyCoordinates &own)
  {
    const Bodies     &bodies = elastic.bodies;
    const std::size_t n      = bodies.structures.size();
    // A displacement without any symmetry: different matrices answer it by
    // different forces.
    const VectorXd u = own.expand(displacement_without_order(own, n));
    // each by itself: a stiff one would hide a soft one
    std::vector<VectorXd> forces = {own.restrict(elastic.structure_forces(u))};
    for (const VectorXd &f : elastic.forces_by_foundation(u))
      forces.push_back(own.restrict(f));
    const auto equal = [&](const unsigned int a, const unsigned int b) {
      const Index n_unknowns = own.end(a) - own.begin(a);
      return n_unknowns == own.end(b) - own.begin(b) &&
             std::all_of(forces.begin(), forces.end(), [&](const VectorXd &f) {
               return are_equal(f.segment(own.begin(a), n_unknowns),
                                f.segment(own.begin(b), n_unknowns));
             });
    };

    std::vector<std::vector<unsigned int>> groups;
    for (unsigned int body = 0; body < n; ++body)
      {
        if (own.begin(body) == own.end(body))
          continue;
        const auto group =
          std::find_if(groups.begin(), groups.end(), [&](const auto &other) {
            return equal(other[0], body);
          });
        if (group == groups.end())
          groups.push_back({body});
        else
          group->push_back(body);
      }
    // Who equals nobody is no group.
    groups.erase(std::remove_if(groups.begin(),
                                groups.end(),
                                [](const auto &group) {
                                  return group.size() == 1;
                                }),
                 groups.end());
    return groups;
  }
} // namespace conetact::contact
