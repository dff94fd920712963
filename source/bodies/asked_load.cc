// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/asked_load.h"

#include "conetact/base/text.h"

#include <algorithm>

namespace conetact::bodies
{
  namespace
  {
    Tensor<1, 3>
    value_of(const Load &load, const double t)
    {
      Tensor<1, 3> value;
      for (unsigned int d = 0; d < std::min<std::size_t>(load.value.size(), 3);
           ++d)
        value[d] = load.value[d](load.point, t);
      return value;
    }

    /** Of a load whose value is a total. In the plane a moment is about z. */
    Total
    total_of(const Load &load, const Structure &body, const double t)
    {
      const Tensor<1, 3> value = value_of(load, t);
      if (load.kind == Load::Kind::moment)
        return {{},
                load.value.size() == 1 ? Tensor<1, 3>({0, 0, value[0]}) :
                                         value};
      if (body.is_axisymmetric())
        return {value, {}};
      return {value, cross_product_3d(Tensor<1, 3>(load.point), value)};
    }

    /** Of the larger of both, which the lever makes comparable. */
    double
    distance(const Total &asked, const Total &carried)
    {
      const auto part = [](const double difference, const double size) {
        return size > 0 ? difference / size : difference;
      };
      const double force = asked.force.norm();
      return std::max(part((carried.force - asked.force).norm(),
                           force > 0 ? force : asked.moment.norm()),
                      part((carried.moment - asked.moment).norm(),
                           std::max(asked.moment.norm(), force)));
    }

    std::string
    total(const Load      &load,
          const Structure &body,
          const double     t,
          const Total     &carried)
    {
      Total asked = total_of(load, body, t);
      // A pin presses through the axis of its bore, which is no entry.
      if (load.kind == Load::Kind::bearing)
        asked.moment = carried.moment;
      constexpr double rounding = 1e-9;
      const double     error    = distance(asked, carried);
      const bool       is_far   = error > rounding;
      return "asked: " +
             (load.kind == Load::Kind::moment ?
                "moment " + to_text(asked.moment) :
                "force " + to_text(asked.force) +
                  (load.kind == Load::Kind::force && !body.is_axisymmetric() ?
                     " at " + to_text(load.point) :
                     "")) +
             ", carried" +
             (is_far ? " but for " + to_text(error) + " of it" : "");
    }

    double
    mass_of(const double density, const Structure &body)
    {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(body.n_dofs());
      body.add(Action::body_force([&](const Point<3> &) {
                 return Tensor<1, 3>({0, density, 0});
               }),
               f);
      return sum_along_y(body, f);
    }

    /** Of a component of the value. */
    double
    mean(const Load        &load,
         const Structure   &body,
         const double       t,
         const double       area,
         const unsigned int component)
    {
      return integral(body,
                      load.ids,
                      [&](const Point<3> &p, const Tensor<1, 3> &) {
                        return load.value[component](p, t);
                      }) /
             area;
    }

    std::string
    spread_over_area(const Load &load, const Structure &body, const double t)
    {
      const double area = area_of(body, load.ids);
      if (!(area > 0))
        return "";
      std::string value;
      if (load.kind == Load::Kind::pressure)
        value = "pressure " + to_text(mean(load, body, t, area, 0));
      else
        {
          Tensor<1, 3> traction;
          for (unsigned int d = 0; d < load.value.size(); ++d)
            traction[d] = mean(load, body, t, area, d);
          value = "traction " + to_text(traction);
        }
      return "asked: mean " + value + " on an area of " + to_text(area);
    }
  } // namespace

  std::string
  what_is_asked(const Load      &load,
                const Structure &body,
                const double     t,
                const Total     &carried)
  {
    if (!load.is_active(t))
      return "";
    switch (load.kind)
      {
        case Load::Kind::force:
        case Load::Kind::moment:
        case Load::Kind::bearing:
          return total(load, body, t, carried);
        case Load::Kind::pressure:
        case Load::Kind::traction:
          return spread_over_area(load, body, t);
        case Load::Kind::centrifugal:
          return "asked: angular velocity " + to_text(value_of(load, t)[0]) +
                 " on a mass of " + to_text(mass_of(load.density, body));
        case Load::Kind::body_force:
          return load.density > 0 ?
                   "on a mass of " + to_text(mass_of(load.density, body)) :
                   "";
        default:
          return "";
      }
  }
} // namespace conetact::bodies
