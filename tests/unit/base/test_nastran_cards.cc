// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/file_mesh.h"
#include "conetact/base/nastran_cards.h"

#include <gtest/gtest.h>

using namespace conetact;

namespace
{
  const std::string hexahedron = "CHEXA,7,3,1,2,3,4,5,6,+\n"
                                 "+,7,8,9,10,11,12,13,14,+\n"
                                 "+,15,16,17,18,19,20\n";

  std::string
  refusal(const std::string &deck)
  {
    try
      {
        with_whole_cards(deck);
      }
    catch (const FileFault &fault)
      {
        return fault.why;
      }
    return "none";
  }
} // namespace

TEST(NastranCards, CardsAreWholeHoweverTheirLinesFollow)
{
  for (
    const char *card :
    {"CHEXA,7,3,1,2,3,4,5,6\n,7,8,9,10,11,12,13,14\n,15,16,17,18,19,20\n",
     "CHEXA,7,3,1,2,3,4,5,6,\n,7,8,9,10,11,12,13,14,\n,15,16,17,18,19,20\n",
     "chexa, 7, 3, 1, 2, 3, 4, 5, 6, +A\n+A, 7, 8, 9, 10, 11, 12, 13, 14, "
     "+B\n$ between\n+B, 15, 16, 17, 18, 19, 20\n",
     "CHEXA*,7,3,1,2\n*,3,4,5,6\n*,7,8,9,10\n*,11,12,13,14\n*,15,16,17,18\n"
     "*,19,20\n",
     "CHEXA,7,3,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20\r\n",
     "CHEXA          7       3       1       2       3       4       5       "
     "6\n               7       8       9      10      11      12      13   "
     "   14\n+             15      16      17      18      19      20\n",
     "CHEXA*                 7               3               1               "
     "2\n*                      3               4               5            "
     "   6\n*                      7               8               9         "
     "     10\n*                     11              12              13      "
     "        14\n*                     15              16              17   "
     "           18\n*                     19              20\n"})
    EXPECT_EQ(with_whole_cards(card), hexahedron) << card;
}

TEST(NastranCards, OthersStay)
{
  const std::string deck = "BEGIN BULK\nGRID,1,,0.,0.,0.\n$ CHEXA,1\n\n"
                           "PSOLID,1,1\nENDDATA\n";
  EXPECT_EQ(with_whole_cards(deck), deck);
  EXPECT_EQ(with_whole_cards("CQUAD4,1,1,5,6,7,8,0.5\n"),
            "CQUAD4,1,1,5,6,7,8\n");
  EXPECT_EQ(with_whole_cards("CTETRA,1,1,5,6,7,8\nCTETRA,2,1,5,6,7,9\n"),
            "CTETRA,1,1,5,6,7,8\nCTETRA,2,1,5,6,7,9\n");
}

TEST(NastranCards, CellsWithOtherNumbersOfNodesAreRefused)
{
  EXPECT_EQ(refusal("CHEXA,7,3,1,2,3,4,5,6\n,7,8,9,10,11,12,13,14\n"),
            "the CHEXA 7 has 14 nodes, and one has 8 or 20");
  EXPECT_EQ(refusal("CTRIA6,2,1,5,6,7,8,,9\n"),
            "the CTRIA6 2 has 5 nodes, and one has 6");
  EXPECT_EQ(refusal("CPENTA\n"), "the CPENTA has 0 nodes, and one has 6 or 15");
}
