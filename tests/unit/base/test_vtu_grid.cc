// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/vtu_grid.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>

using namespace conetact;

namespace
{
  /** Values of an array, as VTK's reader decodes them. */
  template <typename T>
  std::vector<T>
  values(const std::string &text, const std::string &name)
  {
    const std::string offset = "offset=\"";
    const auto        at =
      text.find(offset, text.find("Name=\"" + name + "\"")) + offset.size();
    const char *const head =
      text.data() + text.find("raw\">\n_") + 7 + std::stoul(text.substr(at));
    const auto word = [&](const std::size_t i) {
      std::uint32_t n = 0;
      std::memcpy(&n, head + 4 * i, 4);
      return n;
    };
    const auto        n_blocks = word(0);
    const auto *const data =
      reinterpret_cast<const unsigned char *>(head + 4 * (3 + n_blocks));
    std::vector<unsigned char> bytes;
    std::size_t                start = 0;
    for (std::uint32_t b = 0; b < n_blocks; ++b)
      {
        uLongf                     size = word(1);
        std::vector<unsigned char> block(size);
        EXPECT_EQ(uncompress(block.data(), &size, data + start, word(3 + b)),
                  Z_OK);
        start += word(3 + b);
        bytes.insert(bytes.end(),
                     block.begin(),
                     block.begin() + static_cast<std::ptrdiff_t>(size));
      }
    std::vector<T> result(bytes.size() / sizeof(T));
    if (!bytes.empty())
      std::memcpy(result.data(), bytes.data(), bytes.size());
    return result;
  }
} // namespace



TEST(VtuGrid, ArraysKeepAllDigits)
{
  VtuGrid grid;
  grid.points       = {Point<3>(1. / 3, 0, 0), Point<3>(1, 0, 0)};
  grid.point_fields = {{"u", 1, {1e-300, 2. / 3}}};
  grid.add_cell(VtuGrid::Shape::line, {1, 0});
  grid.cell_fields       = {{"size", 1, {.1}}};
  grid.cell_ids          = {{"body", {4}}};
  const std::string text = grid.text(.1, 7);
  EXPECT_EQ(values<double>(text, "Points"),
            (std::vector<double>{1. / 3, 0, 0, 1, 0, 0}));
  EXPECT_EQ(values<double>(text, "u"), (std::vector<double>{1e-300, 2. / 3}));
  EXPECT_EQ(values<double>(text, "size"), std::vector<double>{.1});
  EXPECT_EQ(values<int>(text, "body"), std::vector<int>{4});
  EXPECT_EQ(values<int>(text, "connectivity"), (std::vector<int>{1, 0}));
  EXPECT_EQ(values<double>(text, "TIME"), std::vector<double>{.1});
  EXPECT_EQ(values<int>(text, "CYCLE"), std::vector<int>{7});
}

TEST(VtuGrid, LargeArraysAreCutIntoBlocks)
{
  VtuGrid             grid;
  std::vector<double> many(300001);
  for (std::size_t i = 0; i < many.size(); ++i)
    many[i] = 1. / (1. + static_cast<double>(i));
  grid.point_fields = {{"u", 1, many}};
  EXPECT_EQ(values<double>(grid.text(0, 0), "u"), many);
}

TEST(VtuGrid, CellsGoRound)
{
  VtuGrid grid;
  grid.add_cell(VtuGrid::Shape::quadrilateral, {0, 1, 2, 3});
  grid.add_cell(VtuGrid::Shape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  grid.add_cell(VtuGrid::Shape::tetrahedron, {0, 1, 2, 3});
  const std::string text = grid.text(0, 0);
  EXPECT_EQ(values<int>(text, "connectivity"),
            (std::vector<int>{0, 1, 3, 2, 0, 1, 3, 2, 4, 5, 7, 6, 0, 1, 2, 3}));
  EXPECT_EQ(values<int>(text, "offsets"), (std::vector<int>{4, 12, 16}));
  EXPECT_EQ(values<unsigned char>(text, "types"),
            (std::vector<unsigned char>{9, 12, 10}));
}

TEST(VtuGrid, CellsOfSecondDegreeAreWhole)
{
  VtuGrid grid;
  grid.add_cell(VtuGrid::Shape::biquadratic_quadrilateral,
                {0, 1, 2, 3, 4, 5, 6, 7, 8});
  grid.add_cell(VtuGrid::Shape::quadratic_tetrahedron,
                {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  const std::string text = grid.text(0, 0);
  EXPECT_EQ(values<int>(text, "connectivity"),
            (std::vector<int>{
              0, 1, 3, 2, 6, 5, 7, 4, 8, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(values<unsigned char>(text, "types"),
            (std::vector<unsigned char>{28, 24}));
}

TEST(VtuGrid, ComponentsMayHaveNames)
{
  VtuGrid grid;
  grid.point_fields = {{"s", 2, {}, {"largest", "least"}}};
  EXPECT_NE(grid.text(0, 0).find(
              "NumberOfComponents=\"2\" ComponentName0=\"largest\" "
              "ComponentName1=\"least\""),
            std::string::npos);
}

TEST(VtuGrid, UnitsAreLabelsOfVtk)
{
  VtuGrid grid;
  grid.points         = {Point<3>()};
  grid.point_fields   = {{"gap", 1, {.5}, {}, "mm"}, {"ratio", 1, {2.}}};
  grid.point_ids      = {{"state", {-1}}};
  grid.units          = "N, mm";
  grid.unit_of_points = "mm";
  grid.add_cell(VtuGrid::Shape::vertex, {0});
  const std::string label =
    "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">mm"
    "</InformationKey>";
  const auto count = [&](const std::string &text) {
    std::size_t n = 0;
    for (auto at = text.find(label); at != text.npos;
         at      = text.find(label, at + 1))
      ++n;
    return n;
  };
  const std::string text = grid.text(0, 0);
  EXPECT_EQ(count(text), 2u); // points and gap
  EXPECT_EQ(values<char>(text, "units"),
            (std::vector<char>{'N', ',', ' ', 'm', 'm', '\0'}));
  EXPECT_EQ(values<int>(text, "state"), std::vector<int>{-1});
  EXPECT_EQ(count(grid.text_of_parts({"a.vtu"})), 2u);
  EXPECT_EQ(grid.part({0}).text(0, 0), text);
}
