// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What a run leaves on disk: columns, numbers, whole files at every moment.

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/output/closing.h"
#include "conetact/output/csv.h"
#include "conetact/output/extremes.h"
#include "conetact/output/output_table.h"
#include "conetact/output/progress.h"
#include "conetact/output/skin.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>
#include <sstream>

#include "empty_structure.h"
#include "files.h"
#include "sentence.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::output;
using namespace conetact::solvers;
namespace fs = std::filesystem;

namespace
{
  using Rows = std::vector<std::vector<std::string>>;

  Rows
  read_csv(const fs::path &file)
  {
    Rows               rows;
    std::istringstream in(test::read_file(file));
    for (std::string line; std::getline(in, line);)
      {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
          rows.back().push_back(cell);
      }
    return rows;
  }

  std::string
  cell(const Rows &rows, const std::size_t row, const std::string &column)
  {
    const auto &names = rows.at(0);
    const auto  c     = std::find(names.begin(), names.end(), column);
    if (c == names.end())
      return "no column " + column;
    return rows.at(row).at(static_cast<std::size_t>(c - names.begin()));
  }

  // A body that draws its displacements as bare numbers, or fails to.
  class Sketch : public test::EmptyStructure
  {
  public:
    bool fails = false, has_surface = false;

    unsigned int
    n_nodes() const override
    {
      return 2;
    }
    unsigned int
    n_components() const override
    {
      return 2;
    }
    Point<3>
    position(const unsigned int node) const override
    {
      return Point<3>(node, 0, 0);
    }
    VtuGrid
    drawing(const Eigen::VectorXd &u,
            const Eigen::VectorXd &w,
            const Actions &) const override
    {
      if (fails)
        throw WriteError("full");
      VtuGrid grid;
      grid.points       = {Point<3>(u[0], w[0], 0)};
      grid.point_fields = {{"displacement", 1, {u[0]}}};
      return grid;
    }
    BoundaryIds
    boundary_ids() const override
    {
      return has_surface ? BoundaryIds{7} : BoundaryIds();
    }
    Surface
    surface(const BoundaryIds &) const override
    {
      Surface surface;
      surface.faces = {{{1, 0}, {}}};
      return surface;
    }
  };

  class OutputTest : public ::testing::Test
  {
  protected:
    void
    SetUp() override
    {
      const auto *test = testing::UnitTest::GetInstance()->current_test_info();
      run.folder =
        fs::temp_directory_path() /
        ("conetact-output-" + std::to_string(::getpid()) + '-' + test->name());
      fs::create_directories(run.folder);
      run.contacts       = {"left side"};
      run.contact_bodies = {0};
      run.bodies         = {"my block"};
      run.structures     = {&body};
      run.n_increments   = 3;
    }

    void
    TearDown() override
    {
      fs::remove_all(run.folder);
    }

    model::IncrementRecord
    record(const unsigned int increment) const
    {
      model::IncrementRecord r;
      r.increment       = increment;
      r.time            = .5 * increment;
      r.report.solver   = "smoothing";
      r.report.residual = 1e-12;
      r.contacts.resize(run.contacts.size());
      r.contacts[0].force = Tensor<1, 3>({0., 30., 0.});
      r.loads.force       = Tensor<1, 3>({1e-13, -30., 0.});
      r.displacements     = {Eigen::VectorXd::Constant(4, .25)};
      r.actions           = {Actions()};
      for (unsigned int i = 0; i < 2; ++i)
        {
          model::ContactRow row;
          row.node     = i;
          row.position = Point<3>(.1 + i, 0, 0);
          row.normal   = Tensor<1, 3>({0., 1., 0.});
          row.t1       = Tensor<1, 3>({1., 0., 0.});
          row.t2       = Tensor<1, 3>({0., 0., -1.});
          row.area     = .5;
          row.foot     = Point<3>(.1 + i, -.25, 0);
          row.reaction = Tensor<1, 3>({20. - 10. * i, -1. / 3, 7.});
          row.state    = i == 0 ? NodeState::stick : NodeState::slip;
          r.rows.push_back(row);
        }
      return r;
    }

