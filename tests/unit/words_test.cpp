// The quick ways through a line agree with the slow one.
#include "lib/text/words.h"

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lib/text/line.h"
#include "tests/unit/common.h"

using namespace sg;
using namespace sg::test;

namespace {

std::string random_line(Random& random, const std::string& alphabet) {
  std::string line(draw(random, 0, 24), ' ');
  for (char& c : line) c = alphabet[draw(random, 0, static_cast<int>(alphabet.size()) - 1)];
  return line;
}

}  // namespace

TEST_CASE("a plain number is one that conversion accepts", "[words]") {
  Random random(1);
  for (int trial = 0; trial < 200'000; ++trial) {
    const std::string line = random_line(random, "0123456789.-+ \r\tenx");
    std::string_view quick = line;
    std::string_view slow = line;
    const auto word = text::next_word(slow);
    if (text::take_plain_number(quick)) {
      REQUIRE(text::parse<double>(word));
      REQUIRE(quick == slow);
    } else {
      REQUIRE(quick == line);
    }
  }
}

TEST_CASE("a plain id is what conversion makes of it", "[words]") {
  Random random(2);
  for (int trial = 0; trial < 200'000; ++trial) {
    const std::string line = random_line(random, "0123456789012345678901234567890123456789 -+x");
    std::string_view quick = line;
    std::string_view slow = line;
    const auto word = text::next_word(slow);
    if (const auto id = text::take_plain_id(quick)) {
      REQUIRE(text::parse<std::int64_t>(word) == id);
      REQUIRE(quick == slow);
    } else {
      REQUIRE(quick == line);
    }
  }
}

TEST_CASE("plain numbers are taken quickly, others are left to conversion", "[words]") {
  for (const std::string word : {"1", "-1.5", ".5", "5.", "-0", "000.1"}) {
    std::string_view line = word;
    CHECK(text::take_plain_number(line));
    CHECK(line.empty());
  }
  for (const std::string word :
       {"", "-", ".", "-.", "+1", "1e5", "nan", "inf", "0x1", "1.2.3", "--1"}) {
    std::string_view line = word;
    CHECK_FALSE(text::take_plain_number(line));
  }
  std::string_view largest = "999999999999999999";
  CHECK(text::take_plain_id(largest) == 999'999'999'999'999'999);
  std::string_view larger = "9223372036854775807";  // for parse
  CHECK_FALSE(text::take_plain_id(larger));
  const std::string huge(400, '9');  // not finite: conversion says so
  std::string_view line = huge;
  CHECK_FALSE(text::take_plain_number(line));
}

TEST_CASE("lines are taken one by one", "[words]") {
  const auto lines = [](std::string_view text) {
    std::vector<std::string> result;
    while (!text.empty()) result.emplace_back(text::next_line(text));
    return result;
  };
  CHECK(lines("").empty());
  CHECK(lines("a") == std::vector<std::string>{"a"});
  CHECK(lines("a\n") == std::vector<std::string>{"a"});
  CHECK(lines("\n\na b\r\nc") == std::vector<std::string>{"", "", "a b\r", "c"});
}

TEST_CASE("a number is written in the shortest text that reads back", "[words]") {
  CHECK(text::format_number(0.1) == "0.1");
  CHECK(text::format_number(-0.0) == "-0");
  CHECK(text::format_number(1e22) == "1e+22");
  CHECK(text::format_number(-2.2250738585072014e-308) == "-2.2250738585072014e-308");
  std::string out = "TAG";
  text::append_number(out, std::numeric_limits<std::int64_t>::min());
  text::append_numbers(out, std::array{0.5, -1.0});
  text::append_word(out, "end");
  CHECK(out == "TAG -9223372036854775808 0.5 -1 end");
  Random random(3);
  for (int trial = 0; trial < 100'000; ++trial) {
    const auto bits = std::uint64_t{random()} << 32 | random();
    const auto number = std::bit_cast<double>(bits);
    if (std::isfinite(number)) REQUIRE(text::parse<double>(text::format_number(number)) == number);
  }
}

TEST_CASE("a defect of a line is said in its words", "[words]") {
  const auto defect = [](std::string_view line, const auto& read) -> std::string {
    try {
      read(line);
    } catch (const text::BadLine& bad) {
      return bad.cause;
    }
    return "";
  };
  const auto id = [](std::string_view& rest) { text::read_id(rest, "a vertex id"); };
  CHECK(defect("9223372036854775807", id).empty());
  CHECK(defect("9223372036854775808", id) ==
        "'9223372036854775808' is above 2^63 - 1, too large for a vertex id");
  CHECK(defect(" \r", id) == "the line ends before a vertex id");
  CHECK(defect("-1", id) == "'-1' is not a vertex id");
  CHECK(defect("1.5", id) == "'1.5' is not a vertex id");
  const auto number = [](std::string_view& rest) { text::read_number(rest); };
  CHECK(defect("1e5", number).empty());
  CHECK(defect("", number) == "the line ends before its last number");
  CHECK(defect("1e5x", number) == "'1e5x' is not a number");
  CHECK(defect("a\x01" + std::string(50, 'b'), number) ==
        "'a?" + std::string(38, 'b') + "...' is not a number");
  CHECK(defect(" \t\r", text::expect_end).empty());
  CHECK(defect("2 3", text::expect_end) == "'2' stands where the line should end");
}

TEST_CASE("numbers are copied as they are written", "[words]") {
  std::string_view rest = " 1.50  +2e0 -.5 x";
  std::string out;
  text::copy_numbers(rest, 3, out);
  CHECK(out == " 1.50 +2e0 -.5");
  CHECK(rest == " x");
  CHECK_THROWS_AS(text::copy_numbers(rest, 1, out), text::BadLine);
}
