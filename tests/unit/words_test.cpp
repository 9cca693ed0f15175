// The quick ways through a line agree with the slow one.
#include "lib/text/words.h"

#include <catch2/catch.hpp>
#include <string>

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
    const auto word = next_word(slow);
    if (take_plain_number(quick)) {
      REQUIRE(parse<double>(word));
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
    const auto word = next_word(slow);
    if (const auto id = take_plain_id(quick)) {
      REQUIRE(parse<std::int64_t>(word) == id);
      REQUIRE(quick == slow);
    } else {
      REQUIRE(quick == line);
    }
  }
}

TEST_CASE("plain numbers are taken quickly, others are left to conversion", "[words]") {
  for (const std::string word : {"1", "-1.5", ".5", "5.", "-0", "000.1"}) {
    std::string_view line = word;
    CHECK(take_plain_number(line));
    CHECK(line.empty());
  }
  for (const std::string word :
       {"", "-", ".", "-.", "+1", "1e5", "nan", "inf", "0x1", "1.2.3", "--1"}) {
    std::string_view line = word;
    CHECK_FALSE(take_plain_number(line));
  }
  std::string_view largest = "999999999999999999";
  CHECK(take_plain_id(largest) == 999'999'999'999'999'999);
  std::string_view larger = "9223372036854775807";  // for parse
  CHECK_FALSE(take_plain_id(larger));
  const std::string huge(400, '9');  // not finite: conversion says so
  std::string_view line = huge;
  CHECK_FALSE(take_plain_number(line));
}
