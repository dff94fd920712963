// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/adaptive_refinement.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/team.h"
#include "conetact/base/text.h"
#include "conetact/output/csv.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace conetact::analysis
{
  namespace
  {
    /** Equal but for rounding: what is symmetric stays so. */
    constexpr double same_error = 1 - 1e-5;

    using Errors = std::vector<std::vector<double>>; ///< by body, element

    /** What is told of a mesh. */
    struct MeshRecord
    {
      unsigned int        cells = 0, dofs = 0, contact_nodes = 0;
      double              estimate = 0; ///< squared error [force*length]
      std::vector<double> resultants;   ///< normal, one a contact [force]
    };

    Errors
    element_errors(const application::Scene     &scene,
                   const model::IncrementRecord &last)
    {
      Errors errors;
      for (std::size_t b = 0; b < scene.bodies.n_elastic(); ++b)
        errors.push_back(
          scene.bodies.structures[b]->element_errors(last.displacements[b]));
      return errors;
    }

    MeshRecord
    summary(const application::Scene     &scene,
            const model::IncrementRecord &last,
            const Errors                 &errors)
    {
      MeshRecord mesh;
      for (const bodies::Structure *body : scene.bodies.structures)
        mesh.dofs += body->n_dofs();
      for (const std::vector<double> &of_body : errors)
        {
          mesh.cells += static_cast<unsigned int>(of_body.size());
          mesh.estimate =
            std::accumulate(of_body.begin(), of_body.end(), mesh.estimate);
        }
      mesh.resultants.resize(scene.contact_names.size(), 0.);
      for (const model::ContactRow &row : last.rows)
        if (!row.master)
          {
            ++mesh.contact_nodes;
            mesh.resultants[row.contact] += row.reaction[0];
          }
      return mesh;
    }

    std::string
    sentence(const MeshRecord &mesh, const std::vector<std::string> &contacts)
    {
      std::string text =
        std::to_string(mesh.cells) + " cells, " + std::to_string(mesh.dofs) +
        " dofs, " + std::to_string(mesh.contact_nodes) +
        " contact nodes, estimated squared error " + to_text(mesh.estimate);
      for (std::size_t c = 0; c < contacts.size(); ++c)
        text += ", normal resultant of " + contacts[c] + " " +
                to_text(mesh.resultants[c]);
      return text;
    }

    std::string
    header(const std::vector<std::string> &contacts)
    {
      std::string text = "mesh,cells,dofs,contact_nodes,estimate";
      for (const std::string &contact : output::safe_names(contacts))
        text += ',' + contact + "_n";
      return text + '\n';
    }

    void
    append_row(std::string       &table,
               const std::string &place,
               const unsigned int number,
               const MeshRecord  &mesh)
    {
      output::CsvRow csv(table, place);
      csv.add(number);
      csv.add(mesh.cells);
      csv.add(mesh.dofs);
      csv.add(mesh.contact_nodes);
      csv.add("the estimate", mesh.estimate);
      for (const double resultant : mesh.resultants)
        csv.add("a normal resultant", resultant);
      csv.end();
    }
  } // namespace

  std::vector<std::set<unsigned int>>
  worst_elements(const std::vector<std::vector<double>> &errors,
                 const double                            fraction)
  {
    std::vector<double> all;
    for (const std::vector<double> &of_body : errors)
      all.insert(all.end(), of_body.begin(), of_body.end());
    std::sort(all.begin(), all.end(), std::greater<>());
    const auto n = static_cast<std::size_t>(
      std::ceil(fraction * static_cast<double>(all.size())));
    const double least = n > 0 ? same_error * all[n - 1] : 0;

    std::vector<std::set<unsigned int>> worst(errors.size());
    for (std::size_t b = 0; b < errors.size(); ++b)
      for (unsigned int i = 0; i < errors[b].size(); ++i)
        if (errors[b][i] > 0 && errors[b][i] >= least)
          worst[b].insert(i);
    return worst;
  }

  void
  AdaptiveRefinement::advance(const application::Scene     &scene,
                              const model::IncrementRecord &last,
                              const std::filesystem::path  &folder,
                              Log                          &log)
  {
    const Errors      errors = element_errors(scene, last);
    const MeshRecord  mesh   = summary(scene, last, errors);
    const std::string place  = "Mesh " + std::to_string(++n_done);
    log.say(place + " of " + std::to_string(scene.adaptive.cycles + 1) + ": " +
            sentence(mesh, scene.contact_names));
    if (table.empty())
      table = header(scene.contact_names);
    append_row(table, place, n_done, mesh);
    write_atomically(folder / "refinement.csv", table);

    marked.resize(errors.size());
    const auto worst = worst_elements(errors, scene.adaptive.fraction);
    for (std::size_t b = 0; b < worst.size(); ++b)
      marked[b].push_back(worst[b]);
  }

  void
  AdaptiveRefinement::share()
  {
    const auto n_bodies = static_cast<unsigned int>(marked.size());
    std::vector<unsigned int> numbers = {n_done, n_bodies};
    for (const bodies::Refinements &of_body : marked)
      for (const std::set<unsigned int> &elements : of_body)
        {
          numbers.push_back(static_cast<unsigned int>(elements.size()));
          numbers.insert(numbers.end(), elements.begin(), elements.end());
        }
    team().broadcast(numbers);
    auto next = numbers.begin();
    n_done    = *next++;
    marked.assign(*next++, bodies::Refinements(n_done));
    for (bodies::Refinements &of_body : marked)
      for (std::set<unsigned int> &elements : of_body)
        for (unsigned int n = *next++; n > 0; --n)
          elements.insert(*next++);
  }
} // namespace conetact::analysis
