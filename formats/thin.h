// A large g2o text need not stay in memory for who wants no more of edges than what they join, and what some of them measure.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/g2o.h"

namespace sg::formats {

// Of most edges nothing stays of their lines but that they were there, by which lines have their numbers. Where the file
// has its VERTEX lines first, what edges measure is known of the first so many, and of every so many-th.
struct Thin {
  Index first = 50000, every = 64;
};

// parse_g2o of a text that comes in blocks, each there until the next is asked for; the last is empty.
Graph parse_g2o_thinly(const std::function<std::string_view()>& next_block, std::string file,
                       graph::Tags tags, const Complaint& complaint, const LeaveOut& leave_out = {},
                       const Thin& thin = {});

// read_graph; other formats, and what is small, are read whole. Says what was read.
struct Source {
  std::string_view format;
  std::size_t bytes = 0;
};
Graph read_graph_thinly(const std::string& path, const ReadOptions& options, Source& source);

}  // namespace sg::formats
