// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/run_context.h"

#include "conetact/analysis/cost.h"
#include "conetact/analysis/scene_report.h"
#include "conetact/base/process.h"
#include "conetact/contact/preloads.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/symmetric_tensor.h>

#include <utility>

namespace conetact::analysis
{
  namespace
  {
    /** The model is solved by it from here on. */
    const Backend &
    with_backend(const application::Scene &scene,
                 contact::ContactModel    &model,
                 Log                      &log)
    {
      const Backend &backend = choose_backend(scene, model, log);
      model.solve_by(*backend.elasticity);
      return backend;
    }
  } // namespace

  RunContext::RunContext(const application::Scene &s, Log &l)
    : scene(s)
    , log(l)
    , model(scene.bodies,
            scene.stages.times_of_last(scene.times),
            *scene.condenser,
            scene.preconditioner)
    , loads(scene.nodal_loads())
    , prestress(contact::prestress_forces(scene.bodies))
    , backend(&with_backend(scene, model, log))
    , history(model)
    , acceptance(scene, model, l)
  {
    history.wear().set_sides(
      std::make_shared<const contact::WornSides>(scene.contacts,
                                                 scene.bodies.structures));
  }

  double
  RunContext::begin(const unsigned int k) const
  {
    AssertIndexRange(k, scene.times.size() + 1);
    return k > 1 ? scene.times[k - 2] : 0.;
  }

  double
  RunContext::duration(const unsigned int k) const
  {
    AssertIndexRange(k - 1, scene.times.size());
    return scene.times[k - 1] - begin(k);
  }

  std::string
  RunContext::increment_name(const model::IncrementRecord &record) const
  {
    return "Increment " + std::to_string(record.increment) + " of " +
           std::to_string(scene.times.size());
  }

  void
  RunContext::make_elasticity()
  {
    const contact::Elasticity   &elastic = model.elasticity();
    const contact::ElasticReport report  = elastic.report();
    give_back_memory();
    log.time(report.description +
             (report.factor_bytes > 0 ?
                ", factor of " + megabytes(report.factor_bytes) :
                ""));
    const auto n = static_cast<double>(model.points.n_all_unknowns());
    if (elastic.system()->matrix.size() > 0)
      log.note("condensed stiffness: " + megabytes(8 * n * n));
    report_shared_bodies(model.bodies, report.n_shared_bodies, log);
  }

  void
  RunContext::apply_loads(PendingIncrement &increment)
  {
    const double t    = increment.record.time;
    increment.load    = {}; // before there is another one
    increment.forces  = {};
    increment.thermal = {};
    increment.record.each_load.clear();
    take_loads(t, increment);
    increment.load =
      model.load_case(*increment.mechanical, increment.thermal, t);
    increment.wet.clear();
    set_laws(increment);
    if (const auto &laws = increment.load.laws)
      model.points.set_friction(laws->coefficients(history.start()));
  }

  std::shared_ptr<const contact::IncrementLaws>
  RunContext::laws_from(const contact::ContactHistory &before,
                        const PendingIncrement        &increment) const
  {
    const double t = increment.record.time;
    return before.laws_until(
      t,
      [&](const unsigned int body, const Point<3> &p) {
        return loads.temperature(body, p, t);
      },
      increment.wet);
  }

  void
  RunContext::set_laws(PendingIncrement &increment)
  {
    increment.load.laws = laws_from(history, increment);
  }

  void
  RunContext::take_loads(const double t, PendingIncrement &increment)
  {
    bodies::NodalLoads::Acting acting = loads.acting(t);
    Eigen::VectorXd            others = scene.obstacle_forces(t);
    if (prestress.size() > 0)
      others += prestress;
    increment.thermal = std::move(acting.thermal);
    if (!model.bodies.frames.empty())
      return turn_loads(others, increment);
    acting.mechanical += others;
    increment.mechanical = contact::shared(std::move(acting.mechanical));
    increment.forces     = increment.mechanical;
    if (increment.thermal.size() > 0)
      increment.forces = contact::shared(acting.both + others);
    for (const auto &[force, moment] : acting.each)
      increment.record.each_load.push_back({force, moment});
  }

  /* The traction of a total has its force and its moment in space where its
     faces stand now: as a field it turns with the body. */
  Eigen::VectorXd
  RunContext::in_frame(const bodies::Load    &load,
                       const Eigen::VectorXd &undeformed,
                       const double           t) const
  {
    const pairing::RigidMotion &frame = model.bodies.frames[load.body];
    if (!load.is_total() || !frame.has_turned())
      return undeformed;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(undeformed.size());
    load.add(*model.bodies.structures[load.body], t, f, frame.rotation);
    return f;
  }

  /* In the frames of bodies, some loads turn with them and others against
     them; in space, forces act where bodies have come to. */
  void
  RunContext::turn_loads(const Eigen::VectorXd &others,
                         PendingIncrement      &increment)
  {
    const contact::Coordinates &coordinates = model.coordinates;
    Eigen::VectorXd             all = coordinates.forces_in_frames(others);
    Eigen::VectorXd             mechanical = all;
    loads.visit(increment.record.time,
                [&](const bodies::Load &load, const Eigen::VectorXd &on_body) {
                  Eigen::VectorXd f = Eigen::VectorXd::Zero(others.size());
                  f.segment(coordinates.offset(load.body), on_body.size()) =
                    in_frame(load, on_body, increment.record.time);
                  if (!load.follows() && !load.is_total())
                    f = coordinates.forces_in_frames(f);
                  all += f;
                  if (!load.strains())
                    mechanical += f;
                  increment.record.each_load.push_back(
                    load.strains() ? // which balances
                      model::Resultant() :
                      verification::resultant(model.bodies,
                                              coordinates,
                                              coordinates.forces_in_space(f)));
                });
    increment.forces     = contact::shared(std::move(all));
    increment.mechanical = contact::shared(std::move(mechanical));
  }
} // namespace conetact::analysis
