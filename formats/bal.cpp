#include "formats/bal.h"

#include <algorithm>
#include <array>

#include "formats/translate.h"
#include "lib/geometry/numbers.h"
#include "lib/text/line.h"

namespace sg::formats {
namespace {

std::string_view next_record(std::string_view& text) {
  std::string_view line;
  do line = text::next_line(text);
  while (!text.empty() && says_nothing(line));
  return line;
}

bool take_ids(std::string_view& line, int count) {
  while (count > 0 && text::take_plain_id(line)) --count;
  return count == 0;
}

// How far reading has come.
struct Reader {
  std::size_t size = 0;  // of the text
  Id cameras = 0, points = 0, observations = 0;
  bool begun = false, given_up = false;  // without counts nothing else makes sense
  Id observed = 0, placed = 0;           // observations; cameras and points
  std::vector<double> numbers;           // of the next camera or point
};

void read_header(Reader& reader, std::string_view rest) {
  reader.begun = reader.given_up = true;
  const Id cameras = text::read_id(rest, "a number of cameras");
  const Id points = text::read_id(rest, "a number of points");
  const Id observations = text::read_id(rest, "a number of observations");
  text::expect_end(rest);
  const auto size = static_cast<Id>(reader.size);  // every one of them takes a byte at least
  if (std::max({cameras, points, observations}) > size)
    throw text::BadLine{"the file is too short for what it says to hold: " +
                        std::to_string(cameras) + " cameras, " + std::to_string(points) +
                        " points, " + std::to_string(observations) + " observations"};
  reader.cameras = cameras;
  reader.points = points;
  reader.observations = observations;
  reader.given_up = false;
}

Id read_index(std::string_view& rest, std::string_view what, Id count) {
  const Id index = text::read_id(rest, "a " + std::string(what) + "'s number");
  if (index >= count)
    throw text::BadLine{std::string(what) + " " + std::to_string(index) +
                        ": there are no more than " + std::to_string(count) + ", counted from 0"};
  return index;
}

void translate_observation(const Reader& reader, std::string_view rest, std::string& out) {
  const Id camera = read_index(rest, "camera", reader.cameras);
  const Id point = read_index(rest, "point", reader.points);
  out += graph::name(graph::EdgeTag::observation_bal);
  text::append_number(out, camera);
  text::append_number(out, reader.cameras + point);
  text::copy_numbers(rest, 2, out);
  text::expect_end(rest);
  out += " 1 0 1";
}

void append_vertex(const Reader& reader, std::string& out) {
  const bool camera = reader.placed < reader.cameras;
  const double* const x = reader.numbers.data();
  out += graph::name(camera ? graph::VertexTag::bal_camera : graph::VertexTag::xyz);
  text::append_number(out, reader.placed);
  if (!camera) return text::append_numbers(out, reader.numbers);
  const SE3 to_camera{geometry::exp_so3(geometry::vector3(x)), geometry::vector3(x + 3)};
  text::append_numbers(out, geometry::numbers_of(inverse(to_camera)));
  text::append_numbers(out, std::span(reader.numbers).subspan(6));
}

// Every number of a line counts, even one that is none: the next camera starts where it should.
void translate_estimate(Reader& reader, std::string_view rest, std::string& out) {
  std::string cause;
  while (!text::at_end(rest)) {
    const std::size_t wanted = reader.placed < reader.cameras ? 9 : 3;
    if (reader.placed == reader.cameras + reader.points)
      throw text::BadLine{"the file goes on behind the last point"};
    if (!out.empty()) text::expect_end(rest);
    double number = 0;
    try {
      number = text::read_number(rest);
    } catch (const text::BadLine& bad) {
      cause = bad.cause;
    }
    reader.numbers.push_back(number);
    if (reader.numbers.size() < wanted) continue;
    append_vertex(reader, out);
    reader.numbers.clear();
    ++reader.placed;
  }
  if (!cause.empty()) throw text::BadLine{cause};
}

void translate_line(Reader& reader, std::string_view line, std::string& out) {
  if (reader.given_up) return;
  if (says_nothing(line)) {
    out += line;
  } else if (!reader.begun) {
    read_header(reader, line);
  } else if (reader.observed < reader.observations) {
    ++reader.observed;
    translate_observation(reader, line, out);
  } else {
    translate_estimate(reader, line, out);
  }
}

// "observation 3 of 12": what the end of the text cuts off; empty where nothing is.
std::string missing(const Reader& reader) {
  const auto next = [](std::string_view what, Id done, Id all) {
    return std::string(what) + " " + std::to_string(done + 1) + " of " + std::to_string(all);
  };
  if (reader.given_up) return "";
  if (!reader.begun) return "its counts of cameras, points and observations";
  if (reader.observed < reader.observations)
    return next("observation", reader.observed, reader.observations);
  if (reader.placed < reader.cameras) return next("camera", reader.placed, reader.cameras);
  if (reader.placed < reader.cameras + reader.points)
    return next("point", reader.placed - reader.cameras, reader.points);
  return "";
}

bool is_camera(const Graph& graph, Index v) {
  return graph.vertex_tag(v) == graph::VertexTag::bal_camera;
}

bool holds_vertex(const Graph& graph, Index v) {
  return is_camera(graph, v) || graph.type_of_vertex(v).space == graph::Space::xyz;
}

bool holds_edge(const Graph& graph, Index e) {
  return graph.edge_tag(e) == graph::EdgeTag::observation_bal;
}

// The vertices in the order of the format: cameras, then points.
std::vector<Index> in_order(const Graph& graph) {
  std::vector<Index> order;
  for (const bool cameras : {true, false}) {
    for (Index v = 0; v < graph.vertices(); ++v) {
      if (holds_vertex(graph, v) && is_camera(graph, v) == cameras) order.push_back(v);
    }
  }
  return order;
}

// A vertex's numbers as the format has them.
std::vector<double> estimate(const Graph& graph, Index v) {
  std::vector<double> numbers;
  auto rest = graph::line_at(graph, graph.vertex_line[v]);
  for (int k = 0; k < 2; ++k) text::next_word(rest);
  for (int k = graph::space_size(graph.type_of_vertex(v).space); k > 0; --k)
    numbers.push_back(text::read_number(rest));
  if (!is_camera(graph, v)) return numbers;
  const SE3 pose = geometry::se3(numbers.data());
  if (!(pose.q.norm() > 0)) throw text::BadLine{"the quaternion is zero"};
  const SE3 to_camera = inverse(normalized(pose));
  std::vector<double> camera;
  for (const double number : geometry::log_so3(to_camera.q)) camera.push_back(number);
  for (const double number : to_camera.t) camera.push_back(number);
  camera.insert(camera.end(), numbers.begin() + 7, numbers.end());
  return camera;
}

// "CAMERA POINT x y", both by their place in the order.
std::string observation(const Graph& graph, const std::vector<Index>& place, Index e) {
  std::string out;
  auto rest = graph::line_at(graph, graph.edge_line[e]);
  for (int k = 0; k < 3; ++k) text::next_word(rest);
  for (const Index v : graph.edge(e)) text::append_number(out, place[v]);
  text::copy_numbers(rest, 2, out);
  return out.substr(1) + "\n";
}

}  // namespace

bool looks_like_bal(std::string_view text) {
  auto header = next_record(text), first = next_record(text);
  return take_ids(header, 3) && text::at_end(header) &&
         (text::at_end(first) || (take_ids(first, 2) && !text::at_end(first)));
}

std::string bal_to_g2o(std::string_view text, const std::string& file, const Complaint& complaint) {
  Reader reader;
  reader.size = text.size();
  std::size_t lines = 0;
  std::string out = translate_lines(text, file, complaint, [&](auto line, std::string& all) {
    ++lines;
    std::string translated;
    translate_line(reader, line, translated);
    all += translated;
  });
  if (const std::string cut = missing(reader); !cut.empty())
    complaint(text::input_error(file, lines, "the file ends before " + cut));
  return out;
}

Losses bal_losses(const Graph& graph) {
  Losses losses;
  add_edge_losses(losses, graph, holds_edge);
  std::vector<double> numbers;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (!holds_edge(graph, e)) continue;
    graph::edge_numbers(graph, e, numbers);
    if (!std::ranges::equal(std::span(numbers).subspan(2, 3), std::array{1., 0., 1.}))
      add_loss(losses, graph.edge_line[e], "information other than the identity", true);
  }
  add_vertex_losses(losses, graph, holds_vertex);
  const std::vector<Index> order = in_order(graph);
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (graph.id[order[k]] != static_cast<Id>(k))
      add_loss(losses, graph.vertex_line[order[k]],
               "ids other than 0, 1, 2, ..., those of cameras before those of points", true);
  }
  for (Offset line : graph.fix_lines) add_loss(losses, line, graph::fix_tag, true);
  return losses;
}

void write_bal(const Graph& graph, const WriteOptions&, Sink& sink) {
  const std::vector<Index> order = in_order(graph);
  std::vector<Index> place(graph.vertices(),
                           -1);  // of cameras among cameras, of points among points
  Index cameras = 0, points = 0, observations = 0;
  for (const Index v : order) place[v] = is_camera(graph, v) ? cameras++ : points++;
  for (Index e = 0; e < graph.edges(); ++e) observations += holds_edge(graph, e);
  sink.write(std::to_string(cameras) + " " + std::to_string(points) + " " +
             std::to_string(observations) + "\n");
  Offset line = 0;
  try {
    for (Index e = 0; e < graph.edges(); ++e) {
      if (!holds_edge(graph, e)) continue;
      line = graph.edge_line[e];
      graph::check_ends(graph, e);
      sink.write(observation(graph, place, e));
    }
    for (const Index v : order) {
      line = graph.vertex_line[v];
      for (const double number : estimate(graph, v)) sink.write(text::format_number(number) + "\n");
    }
  } catch (const text::BadLine& bad) {
    throw graph::error_at(graph, line, bad.cause);
  }
}

}  // namespace sg::formats
