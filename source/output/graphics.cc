// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/graphics.h"

#include "conetact/base/atomic_file.h"
#include "conetact/output/csv.h"

#include <deal.II/base/data_out_base.h>

#include <cstdio>
#include <regex>
#include <sstream>

namespace conetact::output
{
  namespace
  {
    namespace fs = std::filesystem;

    std::string
    vtu_name(const std::string &stem, const unsigned int increment)
    {
      char number[16];
      std::snprintf(number, sizeof(number), "-%04u.vtu", increment);
      return stem + number;
    }

    Tensor<1, 3>
    to_global(const ContactRow &row, const Tensor<1, 3> &v)
    {
      return v[0] * row.normal + v[1] * row.t1 + v[2] * row.t2;
    }

    using Patch = dealii::DataOutBase::Patch<0, 3>;
    using dealii::DataComponentInterpretation::component_is_part_of_vector;
    using Range = std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>;

    // What is drawn at each contact node, in the order of values().
    const std::vector<std::string> vectors = {"reaction",
                                              "traction",
                                              "slip",
                                              "u",
                                              "normal"};
    const std::vector<std::string> scalars = {"gap", "state", "contact"};

    std::vector<double>
    values(const ContactRow &row)
    {
      const Tensor<1, 3> reaction = to_global(row, row.reaction);
      const Tensor<1, 3> traction =
        row.area > 0 ? reaction / row.area : Tensor<1, 3>();
      const Tensor<1, 3> slip = row.du[1] * row.t1 + row.du[2] * row.t2;

      std::vector<double> v;
      for (const Tensor<1, 3> &vector :
           {reaction, traction, slip, to_global(row, row.u), row.normal})
        for (unsigned int d = 0; d < 3; ++d)
          v.push_back(vector[d]);
      v.push_back(row.gap);
      v.push_back(static_cast<double>(row.state));
      v.push_back(row.contact);
      return v;
    }

    std::vector<std::string>
    component_names()
    {
      std::vector<std::string> names;
      for (const std::string &name : vectors)
        names.insert(names.end(), 3, name);
      names.insert(names.end(), scalars.begin(), scalars.end());
      return names;
    }

    std::vector<Range>
    vector_ranges()
    {
      std::vector<Range> ranges;
      for (unsigned int i = 0; i < vectors.size(); ++i)
        ranges.emplace_back(3 * i,
                            3 * i + 2,
                            vectors[i],
                            component_is_part_of_vector);
      return ranges;
    }

    std::vector<Patch>
    points(const std::vector<ContactRow> &rows)
    {
      std::vector<Patch> patches(rows.size());
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          const std::vector<double> v = values(rows[i]);
          patches[i].vertices[0]      = rows[i].position;
          patches[i].patch_index      = i;
          patches[i].data.reinit(static_cast<unsigned int>(v.size()), 1);
          for (unsigned int c = 0; c < v.size(); ++c)
            patches[i].data(c, 0) = static_cast<float>(v[c]);
        }
      return patches;
    }

    std::string
    contact_vtu(const IncrementRecord &record)
    {
      std::ostringstream            out;
      dealii::DataOutBase::VtkFlags flags;
      flags.time                = record.time;
      flags.cycle               = record.increment;
      flags.print_date_and_time = false; // the same run, the same file
      dealii::DataOutBase::write_vtu(
        points(record.rows), component_names(), vector_ranges(), flags, out);
      return out.str();
    }

    // ParaView groups files by their numbers: those of a longer run before
    // this one would seem to go on where this one ends.
    void
    remove_old_files(const fs::path &folder)
    {
      static const std::regex ours(
        "(solution-[A-Za-z0-9_.-]+|contact)-[0-9]{4,}\\.vtu|"
        "mechanism(-[A-Za-z0-9_.-]+)?\\.vtu|"
        "(solution|contact|mechanism)\\.pvd");
      std::error_code       error; // if one cannot be removed, it stays
      std::vector<fs::path> old;
      for (const auto &file : fs::directory_iterator(folder, error))
        if (std::regex_match(file.path().filename().string(), ours))
          old.push_back(file.path());
      for (const fs::path &file : old)
        fs::remove(file, error);
    }

    /** Displacements of a body without its rigid motion, where these are known.
     */
    const Eigen::VectorXd &
    deformation(const IncrementRecord &record, const std::size_t body)
    {
      return record.deformations.empty() ? record.displacements.at(body) :
                                           record.deformations.at(body);
    }
  } // namespace



  // An old collection must not pass for one of this run.
  PvdFile::PvdFile(const fs::path &path)
    : file(path)
  {
    std::error_code ignored; // if it cannot be removed, nor can it be written
    fs::remove(file, ignored);
  }



  void
  PvdFile::add(const double                                            time,
               const std::vector<std::pair<std::string, std::string>> &blocks)
  {
    unsigned int part = 0;
    for (const auto &[name, vtu] : blocks)
      {
        entries += "    <DataSet timestep=\"";
        append_number(entries, time);
        entries += "\" group=\"\" part=\"" + std::to_string(part++) +
                   "\" name=\"" + name + "\" file=\"" + vtu + "\"/>\n";
      }
    write_atomically(file,
                     "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"Collection\" version=\"0.1\" "
                     "byte_order=\"LittleEndian\">\n  <Collection>\n" +
                       entries + "  </Collection>\n</VTKFile>\n");
  }



  Graphics::Graphics(const RunDescription &description)
    : run(description)
    , solution(description.folder / "solution.pvd")
    , contact(description.folder / "contact.pvd")
  {
    remove_old_files(run.folder);
  }



  void
  Graphics::write(const std::vector<IncrementRecord> &finished)
  {
    for (const IncrementRecord &record : finished)
      if (run.is_drawn(record.increment))
        {
          write_bodies(record);
          write_contacts(record);
          ++drawings;
        }
  }



  OutputWork
  Graphics::work() const
  {
    return {drawings, 0};
  }



  void
  Graphics::write_bodies(const IncrementRecord &record)
  {
    std::vector<std::pair<std::string, std::string>> blocks;
    const std::vector<std::string> names = safe_names(run.bodies);
    for (unsigned int b = 0; b < record.displacements.size(); ++b)
      {
        const std::string body = names.at(b);
        const std::string name = vtu_name("solution-" + body, record.increment);
        run.structures.at(b)->write_graphics(record.displacements[b],
                                             deformation(record, b),
                                             record.actions.at(b),
                                             record.time,
                                             run.folder / name);
        blocks.emplace_back(body, name);
      }
    if (!blocks.empty())
      solution.add(record.time, blocks);
  }



  void
  Graphics::write_contacts(const IncrementRecord &record)
  {
    if (record.rows.empty())
      return;
    const std::string name = vtu_name("contact", record.increment);
    write_atomically(run.folder / name, contact_vtu(record));
    contact.add(record.time, {{"contact", name}});
  }
} // namespace conetact::output
