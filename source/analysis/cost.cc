// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/cost.h"

#include "conetact/base/process.h"
#include "conetact/base/text.h"
#include "conetact/contact/condensed_compliance.h"
#include "conetact/contact/large_nodes.h"

#include <deal.II/base/exceptions.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <vector>

namespace conetact::analysis
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    double
    seconds_since(const Clock::time_point start)
    {
      return std::chrono::duration<double>(Clock::now() - start).count();
    }

    /** Floating-point operations a second of dense multiplication. */
    double
    dense_rate()
    {
      constexpr Eigen::Index n    = 320;
      const Eigen::MatrixXd  a    = Eigen::MatrixXd::Constant(n, n, .5);
      double                 best = 0;
      Eigen::MatrixXd        product(n, n);
      for (unsigned int i = 0; i < 4; ++i)
        {
          const Clock::time_point start = Clock::now();
          product.noalias()             = a * a;
          best = std::max(best, 2. * n * n * n / seconds_since(start));
        }
      return best;
    }

    /**
     * Of the process so far, and of those that have made its meshes [s]: CPU
     * time, which others on the machine do not change.
     */
    double
    cpu_seconds()
    {
      const auto seconds = [](const timeval &t) {
        return static_cast<double>(t.tv_sec) +
               1e-6 * static_cast<double>(t.tv_usec);
      };
      double sum = 0;
      for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN})
        {
          rusage usage;
          getrusage(who, &usage);
          sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
        }
      return sum;
    }

    // Measured on blocks of 16^3 to 40^3 cells, in units of dense products.
    // In the plane fronts are small, and so is the rate: strips of 1500 x 60 to
    // 2000 x 200 cells with all nodes of a side retained.
    constexpr double sparse_over_dense[] = {4, 1.6}; // factorisation
    constexpr double lu_over_dense       = 2;        // of contact unknowns
    constexpr double lus_an_increment    = .15;      // after the first
    // Contacts that slide are found, assembled and solved a few times in each
    // increment: seconds a contact unknown of scenes with 34 to 378 of them.
    constexpr double sliding_of_unknown = 5e-4;
    // Besides what MUMPS asks for, its factor as it grows and bytes a dof: Q1,
    // P1 and P2 on blocks of 8 to 140 thousand dofs.
    constexpr double part_of_factor = .35, bytes_of_dof = 1000;
    // Operations for an unknown in an iteration of the iterative backend, with
    // what Newton's steps take besides: 64^3 cells.
    constexpr double iteration_of_unknown = 2500;
    // Of the iterative backend: seconds an unknown (what is made once, an
    // increment) and bytes, in the plane and in space; from blocks of
    // 32^3 and 64^3 cells (space), squares of 200^2 and 400^2, strips (plane).
    // What processes share, and what each has besides its meshes: from 64^3 and
    // 100^3 cells and 400^2, by one and two processes. Cells that differ take
    // so many times as long, and as many bytes: 48^3 of them.
    constexpr double setup_of_unknown[]     = {4e-6, 4e-6};
    constexpr double increment_of_unknown[] = {1e-6, 2e-6};
    constexpr double shared_bytes[]         = {350, 640};
    constexpr double bytes_of_each[]        = {400, 75};
    constexpr double longer_if_unequal      = 4;
    constexpr double larger_if_unequal      = 3;
    // Rows of a matrix whose elements differ are put in order without what is
    // left of the diagonal.
    constexpr double bytes_of_entry = 2.2 * sizeof(double);
    // Where bodies of such elements meet, Newton's method and GMRES take more
    // steps: flanges with eight bolts, P1 and P2.
    constexpr double longer_of_unequal_pairs = 5;

    // Dense operations a second of a core, in which choices count the seconds
    // above: a choice must not depend on the clock, nor on who else works on
    // the machine.
    constexpr double usual_rate = 3e10;

    // Iterations grow with the contrast of strains from here on: 3 times as
    // many at nu = 0.49, 15 at 0.499, 200 at 0.4999. Several bodies and those
    // that float have so many times as many as one that is held (20^3 to 36^3
    // cells); where a slave is so much harder than its master they grow with
    // the mesh and may not converge: E 10 to 100 on 1 at 30^3 cells; ten times
    // as many with E 1000.
    constexpr double usual_contrast = 36, more_of_bodies = 1.5;
    constexpr double hard = 5, more_of_hard_slaves = 6;

    // Contacts that slide far are found so many times in an increment; each
    // time what is made of all unknowns is made anew, and half of the increment
    // solved: a ball that is moved over blocks of 24 x 24 x 12 and 40 x 40 x 20
    // cells.
    constexpr double pairings_of_increment = 5, part_of_pairing = .5;

    // Unknowns in space below which nothing is worth a forecast, and above
    // which none is needed.
    constexpr Eigen::Index small_body = 60000, huge_body = 600000;

    // Contact unknowns from which on dense matrices of them are worth one.
    constexpr Eigen::Index many_unknowns = 2000;

    // A little time is no reason: what does not converge is condensed after
    // all, and then both were for nothing. Of many contact unknowns that are
    // condensed few may touch, which nothing tells beforehand.
    constexpr double much_faster = 2, faster = 1.2;

    // Seconds for each dof: to recover and check an increment, to draw it.
    constexpr double check_of_dof = 1e-6, drawing_of_dof = 1e-6;

    /** Of matrices of contact unknowns, in all increments. */
    double
    flops_of_contact(const contact::ContactModel &model,
                     const double                 n_increments)
    {
      const auto n = static_cast<double>(model.points.n_unknowns());
      return lu_over_dense * 2. / 3. * std::pow(n, 3) *
             (1 + lus_an_increment * (n_increments - 1));
    }

    /** In compliance form bodies have flexibilities: to invert them, n^3. */
    std::vector<double>
    flexibilities(const contact::ContactModel &model)
    {
      return model.condensed_form() == solvers::Form::compliance ?
               contact::unknowns_of_flexibilities(model.bodies, model.points) :
               std::vector<double>();
    }

    /** Of each body what is condensed and its inverse; and if something is
     * bound, the relation of all rows beside that of the others. */
    double
    bytes_of_flexibilities(const contact::ContactModel &model,
                           const double                 stiffness_bytes)
    {
      double bytes = model.points.n_bound() > 0 ? stiffness_bytes : 0.;
      for (const double n : flexibilities(model))
        bytes += 2 * sizeof(double) * n * n;
      return bytes;
    }

    /** To condense bodies and solve increments then. */
    double
    flops_of_condensing(const contact::ContactModel     &model,
                        const condensed::FactorEstimate &factor,
                        const std::size_t                n_increments)
    {
      return sparse_over_dense[model.bodies.dim - 2] * factor.flops +
             flops_of_contact(model, static_cast<double>(n_increments));
    }

    /** To recover, check and draw increments, whichever way they are solved. */
    double
    seconds_of_results(const contact::ContactModel &model,
                       const double                 n_increments,
                       const std::size_t            n_drawings)
    {
      return static_cast<double>(model.coordinates.n_dofs()) *
             (check_of_dof * n_increments +
              drawing_of_dof * static_cast<double>(n_drawings));
    }
    double
    largest_contrast(const contact::ContactModel &model)
    {
      double contrast = 1;
      for (const bodies::Structure *body : model.bodies.structures)
        contrast = std::max(contrast, body->contrast_of_strains());
      return contrast;
    }
    bool
    has_hard_slave(const contact::ContactModel &model)
    {
      return contact::hardest_slave(model.elastic,
                                    model.coordinates,
                                    model.points) > hard;
    }
    /** How many times more iterations than one body that is held takes. */
    double
    many_iterations(const contact::ContactModel &model)
    {
      const double more =
        std::max(1., largest_contrast(model) / usual_contrast);
      if (model.condensed_form() == solvers::Form::stiffness)
        return more;
      return more *
             (has_hard_slave(model) ? more_of_hard_slaves : more_of_bodies);
    }
    /** Part of all elements whose bodies hardly have equal ones. */
    double
    unequal_part(const contact::ContactModel &model)
    {
      constexpr double few = 10; // elements of a shape
      double           all = 0, unequal = 0;
      for (const bodies::Structure *body : model.bodies.structures)
        {
          const auto   count      = body->elements().count();
          const double n_elements = count.elements;
          all += n_elements;
          if (count.matrices * few > n_elements)
            unequal += n_elements;
        }
      return all > 0 ? unequal / all : 0.;
    }

    /**
     * Of the matrix of all unknowns, in space: of bodies whose elements differ,
     * and where contacts connect bodies. A slave's node meets the m nodes of
     * its master, and so do all that its elements connect with it.
     */
    double
    entries(const contact::ContactModel &model)
    {
      // Elements are looked at only where a body's stencil is asked for.
      const auto         &bodies  = model.bodies.structures;
      const double        unequal = unequal_part(model);
      std::vector<double> known(bodies.size(), 0.);
      const auto          stencil = [&](const std::size_t body) {
        if (known[body] == 0)
          known[body] = contact::stencil_of(*bodies[body]);
        return known[body];
      };
      double sum = 0;
      for (std::size_t body = 0; body < bodies.size() && unequal > 0; ++body)
        sum +=
          unequal * stencil(body) * static_cast<double>(bodies[body]->n_dofs());
      for (const contact::ContactPoint &point : model.points.all())
        if (!point.node->masters.empty())
          {
            const double m = model.bodies.dim *
                             static_cast<double>(point.node->masters.size());
            sum += m * (2 * stencil(point.node->body) + m);
          }
      return sum;
    }

    /** The most that a run takes that asks for so much more from here on, where
     * meshes have given theirs back [bytes]. */
    double
    memory_with(const double more)
    {
      const double now = resident_memory();
      return std::max(peak_memory(), (now > 0 ? now : peak_memory()) + more);
    }

    /** What processes share. In the plane fronts of rows and levels outweigh
     * numbers of the matrix. */
    double
    bytes_of_unknown(const contact::ContactModel &model)
    {
      const double unequal = unequal_part(model);
      if (model.bodies.dim == 2)
        return shared_bytes[0] * (1 + (larger_if_unequal - 1) * unequal);
      const auto n = static_cast<double>(model.coordinates.n_unknowns());
      return shared_bytes[1] * (1 - unequal) +
             bytes_of_entry * entries(model) / n;
    }

    /** Of one process. */
    double
    seconds_of_iterating(const contact::ContactModel &model,
                         const std::size_t            n_increments)
    {
      const auto        n = static_cast<double>(model.coordinates.n_unknowns());
      const std::size_t d = model.bodies.dim - 2;
      const auto        increments = static_cast<double>(n_increments);
      const double longer = 1 + (longer_if_unequal - 1) * unequal_part(model);
      const double n_pairings =
        model.points.slide() ? pairings_of_increment * increments : 1;
      const double n_solutions =
        model.points.slide() ? part_of_pairing * n_pairings : increments;
      return n * (setup_of_unknown[d] * n_pairings + increment_of_unknown[d] *
                                                       n_solutions * longer *
                                                       many_iterations(model));
    }
  } // namespace



  Eigen::Index
  largest_system(const contact::ContactModel &model)
  {
    Eigen::Index n = 0;
    for (const bodies::Structure *body : model.bodies.structures)
      n = std::max<Eigen::Index>(n, body->n_dofs());
    return n;
  }



  Cost
  estimate_cost(const contact::ContactModel &model,
                const std::size_t            n_increments,
                const std::size_t            n_drawings,
                const int)
  {
    const auto n_contact  = static_cast<double>(model.points.n_unknowns());
    const auto increments = static_cast<double>(n_increments);
    Cost       cost;
    const condensed::FactorEstimate factor = model.estimate_factor();
    cost.factor                            = factor;
    // ties are rows of it, but none of the increments
    const double n_rows =
      n_contact + static_cast<double>(model.points.n_bound_unknowns());
    cost.stiffness_bytes = 8 * n_rows * n_rows;
    // and at most as much again for Newton's matrix
    cost.memory_bytes = memory_with(
      factor.working_bytes + 2 * cost.stiffness_bytes +
      bytes_of_flexibilities(model, cost.stiffness_bytes) +
      part_of_factor * factor.factor_bytes +
      bytes_of_dof * static_cast<double>(model.coordinates.n_dofs()));
    double flops = flops_of_condensing(model, factor, n_increments);
    for (const double n : flexibilities(model))
      flops += n * n * n;
    cost.seconds = cpu_seconds() + flops / dense_rate() +
                   seconds_of_results(model, increments, n_drawings);
    if (model.points.slide())
      cost.seconds += sliding_of_unknown * n_contact * increments;
    return cost;
  }



  Cost
  estimate_iterative_cost(const contact::ContactModel &model,
                          const std::size_t            n_increments,
                          const std::size_t            n_drawings,
                          const int                    n_processes)
  {
    Assert(n_processes > 0, dealii::ExcMessage("There is a process."));
    const auto        n = static_cast<double>(model.coordinates.n_unknowns());
    const std::size_t d = model.bodies.dim - 2;
    const auto        increments = static_cast<double>(n_increments);
    const double      share      = n / n_processes;
    const bool   pairs = model.condensed_form() == solvers::Form::compliance;
    const double longer =
      pairs ? 1 + (longer_of_unequal_pairs - 1) * unequal_part(model) : 1.;
    const double solution =
      longer * seconds_of_iterating(model, n_increments) / n_processes;
    const double shared = share * bytes_of_unknown(model);
    Cost         cost;
    cost.memory_bytes = memory_with(bytes_of_each[d] * n + shared);
    cost.seconds      = cpu_seconds() + solution +
                   seconds_of_results(model, increments, n_drawings);
    if (n_processes > 1)
      {
        // each knows the whole scene
        cost.memory_of_others  = cost.memory_bytes;
        cost.seconds_of_others = cost.seconds;
      }
    return cost;
  }



  BackendChoice
  cheaper_backend(const contact::ContactModel &model,
                  const std::size_t            n_increments,
                  const std::size_t            n_drawings)
  {
    const contact::ElasticityRow &condensed = contact::condensed_row();
    const contact::ElasticityRow &iterative = contact::iterative_row();
    const Eigen::Index            n         = model.coordinates.n_unknowns();
    if (const std::string why = iterative.why_not(model); !why.empty())
      return {&condensed, "the iterative one " + why};
    const bool   slow      = largest_contrast(model) > 2 * usual_contrast;
    const bool   hard_one  = has_hard_slave(model);
    const bool   uncertain = hard_one || model.points.slide();
    const double flops_iterative =
      usual_rate * seconds_of_iterating(model, n_increments);
    if (!uncertain &&
        flops_of_contact(model, static_cast<double>(n_increments)) >
          much_faster * flops_iterative)
      return {&iterative, "many nodes may touch"};
    const bool many = model.points.n_unknowns() >= many_unknowns;
    if (!many)
      {
        if (model.bodies.dim == 2)
          return {&condensed, "bodies in the plane condense fast"};
        if (n < small_body)
          return {&condensed, "the mesh is small"};
      }
    if (model.bodies.dim == 3 && largest_system(model) > huge_body && !slow &&
        !hard_one)
      return {&iterative, "the mesh is large"};
    const Cost cost  = estimate_cost(model, n_increments, n_drawings);
    const Cost other = estimate_iterative_cost(model, n_increments, n_drawings);
    const double flops_condensed =
      flops_of_condensing(model, *cost.factor, n_increments);
    const auto text = [](const double flops, const double bytes) {
      char operations[40];
      std::snprintf(operations, sizeof(operations), "%.2g", flops);
      return operations + (" operations and " + megabytes(bytes));
    };
    const bool is_faster =
      !uncertain &&
      flops_condensed > (many ? faster : much_faster) * flops_iterative;
    return {cost.memory_bytes > machine_memory() || is_faster ? &iterative :
                                                                &condensed,
            "condensed " + text(flops_condensed, cost.memory_bytes) +
              ", iterative " + text(flops_iterative, other.memory_bytes) +
              (slow      ? ", as a body is nearly incompressible" :
               hard_one  ? ", as a slave is harder than its master" :
               uncertain ? ", as contacts slide far" :
                           "")};
  }



  namespace
  {
    /** Nothing if this machine has not the memory. */
    std::optional<Cost>
    cost_if_it_fits(const contact::ContactModel &model,
                    const std::size_t            n_increments,
                    const std::size_t            n_drawings)
    {
      if (model.bodies.dim == 3 && largest_system(model) > huge_body)
        return {}; // to ask how much would take long, too
      const Cost cost = estimate_cost(model, n_increments, n_drawings);
      if (cost.memory_bytes > machine_memory())
        return {};
      return cost;
    }
  } // namespace

  bool
  fits_condensed(const contact::ContactModel &model,
                 const std::size_t            n_increments,
                 const std::size_t            n_drawings)
  {
    return cost_if_it_fits(model, n_increments, n_drawings).has_value();
  }



  double
  iterations_of_condensing(const contact::ContactModel &model,
                           const std::size_t            n_increments,
                           const std::size_t            n_drawings)
  {
    const auto cost = cost_if_it_fits(model, n_increments, n_drawings);
    if (!cost)
      return std::numeric_limits<double>::infinity();
    const double longer = 1 + (longer_if_unequal - 1) * unequal_part(model);
    return flops_of_condensing(model, *cost->factor, n_increments) /
           (iteration_of_unknown * longer *
            static_cast<double>(model.coordinates.n_unknowns()));
  }



  std::string
  megabytes(const double bytes)
  {
    char text[40];
    std::snprintf(text, sizeof(text), "%.4g MB", bytes / 1e6);
    return text;
  }



  double
  peak_memory()
  {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024. * static_cast<double>(usage.ru_maxrss);
  }
} // namespace conetact::analysis