    std::unique_ptr<Output>
    create(const std::string &name) const
    {
      for (const OutputRow &row : output_table())
        if (row.name == name)
          return row.create(run);
      return nullptr;
    }

    /** The file of the sketch, none of whose points is known to be a node. */
    std::string
    drawn(const double       u,
          const double       w,
          const double       time,
          const unsigned int increment) const
    {
      VtuGrid grid;
      grid.points       = {Point<3>(u, w, 0)};
      grid.point_fields = {{"displacement", 1, {u}}};
      grid.cell_ids     = {{"body", {}}};
      add_contact(Skin(), run, record(increment), 0, grid);
      return grid.text(time, increment);
    }

    std::set<std::string>
    files() const
    {
      std::set<std::string> names;
      for (const auto &entry : fs::directory_iterator(run.folder))
        names.insert(entry.path().filename());
      return names;
    }

    Sketch         body;
    RunDescription run;
  };

  // No file may grow beyond some bytes: what a full disk looks like.
  class FullDisk
  {
  public:
    explicit FullDisk(const rlim_t bytes)
      : handler(std::signal(SIGXFSZ, SIG_IGN))
    {
      ::getrlimit(RLIMIT_FSIZE, &limit);
      const struct rlimit small = {bytes, limit.rlim_max};
      ::setrlimit(RLIMIT_FSIZE, &small);
    }
    ~FullDisk()
    {
      ::setrlimit(RLIMIT_FSIZE, &limit);
      std::signal(SIGXFSZ, handler);
    }

  private:
    void (*handler)(int);
    struct rlimit limit;
  };



  TEST_F(OutputTest, ReactionColumnsAndRows)
  {
    run.contacts     = {"bottom"};
    const auto table = create("tables");
    EXPECT_EQ(read_csv(run.folder / "reactions.csv").size(), 1u);
    table->write({record(1)});
    table->write({record(2)});

    const Rows rows = read_csv(run.folder / "reactions.csv");
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(test::read_file(run.folder / "reactions.csv")
                .rfind("increment,time,contact,node,x,y,z,n_x,n_y,n_z,gap,"
                       "u_n,u_t1,u_t2,du_t1,du_t2,r_n,r_t1,r_t2,state,"
                       "pressure,traction_t1,traction_t2,area,foot_x,foot_y,"
                       "foot_z,acts_x,acts_y,acts_z\n",
                       0),
              0u);
    for (const auto &row : rows)
      EXPECT_EQ(row.size(), 30u);
    EXPECT_EQ(cell(rows, 3, "increment"), "2");
    EXPECT_EQ(cell(rows, 3, "time"), "1");
    EXPECT_EQ(cell(rows, 3, "contact"), "bottom");
    EXPECT_EQ(cell(rows, 4, "x"), "1.1");
    EXPECT_EQ(cell(rows, 4, "r_n"), "10");
    EXPECT_EQ(cell(rows, 4, "r_t1"), "-0.333333333333333");
    EXPECT_EQ(cell(rows, 4, "r_t2"), "0"); // in 2D, whatever it holds
    EXPECT_EQ(cell(rows, 4, "state"), "slip");
    EXPECT_EQ(cell(rows, 4, "pressure"), "20");
    EXPECT_EQ(cell(rows, 4, "traction_t1"), "-0.666666666666667");
    EXPECT_EQ(cell(rows, 4, "traction_t2"), "0");
    EXPECT_EQ(cell(rows, 4, "area"), "0.5");
    EXPECT_EQ(cell(rows, 4, "foot_y"), "-0.25");
    EXPECT_EQ(files(),
              (std::set<std::string>{"increments.csv", "reactions.csv"}));
  }

  TEST_F(OutputTest, ThreeDimensionsHaveASecondTangent)
  {
    run.dim          = 3;
    const auto table = create("tables");
    table->write({record(1)});
    const Rows rows = read_csv(run.folder / "reactions.csv");
    EXPECT_EQ(cell(rows, 1, "r_t2"), "7");
  }

