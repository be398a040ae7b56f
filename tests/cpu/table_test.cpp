// SPDX-License-Identifier: MIT
#include "base/table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using izb::Align;
using izb::Table;

TEST(Table, LinesUpColumns) {
  Table table({{"stage", Align::left}, {"ms"}, {"note", Align::left}});
  table.add_row({"gbuffer", "12.25", "a"});
  table.add_row({"zcull", "3", ""});
  EXPECT_EQ(table.str(),
            "stage       ms  note\n"
            "gbuffer  12.25  a\n"
            "zcull        3\n");
}

TEST(Table, CountsCharactersNotBytes) {
  Table table({{"µs"}, {"x"}});
  table.add_row({"125", "1"});
  EXPECT_EQ(table.str(), " µs  x\n125  1\n");
}

TEST(Table, FillsShortRowsAndRefusesLongOnes) {
  Table table({{"a"}, {"b"}});
  table.add_row({"1"});
  EXPECT_EQ(table.str(), "a  b\n1\n");
  EXPECT_THROW(table.add_row({"1", "2", "3"}), std::logic_error);
}

}  // namespace
