// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/graphics.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/partition.h"
#include "conetact/base/process.h"
#include "conetact/base/team.h"
#include "conetact/output/csv.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <regex>

namespace conetact::output
{
  namespace
  {
    namespace fs = std::filesystem;

    /** A process that has fewer cells to draw gains nothing. */
    constexpr Eigen::Index cells_worth_a_piece = 20000;

    std::string
    numbered(const std::string &stem, const unsigned int increment)
    {
      char number[16];
      std::snprintf(number, sizeof(number), "-%04u", increment);
      return stem + number;
    }

    std::string
    vtu_name(const std::string &stem, const unsigned int increment)
    {
      return numbered(stem, increment) + ".vtu";
    }

    std::vector<std::string>
    names_of_pieces(const std::string &stem, const int n_pieces)
    {
      std::vector<std::string> files;
      for (int p = 0; p < n_pieces; ++p)
        files.push_back(stem + '.' + std::to_string(p) + ".vtu");
      return files;
    }

    /** The increment of one of our files, 0 of others. */
    unsigned long
    increment_of(const std::string &name)
    {
      static const std::regex form(
        R"(.*-([0-9]{4,9})(\.vtu|\.[0-9]+\.vtu|\.pvtu))");
      constexpr std::size_t longest = 255; // name of a file
      std::smatch           parts;
      return name.size() <= longest && std::regex_match(name, parts, form) ?
               std::stoul(parts[1]) :
               0;
    }

    std::vector<std::vector<unsigned int>>
    cells_of_pieces(const VtuGrid &grid, const int n_pieces)
    {
      std::vector<WeighedNode> places;
      for (std::size_t cell = 0; cell < grid.n_cells(); ++cell)
        {
          const Point<3> &p = grid.place_of_cell(cell);
          places.push_back({{{p[0], p[1], p[2]}}, 1.});
        }
      std::vector<std::vector<unsigned int>> cells(
        static_cast<std::size_t>(n_pieces));
      unsigned int cell = 0;
      for (const int piece : partition(places, n_pieces))
        cells[static_cast<std::size_t>(piece)].push_back(cell++);
      return cells;
    }

    void
    check_sizes(const VtuGrid &grid)
    {
      Assert(std::all_of(grid.point_fields.begin(),
                         grid.point_fields.end(),
                         [&](const VtuField &field) {
                           return field.values.size() ==
                                  field.n_components * grid.points.size();
                         }),
             dealii::ExcMessage("Fields of points have values for each."));
      Assert(std::all_of(grid.cell_fields.begin(),
                         grid.cell_fields.end(),
                         [&](const VtuField &field) {
                           return field.values.size() ==
                                  field.n_components * grid.n_cells();
                         }),
             dealii::ExcMessage("Fields of cells have values for each."));
      Assert(std::all_of(grid.cell_ids.begin(),
                         grid.cell_ids.end(),
                         [&](const VtuIds &ids) {
                           return ids.values.size() == grid.n_cells();
                         }),
             dealii::ExcMessage("Ids of cells are those of each."));
      (void)grid;
    }

    // ParaView groups files by their numbers: those of a longer run before
    // this one would seem to go on where this one ends. Those of a run that
    // goes on stay.
    void
    remove_old_files(const fs::path &folder, const unsigned int n_kept)
    {
      static const std::regex ours(
        R"(((solution|surface)-[A-Za-z0-9_.-]+|contact)-[0-9]{4,}\.vtu|)"
        R"(solution-[A-Za-z0-9_.-]+-[0-9]{4,}(\.[0-9]+\.vtu|\.pvtu)|)"
        R"(mechanism(-[A-Za-z0-9_.-]+)?\.vtu|mechanism\.pvd)");
      std::error_code       error; // if one cannot be removed, it stays
      std::vector<fs::path> old;
      for (const auto &file : fs::directory_iterator(folder, error))
        if (const std::string name = file.path().filename().string();
            std::regex_match(name, ours) &&
            (n_kept == 0 || increment_of(name) > n_kept))
          old.push_back(file.path());
      for (const fs::path &file : old)
        fs::remove(file, error);
    }

    /** Displacements of a body without its rigid motion, where these are known.
     */
    const Eigen::VectorXd &
    deformation(const model::IncrementRecord &record, const std::size_t body)
    {
      return record.deformations.empty() ? record.displacements.at(body) :
                                           record.deformations.at(body);
    }
  } // namespace



  // An old collection must not pass for one of this run.
  PvdFile::PvdFile(const fs::path &path, const unsigned int n_kept)
    : file(path)
  {
    std::ifstream old(file);
    for (std::string line; n_kept > 0 && std::getline(old, line);)
      {
        const auto name = line.find("file=\"");
        if (name != line.npos && line.size() > name + 9 &&
            increment_of(line.substr(name + 6, line.size() - name - 9)) <=
              n_kept)
          entries += line + '\n';
      }
    if (entries.empty())
      remove_file(file); // if it cannot be removed, nor can it be written
    else
      write();
  }



  void
  PvdFile::add(const double time, const std::vector<Block> &blocks)
  {
    unsigned int part = 0;
    for (const auto &[name, vtu] : blocks)
      {
        entries += "    <DataSet timestep=\"";
        append_number(entries, time);
        entries += "\" group=\"\" part=\"" + std::to_string(part++) +
                   "\" name=\"" + name + "\" file=\"" + vtu + "\"/>\n";
      }
    write();
  }



  void
  PvdFile::write() const
  {
    write_atomically(file,
                     "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"Collection\" version=\"0.1\" "
                     "byte_order=\"LittleEndian\">\n  <Collection>\n" +
                       entries + "  </Collection>\n</VTKFile>\n");
  }