  TEST_F(OutputTest, SmallForcesAreWrittenZeroSmallDisplacementsNot)
  {
    const auto             table = create("tables");
    model::IncrementRecord r     = record(1);
    r.rows[1].reaction[0]        = 1e-14;
    r.rows[1].reaction[1]        = -1e-20;
    r.rows[1].u[0]               = 1e-18;
    table->write({r});
    const Rows rows = read_csv(run.folder / "reactions.csv");
    EXPECT_EQ(cell(rows, 2, "r_n"), "0");
    EXPECT_EQ(cell(rows, 2, "r_t1"), "0");
    EXPECT_EQ(cell(rows, 2, "u_n"), "1e-18");
  }

  TEST_F(OutputTest, SmallIsWhatIsSmallInItsIncrement)
  {
    const auto             table = create("tables");
    model::IncrementRecord small = record(2);
    for (model::ContactRow &row : small.rows)
      row.reaction *= 1e-16;
    small.contacts[0].force *= 1e-16;
    small.loads.force = Tensor<1, 3>();
    table->write({record(1), small});
    const Rows rows = read_csv(run.folder / "reactions.csv");
    EXPECT_EQ(cell(rows, 4, "r_n"), "1e-15");
    EXPECT_EQ(cell(read_csv(run.folder / "increments.csv"), 2, "left_side_f_y"),
              "3e-15");
  }

  TEST_F(OutputTest, NoAreaNoPressure)
  {
    const auto             table = create("tables");
    model::IncrementRecord r     = record(1);
    r.rows[0].area               = 0;
    table->write({r});
    const Rows rows = read_csv(run.folder / "reactions.csv");
    EXPECT_EQ(cell(rows, 1, "pressure"), "0");
    EXPECT_EQ(cell(rows, 1, "traction_t1"), "0");
  }

