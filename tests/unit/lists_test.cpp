// Lists laid flat against lists of vectors, and what does not fit.
#include "lib/graph/lists.h"

#include <catch2/catch.hpp>
#include <random>

#include "lib/graph/pattern.h"
#include "lib/text/error.h"

using namespace sg;

namespace {

using Random = std::mt19937;
using Plain = std::vector<std::vector<Index>>;

Plain plain(const graph::Lists<>& lists) {
  Plain result;
  for (Index k = 0; k < lists.size(); ++k) result.emplace_back(lists[k].begin(), lists[k].end());
  return result;
}

}  // namespace

TEST_CASE("lists are built one after the other", "[lists]") {
  graph::Lists<> lists;
  CHECK(lists.size() == 0);
  CHECK(lists.open().empty());
  lists.items.push_back(7);
  lists.items.push_back(5);
  CHECK(std::vector<Index>(lists.open().begin(), lists.open().end()) == std::vector<Index>{7, 5});
  lists.close();
  lists.close();
  lists.add(std::vector<Index>{1, 2, 3});
  CHECK(plain(lists) == Plain{{7, 5}, {}, {1, 2, 3}});
  CHECK(lists.open().empty());
  lists.clear();
  CHECK(lists.size() == 0);
  lists.add(std::vector<Index>{4});
  CHECK(plain(lists) == Plain{{4}});
}

TEST_CASE("items are grouped, and lists transposed, in order", "[lists]") {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const auto count = static_cast<Index>(random() % 8);
    std::vector<Index> list_of(random() % 20);
    Plain expected(count);
    for (std::size_t i = 0; i < list_of.size(); ++i) {
      list_of[i] = static_cast<Index>(random() % (count + 1)) - 1;
      if (list_of[i] >= 0) expected[list_of[i]].push_back(static_cast<Index>(i));
    }
    CHECK(plain(graph::grouped(list_of, count)) == expected);

    graph::Lists<> lists;
    expected.assign(count, {});
    for (auto k = static_cast<Index>(random() % 6); k > 0; --k) {
      for (auto item = count == 0 ? 0 : random() % 5; item > 0; --item) {
        lists.items.push_back(static_cast<Index>(random() % count));
        expected[lists.items.back()].push_back(lists.size());
      }
      lists.close();
    }
    CHECK(plain(graph::transpose(lists, count)) == expected);
  }
}

TEST_CASE("lists that outgrow an Index are refused", "[lists]") {
  CHECK(graph::item_count(0x7fffffff) == 0x7fffffff);
  CHECK_THROWS_AS(graph::item_count(0x80000000), text::Error);

  graph::Pattern pattern{std::vector<int>(46'342, 1),
                         {}};  // n (n - 1) is the first of them above 2^31
  for (Index j = 0; j < pattern.variables(); ++j) pattern.rows.items.push_back(j);
  pattern.rows.close();
  CHECK_THROWS_AS(graph::adjacency(pattern), text::Error);
}