  Graphics::Graphics(const RunDescription &description)
    : run(description)
    , names(safe_names(run.bodies))
    , n_kept(run.goes_on_in_place() ? run.n_former : 0)
    , solution(run.folder / "solution.pvd", n_kept)
    , surface(run.folder / "surface.pvd", n_kept)
    , contact(run.folder / "contact.pvd", n_kept)
    , scene(run.folder / "scene.pvd", n_kept)
  {
    if (ProcessSession::speaks())
      remove_old_files(run.folder, n_kept);
  }



  void
  Graphics::begin(const model::IncrementRecord &undeformed)
  {
    if (run.vtu_every > 0)
      draw(undeformed);
  }



  void
  Graphics::write(const std::vector<model::IncrementRecord> &finished)
  {
    for (const model::IncrementRecord &record : finished)
      if (run.is_drawn(record.increment))
        {
          draw(record);
          ++drawings;
        }
  }



  OutputWork
  Graphics::work() const
  {
    return {drawings, 0};
  }



  void
  Graphics::draw(const model::IncrementRecord &record)
  {
    Assert(record.displacements.size() <= run.structures.size(),
           dealii::ExcMessage("What is drawn are bodies of the run."));
    agree([&] { write_bodies(record); });
    agree([&] {
      if (ProcessSession::speaks())
        write_rest(record);
    });
  }



  std::string
  Graphics::stem(const model::IncrementRecord &record,
                 const std::size_t             body) const
  {
    return numbered("solution-" + names.at(body), record.increment);
  }



  void
  Graphics::write_rest(const model::IncrementRecord &record)
  {
    const auto list = [&](const std::vector<Block> &blocks, PvdFile &pvd) {
      if (!blocks.empty())
        pvd.add(record.time, blocks);
    };
    std::vector<Block> bodies;
    for (std::size_t b = 0; b < record.displacements.size(); ++b)
      {
        const bool is_one = pieces.at(b).n == 1;
        bodies.emplace_back(names.at(b),
                            stem(record, b) + (is_one ? ".vtu" : ".pvtu"));
        if (!is_one)
          write_atomically(run.folder / bodies.back().second, pieces[b].joint);
      }
    list(bodies, solution);
    list(write_surfaces(record), surface);
    list(write_contacts(record), contact);
    for (Block &block : bodies)
      block.first = "body " + block.first;
    scene.add(record.time, bodies);
  }



  std::string
  Graphics::text_of(VtuGrid grid, const model::IncrementRecord &record) const
  {
    run.units.label(grid);
    return grid.text(record.time, record.increment);
  }



  void
  Graphics::write_bodies(const model::IncrementRecord &record)
  {
    const std::size_t n = record.displacements.size();
    for (std::size_t b = skins.size(); b < n; ++b)
      skins.push_back(make_skin(*run.structures.at(b)));
    pieces.resize(std::max(pieces.size(), n));
    for (unsigned int b = 0; b < n; ++b)
      if (pieces[b].n != 1 || ProcessSession::speaks())
        write_body(record, b);
  }



  /* In pieces where there are processes to share it; each keeps its cells from
     one increment to the next. */
  void
  Graphics::write_body(const model::IncrementRecord &record,
                       const unsigned int            body)
  {
    VtuGrid grid = run.structures.at(body)->drawing(record.displacements[body],
                                                    deformation(record, body),
                                                    record.actions.at(body));
    grid.cell_ids.push_back(
      {"body", std::vector<int>(grid.n_cells(), static_cast<int>(body))});
    add_contact(skins.at(body), run, record, body, grid);
    run.units.label(grid);
    check_sizes(grid);
    Pieces &piece = pieces[body];
    // those of a run that the first process goes on with alone, too
    const int  n     = processes_for(static_cast<Eigen::Index>(grid.n_cells()),
                                cells_worth_a_piece);
    const auto p     = static_cast<std::size_t>(team().rank());
    const auto write = [&](const std::string &file, const VtuGrid &part) {
      replace_file(run.folder / file, [&](const fs::path &temporary) {
        append_to_file(temporary, part.text(record.time, record.increment));
      });
    };
    if (n > 1 && piece.n != n)
      piece.own = cells_of_pieces(grid, n).at(p);
    piece.n = n;
    if (n == 1 && ProcessSession::speaks())
      write(stem(record, body) + ".vtu", grid);
    if (n == 1)
      return;
    const auto files = names_of_pieces(stem(record, body), n);
    piece.joint      = grid.text_of_parts(files);
    write(files.at(p), grid.part(piece.own));
  }



  std::vector<Block>
  Graphics::write_surfaces(const model::IncrementRecord &record) const
  {
    std::vector<Block> blocks;
    for (unsigned int b = 0; b < record.displacements.size(); ++b)
      if (skins.at(b).grid.n_cells() > 0)
        {
          blocks.emplace_back(names.at(b),
                              vtu_name("surface-" + names[b],
                                       record.increment));
          write_atomically(run.folder / blocks.back().second,
                           text_of(draw_skin(skins[b], run, record, b),
                                   record));
        }
    return blocks;
  }



  std::vector<Block>
  Graphics::write_contacts(const model::IncrementRecord &record) const
  {
    if (record.rows.empty())
      return {};
    const std::string name = vtu_name("contact", record.increment);
    write_atomically(run.folder / name,
                     text_of(draw_contact_nodes(run, record), record));
    return {{"contact", name}};
  }
} // namespace conetact::output
