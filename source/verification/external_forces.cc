// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/verification/external_forces.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::verification
{
  namespace
  {
    Tensor<1, 3>
    at_node(const Eigen::VectorXd &f,
            const Eigen::Index     dof,
            const unsigned int     dim)
    {
      Tensor<1, 3> force;
      for (unsigned int c = 0; c < dim; ++c)
        force[c] = f[dof + c];
      return force;
    }

    /** Moment of the dofs that rotate: theta_z in 2D, x, y, z in 3D. */
    Tensor<1, 3>
    moment_at_node(const Eigen::VectorXd &f,
                   const Eigen::Index     dof,
                   const unsigned int     dim,
                   const unsigned int     n_components)
    {
      Tensor<1, 3> moment;
      for (unsigned int c = dim; c < n_components; ++c)
        moment[dim == 2 ? 2 : c - dim] = f[dof + c];
      return moment;
    }

    /** The mean of a body's nodes, where its frame puts them. */
    Point<3>
    centre_of(const model::Bodies &bodies, const unsigned int body)
    {
      Point<3>           centre;
      const unsigned int n = bodies.structures[body]->n_nodes();
      for (unsigned int i = 0; i < n; ++i)
        centre += Tensor<1, 3>(bodies.position(body, i)) / n;
      return centre;
    }

    /**
     * What makes moments of nodes forces: the extent of a body whose nodes
     * rotate; 0: they do not, or it is a point [length].
     */
    double
    lever_of(const model::Bodies &bodies,
             const unsigned int   body,
             const Point<3>      &centre)
    {
      const bodies::Structure &structure = *bodies.structures[body];
      double                   reach     = 0;
      if (structure.n_components() > bodies.dim)
        for (unsigned int i = 0; i < structure.n_nodes(); ++i)
          reach = std::max(reach, bodies.position(body, i).distance(centre));
      return 2 * reach;
    }

    /**
     * Adds forces to the sums of the scene and of their body. The scene has
     * moments about the origin, a body about the mean of its nodes. Magnitudes
     * are added up beside the sums: they are the scale of what the sums may
     * miss.
     */
    class Collector
    {
    public:
      Collector(const model::Bodies &b, ExternalForces &e)
        : bodies(b)
        , all(e)
      {
        for (unsigned int body = 0; body < bodies.structures.size(); ++body)
          {
            centres.push_back(centre_of(bodies, body));
            levers.push_back(lever_of(bodies, body, centres.back()));
          }
        all.bodies.resize(bodies.structures.size());
      }

      void
      act(model::Resultant   &resultant,
          const unsigned int  body,
          const Point<3>     &p,
          const Tensor<1, 3> &force,
          const Tensor<1, 3> &moment = Tensor<1, 3>())
      {
        if (force.norm_square() == 0 && moment.norm_square() == 0)
          return; // as on most nodes
        Balance &balance = all.bodies[body];
        // The rigid body of a cut is none of the scene: it balances, nothing
        // else knows it.
        model::Resultant  unseen;
        model::Resultant &sum = is_cut(body) ? unseen : resultant;
        sum.force += force;
        // A body that couples alone load has forces of their rounding.
        const double couple =
          levers[body] > 0 ? moment.norm() / levers[body] : 0.;
        balance.forces += force.norm() + couple;
        balance.largest = std::max({balance.largest, force.norm(), couple});
        balance.largest_moment =
          std::max(balance.largest_moment, moment.norm());
        if (bodies.structures[body]->is_axisymmetric())
          {
            // Radial forces cancel round the axis, and so do moments.
            balance.sum.force[1] += force[1];
            return;
          }
        sum.moment += moment + cross_product_3d(Tensor<1, 3>(p), force);
        // About a far point the moments of a body would be differences of large
        // numbers: it has a centre of its own.
        const Tensor<1, 3> turning = cross_product_3d(p - centres[body], force);
        balance.sum.force += force;
        balance.sum.moment += moment + turning;
        // Magnitudes do not cancel: they measure the rounding of these sums,
        // however small the sums are.
        balance.moments += moment.norm() + turning.norm();
        balance.arms += (p - centres[body]).norm() * force.norm();
      }

      /** Forces on all dofs, of nodes of this process. */
      void
      act(model::Resultant        &resultant,
          const contact::DofShare &share,
          const Eigen::VectorXd   &forces)
      {
        share.for_each_node([&](const unsigned int body,
                                const unsigned int i,
                                const Eigen::Index dof) {
          act(resultant,
              body,
              bodies.position(body, i),
              at_node(forces, dof, bodies.dim),
              moment_at_node(forces,
                             dof,
                             bodies.dim,
                             bodies.structures[body]->n_components()));
        });
      }

      /** Adds up what all processes have collected: all numbers in one message
       * of sums and one of maxima. */
      void
      gather(const contact::DofShare &share)
      {
        if (!share.is_shared())
          return;
        std::vector<double *> sums, largest;
        const auto            add = [&](model::Resultant &resultant) {
          for (Tensor<1, 3> *const v : {&resultant.force, &resultant.moment})
            for (unsigned int d = 0; d < 3; ++d)
              sums.push_back(&(*v)[d]);
        };
        for (Balance &balance : all.bodies)
          {
            add(balance.sum);
            sums.insert(sums.end(),
                        {&balance.forces, &balance.moments, &balance.arms});
            largest.insert(largest.end(),
                           {&balance.largest, &balance.largest_moment});
          }
        for (auto *const list : {&all.contacts, &all.masters, &all.supports})
          for (model::Resultant &resultant : *list)
            add(resultant);
        add(all.loads);
        take(share.sum(numbers_at(sums)), sums);
        take(share.largest(numbers_at(largest)), largest);
      }

    private:
      static Eigen::VectorXd
      numbers_at(const std::vector<double *> &places)
      {
        Eigen::VectorXd numbers(static_cast<Eigen::Index>(places.size()));
        std::transform(places.begin(),
                       places.end(),
                       numbers.begin(),
                       [](const double *place) { return *place; });
        return numbers;
      }
      static void
      take(const Eigen::VectorXd &numbers, const std::vector<double *> &places)
      {
        for (std::size_t k = 0; k < places.size(); ++k)
          *places[k] = numbers[static_cast<Eigen::Index>(k)];
      }
      bool
      is_cut(const unsigned int body) const
      {
        return body >= bodies.n_elastic() + bodies.n_free_obstacles();
      }

      const model::Bodies  &bodies;
      ExternalForces       &all;
      std::vector<Point<3>> centres;
      std::vector<double>   levers; ///< of moments, of each body
    };

    /** Gives what is left at nodes that supports hold to these supports, each
     * direction to the first that holds it. */
    void
    collect_supports(const ActedOn         &on,
                     const Eigen::VectorXd &rest,
                     Collector             &collector,
                     ExternalForces        &all)
    {
      const model::Bodies &bodies = on.bodies;
      for (const contact::NodeRule &rule : on.plain.rules().rules())
        {
          const Eigen::Index of_all = on.plain.dof(rule.body, rule.node);
          if (!on.share.has(of_all))
            continue;
          const Eigen::Index dof   = of_all - on.share.begin();
          const Point<3>     p     = bodies.position(rule.body, rule.node);
          const Tensor<1, 3> force = at_node(rest, dof, bodies.dim);
          // K w less all that acts is what a rigid support must add. Free
          // directions of the same node are none of its business: there an
          // imbalance stays one.
          for (const contact::HeldDirection &h : rule.held)
            {
              // Held directions of a node are orthonormal: their parts add up.
              const Tensor<1, 3> e    = rule.axes.empty() ?
                                          h.direction :
                                          bodies.in_space(rule.body, h.direction);
              const Tensor<1, 3> part = (force * e) * e;
              collector.act(all.supports[h.terms.front().support],
                            rule.body,
                            p,
                            part);
              for (unsigned int c = 0; c < bodies.dim; ++c)
                all.held[dof + c] += part[c];
            }
          for (const contact::NodeRule::HeldRotation &h : rule.rotations)
            {
              Tensor<1, 3> moment;
              moment[bodies.dim == 2 ? 2 : h.component - bodies.dim] =
                rest[dof + h.component];
              collector.act(
                all.supports[h.support], rule.body, p, Tensor<1, 3>(), moment);
              all.held[dof + h.component] = rest[dof + h.component];
            }
        }
    }
  } // namespace

  double
  Balance::error() const
  {
    return std::max(forces > 0 ? sum.force.norm() / forces : 0.,
                    turning() > 0 ? sum.moment.norm() / turning() : 0.);
  }

  double
  Balance::turning() const
  {
    // Forces towards the centre have no moments but rounding, which needs a
    // scale as well: a hundredth of the moments that they would have across
    // their arms.
    constexpr double least = .01;
    return std::max(moments, least * arms);
  }

  namespace
  {
    void
    collect_contacts(const ActedOn         &on,
                     const Eigen::VectorXd &r,
                     Collector             &collector,
                     ExternalForces        &all)
    {
      for (const contact::ContactPoint &point : on.points.all())
        {
          const pairing::ContactNode &node = *point.node;
          if (node.contact >= all.contacts.size())
            {
              all.contacts.resize(node.contact + 1);
              all.masters.resize(node.contact + 1);
            }
          if (!on.share.is_first())
            continue; // all know them, one counts
          const Tensor<1, 3> force = contact::force_of(point, r);
          // The opposite force, shared as the displacements of the masters are:
          // no work is lost where the gap stays as it is. Slaves come first.
          const auto act = [&](model::Resultant  &side,
                               const unsigned int body,
                               const unsigned int i,
                               const double       weight) {
            collector.act(side,
                          body,
                          on.bodies.position(body, i),
                          weight * force);
          };
          pairing::for_each_slave(
            node, [&](const unsigned int i, const double weight) {
              act(all.contacts[node.contact], node.body, i, weight);
            });
          for (const auto &[i, weight] : node.masters)
            act(all.masters[node.contact], node.master, i, -weight);
          if (node.opening)
            act(all.masters[node.contact], *node.opening, 0, -1);
        }
    }
  } // namespace



  model::Resultant
  resultant(const model::Bodies        &bodies,
            const contact::Coordinates &plain,
            const Eigen::VectorXd      &forces)
  {
    AssertDimension(forces.size(), plain.n_dofs());
    ExternalForces          all;
    Collector               collector(bodies, all);
    const contact::DofShare share(bodies, plain);
    collector.act(all.loads, share, forces);
    collector.gather(share);
    return all.loads;
  }



  ExternalForces
  external_forces(const ActedOn                          &on,
                  const Eigen::VectorXd                  &rest,
                  const std::vector<contact::Foundation> &foundations,
                  const Eigen::VectorXd                  &loads,
                  const Eigen::VectorXd                  &r)
  {
    AssertDimension(rest.size(), on.share.size());
    AssertDimension(loads.size(), on.plain.n_dofs());
    AssertDimension(r.size(), on.points.n_all_unknowns());
    Assert(foundations.size() <= on.bodies.supports.size(),
           dealii::ExcMessage("A foundation belongs to a support."));
    ExternalForces all;
    all.held.setZero(rest.size());
    all.supports.resize(on.bodies.supports.size());
    Collector collector(on.bodies, all);
    collect_contacts(on, r, collector, all);
    collect_supports(on, rest, collector, all);
    for (std::size_t s = 0; s < foundations.size(); ++s)
      if (foundations[s].forces.size() > 0)
        collector.act(all.supports[s], on.share, foundations[s].forces);
    collector.act(all.loads, on.share, loads);
    collector.gather(on.share);
    return all;
  }
} // namespace conetact::verification