  TEST_F(OutputTest, NonFiniteNumbersAreRefused)
  {
    for (const char *name : {"reactions", "increments"})
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()})
        {
          const auto table = create("tables");
          table->write({record(1)});
          const fs::path file      = run.folder / (std::string(name) + ".csv");
          const auto     before    = test::read_file(file);
          model::IncrementRecord r = record(2);
          r.rows[0].u[1]           = bad;
          r.balance                = bad;
          EXPECT_THROW(table->write({r}), AnalysisError);
          EXPECT_EQ(test::read_file(file), before);
        }
  }

  TEST_F(OutputTest, IncrementsThatFinishTogetherAreWrittenOnce)
  {
    const auto bytes_on_disk = [this] {
      return fs::file_size(run.folder / "reactions.csv") +
             fs::file_size(run.folder / "increments.csv");
    };
    const auto table = create("tables");
    table->write({record(1), record(2), record(3)});
    EXPECT_EQ(table->work().table_bytes, bytes_on_disk());

    model::IncrementRecord bad = record(5);
    bad.balance                = std::numeric_limits<double>::infinity();
    EXPECT_THROW(table->write({record(4), bad}), AnalysisError);
    for (const char *name : {"reactions.csv", "increments.csv"})
      {
        const Rows rows = read_csv(run.folder / name);
        EXPECT_EQ(cell(rows, rows.size() - 1, "increment"), "4");
      }
  }

  TEST_F(OutputTest, IncrementColumns)
  {
    const auto table = create("tables");
    table->write({record(1)});
    const Rows rows = read_csv(run.folder / "increments.csv");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].size(), 12u + 3 * 6 + 1 + 5);
    EXPECT_EQ(rows[1].size(), rows[0].size());
    EXPECT_EQ(rows[0][12], "left_side_f_x");
    EXPECT_EQ(rows[0][12 + 3 * 6], "balance");
    EXPECT_EQ(rows[0].back(), "determinate");
    EXPECT_EQ(cell(rows, 1, "solver"), "smoothing");
    EXPECT_EQ(cell(rows, 1, "residual"), "1e-12");
    EXPECT_EQ(cell(rows, 1, "open"), "0");
    EXPECT_EQ(cell(rows, 1, "stick"), "1");
    EXPECT_EQ(cell(rows, 1, "slip"), "1");
    EXPECT_EQ(cell(rows, 1, "left_side_f_y"), "30");
    EXPECT_EQ(cell(rows, 1, "loads_f_x"), "0"); // noise
    EXPECT_EQ(cell(rows, 1, "supports_m_z"), "0");
    EXPECT_EQ(cell(rows, 1, "determinate"), "yes");
  }

  TEST_F(OutputTest, EachSupportAndLoadHasColumns)
  {
    run.supports     = {"top", "left side"};
    run.loads        = {"top"};
    const auto table = create("tables");
    // one that is known, and one that is not
    model::IncrementRecord r = record(1);
    r.each_support.resize(1);
    r.each_support[0].force[1]  = -7;
    r.each_support[0].moment[2] = 3;
    r.each_load.resize(1);
    r.each_load[0].force[0] = 5;
    r.strain_energy         = .5;
    r.external_work         = 1.5;
    r.dissipation           = .75;
    r.contact_work_normal   = .25;
    r.determinate           = false;
    table->write({r});
    const Rows rows = read_csv(run.folder / "increments.csv");
    EXPECT_EQ(rows[1].size(), rows[0].size());
    EXPECT_EQ(std::set<std::string>(rows[0].begin(), rows[0].end()).size(),
              rows[0].size());
    EXPECT_EQ(cell(rows, 1, "support_top_f_y"), "-7");
    EXPECT_EQ(cell(rows, 1, "support_top_m_z"), "3");
    EXPECT_EQ(cell(rows, 1, "support_left_side_f_y"), "0");
    EXPECT_EQ(cell(rows, 1, "load_top_f_x"), "5");
    EXPECT_EQ(cell(rows, 1, "strain_energy"), "0.5");
    EXPECT_EQ(cell(rows, 1, "external_work"), "1.5");
    EXPECT_EQ(cell(rows, 1, "dissipation"), "0.75");
    EXPECT_EQ(cell(rows, 1, "contact_work_normal"), "0.25");
    EXPECT_EQ(cell(rows, 1, "determinate"), "no");
  }

  TEST_F(OutputTest, NamesThatReadAlikeHaveTheirOwnColumns)
  {
    run.contacts                 = {"left side", "left_side", "loads"};
    const auto             table = create("tables");
    model::IncrementRecord r     = record(1);
    r.contacts[1].force[1]       = 4;
    table->write({r});
    const Rows rows = read_csv(run.folder / "increments.csv");
    EXPECT_EQ(std::set<std::string>(rows[0].begin(), rows[0].end()).size(),
              rows[0].size());
    EXPECT_EQ(cell(rows, 1, "left_side_f_y"), "30");
    EXPECT_EQ(cell(rows, 1, "left_side_2_f_y"), "4");
  }



  TEST_F(OutputTest, AFullDiskLeavesTheLastTable)
  {
    const auto table = create("tables");
    table->write({record(1)});
    const std::string before = test::read_file(run.folder / "reactions.csv");
    {
      const FullDisk full(before.size());
      EXPECT_THROW(table->write({record(2)}), WriteError);
    }
    EXPECT_EQ(test::read_file(run.folder / "reactions.csv"), before);
    EXPECT_EQ(files(),
              (std::set<std::string>{"increments.csv", "reactions.csv"}));
  }

  TEST_F(OutputTest, AMissingFolderIsAWriteError)
  {
    run.folder /= "missing";
    EXPECT_THROW(create("tables"), WriteError);
    run.folder = run.folder.parent_path();
  }



  TEST_F(OutputTest, PicturesOfEveryNthIncrement)
  {
    run.vtu_every       = 2;
    const auto graphics = create("graphics");
    for (unsigned int i = 1; i <= 5; ++i)
      graphics->write({record(i)});
    EXPECT_EQ(files(),
              (std::set<std::string>{"contact-0002.vtu",
                                     "contact-0004.vtu",
                                     "contact.pvd",
                                     "scene.pvd",
                                     "solution-my_block-0002.vtu",
                                     "solution-my_block-0004.vtu",
                                     "solution.pvd"}));
    EXPECT_EQ(graphics->work().drawings, 2u);
    EXPECT_EQ(test::read_file(run.folder / "solution-my_block-0002.vtu"),
              drawn(.25, .25, 1., 2));
    const std::string pvd = test::read_file(run.folder / "solution.pvd");
    EXPECT_NE(pvd.find("timestep=\"1\" group=\"\" part=\"0\" name=\"my_block\" "
                       "file=\"solution-my_block-0002.vtu\""),
              std::string::npos);
    EXPECT_NE(
      test::read_file(run.folder / "contact.pvd").find("contact-0004.vtu"),
      std::string::npos);
  }

  TEST_F(OutputTest, StressesAreThoseOfTheDeformation)
  {
    const auto             graphics = create("graphics");
    model::IncrementRecord r        = record(1);
    r.deformations                  = {Eigen::VectorXd::Constant(4, 1e-3)};
    graphics->write({r});
    EXPECT_EQ(test::read_file(run.folder / "solution-my_block-0001.vtu"),
              drawn(.25, 1e-3, .5, 1));
  }

  TEST_F(OutputTest, NoPicturesAndNoOldOnes)
  {
    const std::set<std::string> foreign = {"solution-2026.vtu",
                                           "contact-0001.vtu.bak",
                                           "my-contact-0001.vtu",
                                           "notes.txt"};
    for (const std::string &name : foreign)
      std::ofstream(run.folder / name) << "of somebody else";
    for (const char *name : {"solution.pvd",
                             "contact.pvd",
                             "surface.pvd",
                             "scene.pvd",
                             "mechanism.pvd",
                             "surface-my_block-0012.vtu",
                             "solution-my_block-0012.vtu",
                             "solution-an-other.body-10000.vtu",
                             "contact-0012.vtu",
                             "mechanism.vtu",
                             "mechanism-my_block.vtu"})
      std::ofstream(run.folder / name) << "of an older run";
    run.vtu_every       = 0;
    const auto graphics = create("graphics");
    graphics->write({record(1)});
    EXPECT_EQ(files(), foreign);
  }

  TEST_F(OutputTest, AFailedPictureIsNotListed)
  {
    const auto graphics = create("graphics");
    graphics->write({record(1)});
    body.fails = true;
    EXPECT_THROW(graphics->write({record(2)}), WriteError);
    EXPECT_EQ(test::read_file(run.folder / "solution.pvd").find("0002"),
              std::string::npos);
    EXPECT_EQ(files(),
              (std::set<std::string>{"contact-0001.vtu",
                                     "contact.pvd",
                                     "scene.pvd",
                                     "solution-my_block-0001.vtu",
                                     "solution.pvd"}));
  }

  TEST_F(OutputTest, ContactVtuHoldsItsArrays)
  {
    const auto graphics = create("graphics");
    graphics->write({record(1)});
    const std::string vtu = test::read_file(run.folder / "contact-0001.vtu");
    for (const char *name : {"reaction",
                             "traction",
                             "slip",
                             "u",
                             "normal",
                             "gap",
                             "state",
                             "contact",
                             "displacement",
                             "pressure",
                             "body"})
      EXPECT_NE(vtu.find("Name=\"" + std::string(name) + '"'),
                std::string::npos);
    EXPECT_NE(vtu.find("</VTKFile>"), std::string::npos);
    EXPECT_NE(vtu.find("NumberOfPoints=\"2\""), std::string::npos);
  }



  TEST_F(OutputTest, TheUndeformedBodiesAreIncrementZero)
  {
    const auto             graphics   = create("graphics");
    model::IncrementRecord undeformed = record(1);
    undeformed.increment              = 0;
    undeformed.time                   = 0;
    graphics->begin(undeformed);
    EXPECT_EQ(graphics->work().drawings, 0u);
    const std::string pvd = test::read_file(run.folder / "scene.pvd");
    EXPECT_NE(pvd.find("timestep=\"0\" group=\"\" part=\"0\" name=\"body "
                       "my_block\" file=\"solution-my_block-0000.vtu\""),
              std::string::npos)
      << pvd;
    // what lies on bodies would flicker
    EXPECT_EQ(pvd.find("contact"), std::string::npos) << pvd;
    EXPECT_NE(
      test::read_file(run.folder / "contact.pvd").find("contact-0000.vtu"),
      std::string::npos);
  }

  TEST_F(OutputTest, SurfacesCarryTheirContact)
  {
    body.has_surface         = true;
    model::IncrementRecord r = record(1);
    r.rows[0].gap            = .125;
    r.rows.resize(1);
    r.rows.push_back(r.rows[0]); // in a second contact, less pressed
    r.rows[1].reaction = Tensor<1, 3>({4., 0., 0.});
    r.rows[1].state    = NodeState::slip;
    r.rows[1].gap      = 0;

    const Skin    skin = make_skin(body);
    const VtuGrid grid = draw_skin(skin, run, r, 0);
    EXPECT_EQ(skin.nodes, (std::vector<unsigned int>{1, 0}));
    EXPECT_EQ(grid.n_cells(), 1u);
    const auto field = [&](const std::string &name) {
      for (const VtuField &f : grid.point_fields)
        if (f.name == name)
          return f.values;
      return std::vector<double>();
    };
    EXPECT_EQ(field("contact_pressure"), (std::vector<double>{0, 40}));
    EXPECT_EQ(field("state"), (std::vector<double>{-1, 1}));
    EXPECT_TRUE(std::isnan(field("gap")[0]));
    EXPECT_EQ(field("gap")[1], 0.);
    EXPECT_EQ(field("displacement"),
              (std::vector<double>{.25, .25, 0, .25, .25, 0}));
    EXPECT_NEAR(field("contact_traction")[4], 48., 1e-12);

    create("graphics")->write({r});
    EXPECT_EQ(files().count("surface-my_block-0001.vtu"), 1u);
    EXPECT_EQ(files().count("surface.pvd"), 1u);
  }



  TEST_F(OutputTest, SolidsCarryTheirContact)
  {
    run.wearing              = {0};
    model::IncrementRecord r = record(1);
    r.rows.resize(1);
    r.rows[0].wear = .5;
    VtuGrid grid;
    grid.points.resize(4); // a node for each of two materials, and no node
    grid.nodes_of_points = {1 - r.rows[0].node,
                            r.rows[0].node,
                            r.rows[0].node,
                            VtuGrid::no_node};
    add_contact(Skin(), run, r, 0, grid);
    ASSERT_EQ(grid.point_ids.size(), 1u);
    const int state = static_cast<int>(r.rows[0].state);
    EXPECT_EQ(grid.point_ids[0].name, "state");
    EXPECT_EQ(grid.point_ids[0].values,
              (std::vector<int>{-1, state, state, -1}));
    std::vector<std::string> names;
    for (const VtuField &field : grid.point_fields)
      {
        names.push_back(field.name);
        const std::size_t n = field.n_components;
        ASSERT_EQ(field.values.size(), 4 * n);
        for (const std::size_t i : {std::size_t{0}, 4 * n - 1})
          EXPECT_TRUE(std::isnan(field.values[i])) << field.name;
        EXPECT_FALSE(std::isnan(field.values[n])) << field.name;
        EXPECT_EQ(field.values[n], field.values[2 * n]) << field.name;
      }
    EXPECT_EQ(
      names,
      (std::vector<std::string>{
        "contact_pressure", "contact_traction", "gap", "slip", "wear"}));
    EXPECT_EQ(grid.point_fields.back().values[1], .5);

    run.contacts = {};
    VtuGrid alone;
    add_contact(Skin(), run, r, 0, alone);
    EXPECT_TRUE(alone.point_fields.empty() && alone.point_ids.empty());
  }

  TEST_F(OutputTest, PicturesNameTheUnitsOfTheScene)
  {
    run.units = {"kN, m", "Output, Units"};
    create("graphics")->write({record(1)});
    const auto unit = [&](const std::string &file, const std::string &field) {
      const std::string vtu = test::read_file(run.folder / file);
      const auto        at  = vtu.find("Name=\"" + field + '"');
      const std::string array =
        vtu.substr(at, vtu.find("</DataArray>", at) - at);
      const auto begin = array.find("\"UNITS_LABEL\"");
      return begin == std::string::npos ?
               "none" :
               array.substr(array.find('>', begin) + 1,
                            array.rfind('<') - array.find('>', begin) - 1);
    };
    EXPECT_EQ(unit("contact-0001.vtu", "reaction"), "kN");
    EXPECT_EQ(unit("contact-0001.vtu", "pressure"), "kPa");
    EXPECT_EQ(unit("contact-0001.vtu", "Points"), "m");
    EXPECT_EQ(unit("contact-0001.vtu", "state"), "none");
    EXPECT_EQ(unit("solution-my_block-0001.vtu", "displacement"), "m");
    EXPECT_EQ(unit("solution-my_block-0001.vtu", "slip"), "m");
    const auto refusal = [](const std::string &text) {
      return test::sentence_of([&] { Units(text, "Output, Units"); });
    };
    for (const char *wrong : {"mm", "N, mm, s, K, A", "N,, mm", "N, <mm>"})
      EXPECT_TRUE(test::starts(refusal(wrong), "Output, Units: '")) << wrong;
    for (const char *right : {"", "N, mm", "lbf, in, s", "N, mm, s, K"})
      EXPECT_EQ(refusal(right), "accepted") << right;
  }



  TEST_F(OutputTest, HistoryColumns)
  {
    run.probes                     = {"tip"};
    const auto             table   = create("history");
    model::IncrementRecord r       = record(2);
    r.largest_displacement         = {3., 0, Point<3>(1, 2, 0)};
    r.probes                       = {Tensor<1, 3>({.5, -.5, 0.})};
    model::IncrementRecord nothing = record(3);
    nothing.rows                   = {};
    table->write({r, nothing});
    const Rows rows = read_csv(run.folder / "history.csv");
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[1].size(), rows[0].size());
    EXPECT_EQ(cell(rows, 1, "increment"), "2");
    EXPECT_EQ(cell(rows, 1, "time"), "1");
    EXPECT_EQ(cell(rows, 1, "largest_displacement"), "3");
    EXPECT_EQ(cell(rows, 1, "largest_displacement_body"), "my block");
    EXPECT_EQ(cell(rows, 1, "largest_displacement_y"), "2");
    EXPECT_EQ(cell(rows, 1, "largest_pressure"), "40");
    EXPECT_EQ(cell(rows, 1, "largest_pressure_contact"), "left side");
    EXPECT_EQ(cell(rows, 1, "largest_pressure_x"), "0.1");
    EXPECT_EQ(cell(rows, 1, "tip_u_y"), "-0.5");
    EXPECT_EQ(cell(rows, 2, "largest_pressure"), "0");
    EXPECT_EQ(cell(rows, 2, "largest_pressure_contact"), "");
    EXPECT_EQ(table->work().table_bytes,
              fs::file_size(run.folder / "history.csv"));
  }

  TEST_F(OutputTest, OfNodesThatMoveAlikeTheFirstIsTheLargest)
  {
    const auto at = [&](const double second) {
      return largest_displacement({&body},
                                  1,
                                  [second](const unsigned int,
                                           const unsigned int i) {
                                    return i == 0 ? 1. : second;
                                  })
        .position[0];
    };
    EXPECT_EQ(at(1 + 1e-12), 0.);
    EXPECT_EQ(at(1 + 1e-6), 1.);
  }

  TEST_F(OutputTest, AClosingScreen)
  {
    run.probes                           = {"tip"};
    run.supports                         = {"top"};
    run.loads                            = {"weight"};
    model::IncrementRecord r             = record(3);
    r.largest_displacement               = {3., 0, Point<3>(1, 2, 0)};
    r.probes                             = {Tensor<1, 3>({.5, -.5, 0.})};
    const std::vector<std::string> lines = closing_lines(run, r);
    EXPECT_EQ(
      lines,
      (std::vector<std::string>{
        "increment 3 of 3, t = 1.5: 0 contact nodes open, 1 stick, 1 slip",
        "contact left side: force (0, 30, 0)",
        "supports: force (0, 0, 0), loads: force (0, -30, 0)",
        "largest displacement: 3, body my block at (1, 2, 0)",
        "largest pressure: 40, contact left side at (0.1, 0, 0)",
        "probe tip: displacement (0.5, -0.5, 0)"}));
    run.has_moments = true;
    r.loads.moment  = Tensor<1, 3>({0., 0., 7.});
    EXPECT_NE(closing_lines(run, r)[2].find(
                "loads: force (0, -30, 0), moment about the origin (0, 0, 7)"),
              std::string::npos);
    run.contacts.assign(9, "c");
    r.contacts.resize(9);
    EXPECT_EQ(closing_lines(run, r)[5], "  and 5 more: increments.csv");
  }

  TEST_F(OutputTest, TablesGoOnWhereARunEnded)
  {
    create("tables")->write({record(1), record(2), record(3)});
    run.former   = run.folder;
    run.n_former = 2;
    run.loads    = {"new"};
    for (const char *table : {"increments.csv", "reactions.csv"})
      append_to_file(run.folder / table, "2"); // of 23, torn by a kill
    create("tables")->write({record(3), record(4)});
    const Rows rows = read_csv(run.folder / "increments.csv");
    ASSERT_EQ(rows.size(), 5u);
    for (std::size_t k = 1; k < rows.size(); ++k)
      {
        EXPECT_EQ(cell(rows, k, "increment"), std::to_string(k));
        EXPECT_EQ(rows[k].size(), rows[0].size());
        EXPECT_EQ(cell(rows, k, "left_side_f_y"), "30");
        EXPECT_EQ(cell(rows, k, "load_new_f_x"), "0");
      }
    EXPECT_EQ(read_csv(run.folder / "reactions.csv").size(), 9u);
    run.n_former = 5;
    EXPECT_EQ(test::sentence_of([&] {
                create("tables");
              }).find("does not hold the increments 1 to 5") ==
                std::string::npos,
              false);
  }

  TEST_F(OutputTest, PicturesGoOnWhereARunEnded)
  {
    {
      const auto graphics = create("graphics");
      for (unsigned int i = 1; i <= 4; ++i)
        graphics->write({record(i)});
    }
    run.former          = run.folder;
    run.n_former        = 2;
    const auto graphics = create("graphics");
    EXPECT_EQ(files().count("contact-0002.vtu"), 1u);
    EXPECT_EQ(files().count("contact-0003.vtu"), 0u);
    EXPECT_EQ(test::read_file(run.folder / "scene.pvd").find("0003"),
              std::string::npos);
    graphics->write({record(3)});
    const std::string pvd = test::read_file(run.folder / "contact.pvd");
    for (const char *name : {"0001.vtu", "0002.vtu", "0003.vtu"})
      EXPECT_NE(pvd.find(name), std::string::npos) << pvd;
  }



  TEST_F(OutputTest, ProgressLine)
  {
    const std::string line = progress_line(record(1), 4, 4, 30);
    EXPECT_NE(line.find("[#####               ] 1/4"), std::string::npos);
    EXPECT_NE(line.find("open 0, stick 1, slip 1"), std::string::npos);
    EXPECT_NE(line.find("90 s left"), std::string::npos);
  }

  TEST_F(OutputTest, ProgressCountsAPairOnce)
  {
    model::IncrementRecord r = record(1);
    r.rows.push_back(r.rows[1]);
    r.rows.back().master = true;
    EXPECT_NE(progress_line(r, 4, 4, 30).find("open 0, stick 1, slip 1"),
              std::string::npos);
  }

  TEST_F(OutputTest, ProgressLineWithoutANumberOfIncrements)
  {
    const std::string line = progress_line(record(1), 0, 2 * record(1).time, 9);
    EXPECT_NE(line.find("[##########          ] 1  t = "), std::string::npos);
    EXPECT_NE(line.find("9 s left"), std::string::npos);
  }

  TEST_F(OutputTest, NoProgressIntoAFile)
  {
    testing::internal::CaptureStdout(); // standard output is a file now
    Progress progress(run, false);
    progress.write({record(1)});
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  }
} // namespace
