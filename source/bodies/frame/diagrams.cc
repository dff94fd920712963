// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/diagrams.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace conetact::bodies
{
  namespace
  {
    using Vector3 = Eigen::Vector3d;

    Vector3
    local(const Member &member, const Tensor<1, 3> &v)
    {
      return {member.axis(0) * v, member.axis(1) * v, member.axis(2) * v};
    }

    /** Sums of loads, and of loads times their places, from the start on. */
    struct LoadSums
    {
      std::vector<Vector3> force, first_moment; ///< up to cut i

      LoadSums(const Member      &member,
               const MemberLoad  &load,
               const unsigned int n)
        : force(n + 1, Vector3::Zero())
        , first_moment(n + 1, Vector3::Zero())
      {
        static const dealii::QGauss<1> gauss(3);
        const double                   h = member.length() / n;
        for (unsigned int i = 0; i < n; ++i)
          {
            force[i + 1]        = force[i];
            first_moment[i + 1] = first_moment[i];
            const auto add      = [&](const double place, const Vector3 &f) {
              force[i + 1] += f;
              first_moment[i + 1] += place * member.length() * f;
            };
            for (const VectorField &q : load.per_length)
              for (unsigned int g = 0; g < gauss.size(); ++g)
                {
                  const double s = (i + gauss.point(g)[0]) / n;
                  add(s,
                      gauss.weight(g) * h * local(member, q(member.point(s))));
                }
            for (const auto &[s, p] : load.points)
              if (s * n > i && s * n <= i + 1)
                add(s, local(member, p));
          }
      }
    };

    /**
     * Integrates a curvature given at 0, h/2, h, ... twice (exact where it is
     * quadratic between whole steps) and adds what brings the end to w_end.
     */
    std::vector<double>
    deflection(const std::vector<double> &curvature,
               const double               length,
               const double               w_start,
               const double               w_end)
    {
      const std::size_t   n = (curvature.size() - 1) / 2;
      const double        h = length / static_cast<double>(n);
      std::vector<double> w(n + 1, 0.);
      double              slope = 0;
      for (std::size_t i = 0; i < n; ++i)
        {
          const double a = curvature[2 * i], m = curvature[2 * i + 1],
                       b = curvature[2 * i + 2];
          w[i + 1]       = w[i] + h * slope + h * h / 6 * (a + 2 * m);
          slope += h / 6 * (a + 4 * m + b);
        }
      const double miss = w_end - w_start - w[n];
      for (std::size_t i = 0; i <= n; ++i)
        w[i] +=
          w_start + miss * static_cast<double>(i) / static_cast<double>(n);
      return w;
    }

    /** Displacements in local axes at each second cut. */
    std::vector<Vector3>
    displacements(const Member                     &member,
                  const Member::Vector             &u,
                  const MemberLoad                 &load,
                  const std::vector<MemberSection> &cuts)
    {
      const FrameSection &section = member.section();
      const double        e       = section.young_modulus;
      const double        n       = static_cast<double>((cuts.size() - 1) / 2);
      std::vector<double> y, z;
      for (const MemberSection &cut : cuts)
        {
          y.push_back(member.bends() ? cut.moment[2] / (e * section.inertia_z) :
                                       0);
          z.push_back(section.inertia_y > 0 && member.bends() ?
                        -cut.moment[1] / (e * section.inertia_y) :
                        0);
        }
      y = deflection(y, member.length(), u[1], u[7]);
      z = deflection(z, member.length(), u[2], u[8]);

      std::vector<Vector3> result;
      double               x = u[0];
      for (std::size_t i = 0; i < y.size(); ++i)
        {
          result.emplace_back(x, y[i], z[i]);
          if (i + 1 < y.size())
            x += member.length() / n *
                 (load.initial_strain +
                  (cuts[2 * i].force[0] + 4 * cuts[2 * i + 1].force[0] +
                   cuts[2 * i + 2].force[0]) /
                    (6 * e * section.area));
        }
      return result;
    }

    /** Of the loads before x, times their distance from x to a power. */
    Vector3
    load_moment(const Member      &member,
                const MemberLoad  &load,
                const double       x,
                const unsigned int power)
    {
      // Exact for the third power times loads of degree 6.
      static const dealii::QGauss<1> gauss(5);
      Vector3                        sum = Vector3::Zero();
      for (const VectorField &q : load.per_length)
        for (unsigned int g = 0; g < gauss.size(); ++g)
          {
            const double before = gauss.point(g)[0] * x;
            sum += gauss.weight(g) * x * std::pow(x - before, power) *
                   local(member, q(member.point(before / member.length())));
          }
      for (const auto &[s, p] : load.points)
        if (s * member.length() < x)
          sum += std::pow(x - s * member.length(), power) * local(member, p);
      return sum;
    }

    /** Of a member whose start neither moves nor turns, in local axes. */
    Vector3
    free_deflection(const Member         &member,
                    const Member::Vector &ends,
                    const MemberLoad     &load,
                    const double          x)
    {
      const FrameSection &section = member.section();
      const double        e       = section.young_modulus;
      const double        n_x =
        ends[0] * x + load_moment(member, load, x, 1)[0]; // integral of -N
      Vector3 u(load.initial_strain * x - n_x / (e * section.area), 0, 0);
      if (!member.bends())
        return u;
      const Vector3 cubes =
        (ends.segment<3>(0) * x * x * x + load_moment(member, load, x, 3)) / 6;
      u[1] = (cubes[1] - ends[5] * x * x / 2) / (e * section.inertia_z);
      if (section.inertia_y > 0)
        u[2] = (cubes[2] + ends[4] * x * x / 2) / (e * section.inertia_y);
      return u;
    }
  } // namespace

  Tensor<1, 3>
  member_deflection(const Member     &member,
                    const MemberLoad &load,
                    const double      place)
  {
    const Member::Vector ends = member.end_forces(Member::Vector::Zero(), load);
    const auto           at   = [&](const double s) {
      return free_deflection(member, ends, load, s * member.length());
    };
    const Vector3 u = at(place) - place * at(1); // the start of a hinge turns
    Tensor<1, 3>  sum;
    for (unsigned int a = 0; a < 3; ++a)
      sum += u[a] * member.axis(a);
    return sum;
  }

  std::vector<MemberSection>
  member_sections(const Member         &member,
                  const Member::Vector &displacement,
                  const Member::Vector &deformation,
                  const MemberLoad     &load,
                  const unsigned int    n)
  {
    const Member::Vector       ends = member.end_forces(deformation, load);
    const LoadSums             sums(member, load, 2 * n);
    std::vector<MemberSection> cuts(2 * n + 1);
    const Vector3              e_x = Vector3::UnitX();
    for (unsigned int i = 0; i < cuts.size(); ++i)
      {
        cuts[i].place  = i / (2. * n);
        const double x = cuts[i].place * member.length();
        cuts[i].force  = -(ends.segment<3>(0) + sums.force[i]);
        // moment about the cut of all that acts before it
        cuts[i].moment =
          -(ends.segment<3>(3) - x * e_x.cross(ends.segment<3>(0)) +
            e_x.cross(sums.first_moment[i] - x * sums.force[i]));
      }
    const auto along =
      displacements(member, member.to_local(displacement), load, cuts);

    std::vector<MemberSection> result;
    for (unsigned int i = 0; i <= n; ++i)
      {
        MemberSection cut = cuts[2 * i];
        cut.displacement.setZero();
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int c = 0; c < 3; ++c)
            cut.displacement[c] += along[i][a] * member.axis(a)[c];
        result.push_back(cut);
      }
    return result;
  }
} // namespace conetact::bodies
