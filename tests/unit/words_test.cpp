// The quick ways through a line agree with the slow one.
#include "lib/text/words.h"

#include <catch2/catch.hpp>
#include <random>
#include <string>

using namespace sg;

namespace {

std::mt19937 random_bits(7);

std::string random_line(const std::string& alphabet) {
  std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
  std::string line(std::uniform_int_distribution<std::size_t>(0, 24)(random_bits), ' ');
  for (char& c : line) c = alphabet[letter(random_bits)];
  return line;
}

}  // namespace

TEST_CASE("a plain number is one that conversion accepts", "[words]") {
  for (int trial = 0; trial < 200'000; ++trial) {
    const std::string line = random_line("0123456789.-+ \r\tenx");
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
  for (int trial = 0; trial < 200'000; ++trial) {
    const std::string line = random_line("0123456789012345678901234567890123456789 -+x");
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
