#include "antigrasp/core/csv_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;
using Rows = std::vector<std::vector<std::string>>;

Rows Read(std::string_view bytes) {
  const TempFolder folder;
  CsvReader reader(folder.Write("t.csv", bytes));
  Rows rows{reader.names()};
  while (reader.Next()) {
    rows.emplace_back();
    for (std::size_t i = 0; i < reader.names().size(); ++i) rows.back().push_back(reader.Field(i));
  }
  return rows;
}

// The message after the folder's name.
std::string Refusal(std::string_view bytes) {
  try {
    Read(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void ExpectRefused(std::string_view bytes, const std::string& part) {
  const std::string message = Refusal(bytes);
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(CsvReader, ReadsTheSameTableWhateverTheLineEndsMarkAndEmptyLines) {
  const Rows expected{{"id", "x"}, {"a", "1"}, {"", "2"}};
  EXPECT_EQ(Read("id,x\na,1\n,2\n"), expected);
  EXPECT_EQ(Read("id,x\na,1\n,2"), expected);
  EXPECT_EQ(Read("id,x\r\na,1\r\n,2\r\n"), expected);
  EXPECT_EQ(Read("\xEF\xBB\xBFid,x\na,1\n,2\n"), expected);
  EXPECT_EQ(Read("\n\nid, x\n\na,1\n\r\n,2\n\n"), expected);
  EXPECT_EQ(Read("\"id\",\"x\"\n\"a\",\"1\"\n\"\",2\n"), expected);
}

TEST(CsvReader, QuotedFieldsKeepCommasQuotesAndLineBreaks) {
  EXPECT_EQ(Read("id,x\n\"a,b\",\"say \"\"hi\"\"\"\n\"two\nlines\",3\n"),
            (Rows{{"id", "x"}, {"a,b", "say \"hi\""}, {"two\nlines", "3"}}));
  for (const std::string field : {"plain", "a,b", "\"", "a\"b\"", "\r\n", ""}) {
    EXPECT_EQ(Read("id,x\n" + CsvField(field) + ",1\n")[1][0], field) << "what CsvField writes";
  }
}

TEST(CsvReader, ATableMayHaveNoRowsButNotNoHeader) {
  EXPECT_EQ(Read("id,x\n"), (Rows{{"id", "x"}}));
  ExpectRefused("", "empty table");
  ExpectRefused("\n\r\n\n", "empty table");
  ExpectRefused("\xEF\xBB\xBF", "empty table");
}

TEST(CsvReader, NamesTheLineOfWhatIsWrong) {
  ExpectRefused("id,x\na,1\nb\n", "t.csv:3): expected 2 fields as in the header");
  ExpectRefused("id,x\n\na,1,2\n", "a row of 3 fields");
  ExpectRefused("id,x\n\na,1,2\n", "t.csv:3)");
  ExpectRefused("id,x\nb\n", "a row of 1 field (");
  ExpectRefused("id,x\n\"two\nlines\",1\nb\n", "t.csv:4)");
  ExpectRefused("id,x,id\na,1,2\n", "column id twice");
  ExpectRefused("id,x\n\"a,1\nb,2\n", "t.csv:2): expected a closing quote");
  ExpectRefused("id,x\n\"a\"b,1\n", "behind a closing quote");
  ExpectRefused("id,x\na\"b\",1\n", "a quote inside");
  ExpectRefused(std::string_view("id,x\na,1\n\0\x01,2\n", 14), "t.csv:3)");
  ExpectRefused(
      "\x7F"
      "ELF\x02\x01",
      "not a table");
}

TEST(CsvReader, NumbersAreWholeFieldsInTheCLocale) {
  const TempFolder folder;
  CsvReader reader(
      folder.Write("t.csv", "a,b,c,d,e,f,g,h,i,j\n\t1.5 ,-2e-3,+4,nan,,1.5x,1 2,--3,+-4,+\n"));
  ASSERT_TRUE(reader.Next());
  EXPECT_EQ(reader.Number(0), 1.5);
  EXPECT_EQ(reader.Number(1), -2e-3);
  EXPECT_EQ(reader.Number(2), 4.0);
  ASSERT_TRUE(reader.Number(3).has_value());
  EXPECT_TRUE(std::isnan(*reader.Number(3)));
  for (std::size_t i = 4; i < 10; ++i) EXPECT_FALSE(reader.Number(i).has_value()) << i;
  EXPECT_EQ(reader.Column("c"), 2u);
  EXPECT_FALSE(reader.Column("C").has_value());
  EXPECT_TRUE(reader.Where().ends_with("t.csv:2"));
  EXPECT_FALSE(reader.Next());
  EXPECT_FALSE(reader.Next());
}

TEST(CsvReader, EveryDoubleThatFormatDoubleWritesReadsBackWithTheSameBits) {
  std::string bytes = "x\n";
  std::vector<double> values;
  for (int i = 0; i < 2000; ++i) {
    values.push_back(std::ldexp(std::sin(1.0 + i), (i * 7919) % 2000 - 1000));
    bytes += FormatDouble(values.back()) + "\n";
  }
  const TempFolder folder;
  CsvReader reader(folder.Write("t.csv", bytes));
  for (const double value : values) {
    ASSERT_TRUE(reader.Next());
    EXPECT_EQ(reader.Number(0), value);
  }
}

TEST(CsvReader, AMissingFileAndAFolderAreRefused) {
  const TempFolder folder;
  EXPECT_THROW(CsvReader(folder / "none.csv"), InputError);
  EXPECT_THROW(CsvReader(folder.path()), InputError);
}

TEST(CsvReader, TakesColumnsByNameAndGapsAsNoNumber) {
  const TempFolder folder;
  const auto path = folder.Write("t.csv", "id, score ,x\n\"a\nb\", 0.25\t,\nc,low,-inf\n");
  CsvReader reader(path);
  EXPECT_EQ(reader.names(), (std::vector<std::string>{"id", "score", "x"}));
  EXPECT_EQ(reader.RequiredColumn("id"), 0u);
  EXPECT_EQ(reader.RequiredColumn("score"), 1u);
  EXPECT_EQ(reader.Column("x"), 2u);
  ASSERT_TRUE(reader.Next());
  EXPECT_EQ(reader.Where(), path.string() + ":2");  // where the row begins, not where it ends
  EXPECT_EQ(reader.Field(0), "a\nb");
  EXPECT_EQ(reader.Field(1), " 0.25\t");
  EXPECT_EQ(reader.NumberOrGap(1), 0.25);
  EXPECT_TRUE(std::isnan(reader.NumberOrGap(2)));
  ASSERT_TRUE(reader.Next());
  EXPECT_EQ(reader.Where(), path.string() + ":4");
  EXPECT_EQ(reader.NumberOrGap(2), -std::numeric_limits<double>::infinity());
  const auto refusal = [](const std::function<void()>& action) -> std::string {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal([&] { reader.NumberOrGap(1); }),
            "score = \"low\" (" + path.string() + ":4): expected a number");
  EXPECT_EQ(refusal([&] { reader.RequiredColumn("y"); }),
            "no column y (" + path.string() + ":1): expected column y");
}

}  // namespace
}  // namespace antigrasp
