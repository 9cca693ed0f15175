#include "formats/toro.h"

#include <array>

#include "formats/euler.h"
#include "formats/line.h"

namespace sg {
namespace {

void append_ids(std::string& out, std::string_view& rest, int count) {
  for (int k = 0; k < count; ++k) append_word(out, std::to_string(read_id(rest, "a vertex id")));
}

void translate_vertex2(std::string_view rest, std::string& out) {
  out += "VERTEX_SE2";
  append_ids(out, rest, 1);
  for (int k = 0; k < 3; ++k) append_word(out, read_number_text(rest));
  expect_end(rest);
}

void translate_edge2(std::string_view rest, std::string& out) {
  out += "EDGE_SE2";
  append_ids(out, rest, 2);
  for (int k = 0; k < 3; ++k) append_word(out, read_number_text(rest));
  std::array<std::string_view, 6> w;  // 11 12 22 33 13 23
  for (auto& word : w) word = read_number_text(rest);
  expect_end(rest);
  for (const int k : {0, 1, 4, 2, 5, 3}) append_word(out, w[k]);
}

void translate_vertex3(std::string_view rest, std::string& out) {
  out += "VERTEX_SE3:QUAT";
  append_ids(out, rest, 1);
  translate_euler_pose(rest, out);
  expect_end(rest);
}

void translate_edge3(std::string_view rest, std::string& out) {
  out += "EDGE_SE3:QUAT";
  append_ids(out, rest, 2);
  translate_euler_pose(rest, out);
  const auto upper = read_triangle<6>(rest);
  expect_end(rest);
  append_triangle<6>(out, to_quaternion_information(upper));
}

}  // namespace

bool looks_like_toro(std::string_view text) {
  bool toro = false;
  scan_tags(text, [&](std::string_view tag) {
    toro = tag == "VERTEX2" || tag == "VERTEX3";
    return tag != "EDGE2" && tag != "EDGE3";
  });
  return toro;
}

std::string toro_to_g2o(std::string_view text, const std::string& file,
                        const Complaint& complaint) {
  return translate_lines(text, file, complaint, [](std::string_view line, std::string& out) {
    auto rest = line;
    const auto tag = next_word(rest);
    if (tag == "VERTEX2") return translate_vertex2(rest, out);
    if (tag == "EDGE2") return translate_edge2(rest, out);
    if (tag == "VERTEX3") return translate_vertex3(rest, out);
    if (tag == "EDGE3") return translate_edge3(rest, out);
    out += line;
  });
}

}  // namespace sg
