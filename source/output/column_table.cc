// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/column_table.h"

#include <regex>

namespace conetact::output
{
  namespace
  {
    struct Row
    {
      const char *columns; ///< a regular expression
      Judged      judged;
      const char *kind;
    };

    /** The first row that fits; no row: compared, by itself. */
    const Row column_rules[] = {
      {"solver|err1|err2", Judged::told, ""},
      {"iterations|substeps", Judged::counted, ""},
      {"residual|equilibrium|balance(_.*)?", Judged::bounded, ""},
      {"gap|d?u_(n|t1|t2)|wear", Judged::compared, "displacements"},
      {"r_(n|t1|t2)", Judged::compared, "reactions"},
      {"pressure|traction_.*", Judged::compared, "tractions"},
      {"[xyz]|(foot|acts)_[xyz]", Judged::compared, "places"},
      {"n_[xyz]", Judged::compared, "normals"},
      {".*_f_[xyz]", Judged::compared, "forces"},
      {".*_m_[xyz]", Judged::compared, "moments"},
      {"strain_energy|external_work|dissipation|contact_work_normal",
       Judged::compared,
       "energies"},
      {"largest_displacement_[xyz]|largest_pressure_[xyz]",
       Judged::compared,
       "places of the largest"},
      {".*_u_[xyz]|largest_displacement", Judged::compared, "motions"},
      {".*_rot_[xyz]", Judged::compared, "turns"}};
  } // namespace



  ColumnRule
  rule_of(const std::string &column)
  {
    for (const Row &row : column_rules)
      if (std::regex_match(column, std::regex(row.columns)))
        return {row.judged, row.kind};
    return {};
  }
} // namespace conetact::output
