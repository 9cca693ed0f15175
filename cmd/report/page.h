// The page itself: what was found, as data that its script lays out.
#pragma once

#include <string>
#include <vector>

#include "cmd/report/costliest.h"
#include "cmd/report/variants.h"
#include "cmd/report/wish.h"

namespace sg::report {

struct Chapter {  // of one graph
  std::string title;
  Sheet facts, findings, orderings, variables, cliques, edges, variants;
  Map map;
  std::vector<Variant> measured;
  Wish wish;
  Advice advice;
  std::vector<std::string> calls;  // before all others: what makes the reference
  std::vector<std::string> notes;
};

// HTML. `call`: the command's own, as typed.
std::string page(const std::string& call, std::vector<Chapter> chapters);

}  // namespace sg::report
