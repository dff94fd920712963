// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Condensed problems that a scene writes: the tool solves them to the reactions
// that stand in reactions.csv.

#include "conetact/exchange/fclib_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace conetact;
using namespace conetact::exchange;
using namespace conetact::solvers;
namespace fs = std::filesystem;

namespace
{
  class SceneExport : public ::testing::Test
  {
  protected:
    void
    SetUp() override
    {
      std::string pattern =
        (fs::temp_directory_path() / "conetact-export-XXXXXX").string();
      folder = mkdtemp(pattern.data());
    }
    void
    TearDown() override
    {
      fs::remove_all(folder);
    }
    int
    run(const std::string &command)
    {
      const fs::path output = folder / "said";
      const int      status =
        std::system((command + " > " + output.string() + " 2>&1").c_str());
      std::ifstream stream(output);
      said.assign(std::istreambuf_iterator<char>(stream), {});
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    int
    run_scene(const std::string &name, const std::string &arguments)
    {
      return run(std::string(CONETACT_PROGRAM) + " " CONETACT_SCENES "/" +
                 name + ".prm --quiet -s Output/VTU=0 -o " + result().string() +
                 " " + arguments);
    }
    fs::path
    result() const
    {
      return folder / "result";
    }
    /** (r_t1, [r_t2,] r_n) of the rows of an increment. */
    Eigen::VectorXd
    reactions(const unsigned int increment, const int dim) const
    {
      std::ifstream       stream(result() / "reactions.csv");
      std::string         line;
      std::vector<double> r;
      std::getline(stream, line); // the header
      while (std::getline(stream, line))
        {
          std::istringstream       cells(line);
          std::vector<std::string> cell;
          for (std::string c; std::getline(cells, c, ',');)
            cell.push_back(c);
          if (std::stoul(cell[0]) != increment)
            continue;
          for (int d = 1; d < dim; ++d)
            r.push_back(std::stod(cell[16 + static_cast<std::size_t>(d)]));
          r.push_back(std::stod(cell[16]));
        }
      return Eigen::Map<Eigen::VectorXd>(r.data(),
                                         static_cast<Eigen::Index>(r.size()));
    }
    void
    expect_same_reactions(const unsigned int increment, const int dim)
    {
      char name[32];
      std::snprintf(name, sizeof(name), "problem-%04u.hdf5", increment);
      const std::string file = (result() / name).string();
      const std::string copy = (folder / "solved.hdf5").string();
      ASSERT_EQ(run(CONETACT_FCLIB " solve " + file +
                    " --tolerance 1e-12 --output " + copy),
                0)
        << said;
      const Eigen::VectorXd golden  = reactions(increment, dim);
      const ContactProblem  problem = read_fclib(copy);
      for (const std::string &from : {file, copy})
        {
          const auto solution = read_fclib_solution(from, problem);
          ASSERT_TRUE(solution);
          ASSERT_EQ(solution->r.size(), golden.size());
          EXPECT_LE((solution->r - golden).cwiseAbs().maxCoeff(),
                    1e-8 * golden.cwiseAbs().maxCoeff())
            << from;
          EXPECT_LE(contact_residual(problem, *solution), 1e-10);
        }
    }

    fs::path    folder;
    std::string said;
  };

  TEST_F(SceneExport, TwoDimensions)
  {
    ASSERT_EQ(run_scene("inclined-obstacle",
                        "-s 'Output/FCLib increments=1, 12' "
                        "-s Time/Increments=12 -s Time/End=12"),
              0)
      << said;
    expect_same_reactions(1, 2);
    expect_same_reactions(12, 2);
    EXPECT_FALSE(fs::exists(result() / "problem-0002.hdf5"));
  }

  TEST_F(SceneExport, ThreeDimensions)
  {
    ASSERT_EQ(run_scene("block-press-shear",
                        "-s 'Output/FCLib increments=all' "
                        "-s Time/Increments=4 -s Time/End=4 -s "
                        "'Body block/Mesh/Arguments=6, 6, 6 : 0, 0, 0 : "
                        "1, 1, 1 : true'"),
              0)
      << said;
    for (unsigned int k = 1; k <= 4; ++k)
      expect_same_reactions(k, 3);
  }

  TEST_F(SceneExport, FilesOfAnEarlierRunGo)
  {
    fs::create_directories(result());
    std::ofstream(result() / "problem-0007.hdf5") << "old";
    ASSERT_EQ(run_scene("square-greco", ""), 0) << said;
    EXPECT_FALSE(fs::exists(result() / "problem-0007.hdf5"));
  }

  TEST_F(SceneExport, RefusesWhatTheFormatCannotHold)
  {
    const auto refuses = [&](const std::string &scene,
                             const std::string &arguments,
                             const std::string &why) {
      EXPECT_EQ(run_scene(scene, arguments), 1);
      EXPECT_NE(said.find(why), std::string::npos) << said;
      EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
      EXPECT_FALSE(fs::exists(result()));
    };
    refuses("floating-block",
            "-s 'Output/FCLib increments=1'",
            "held by contact alone");
    refuses("inclined-obstacle",
            "-s 'Output/FCLib increments=1' "
            "-s 'Contact bottom/Friction coefficient=if(x < 40, 0, 0.5)'",
            "contacts of one kind");
    refuses("inclined-obstacle",
            "-s 'Output/FCLib increments=24'",
            "count from 1 to 23");
    refuses("inclined-obstacle",
            "-s 'Output/FCLib increments=1, last'",
            "not the number of an increment");
  }
} // namespace
