#include "cmd/report/page.h"

#include <nlohmann/json.hpp>

namespace sg::report {
namespace {

using Json = nlohmann::ordered_json;

// page.html with what it wants to be in it but the data (cmd/CMakeLists.txt).
const std::string_view html =
#include "page.inc"
    ;
constexpr std::string_view data_place = "@DATA@", maps_place = "@MAPS@";

Json json(const Sheet& sheet) {
  Json columns = Json::array();
  for (const cmd::Heading& heading : sheet.columns)
    columns.push_back({{"name", heading.name}, {"what", heading.what}});
  return {{"call", sheet.call}, {"columns", columns}, {"rows", sheet.rows}};
}

Json json(const Map& map) {
  Json spots = Json::array();
  for (const Map::Spot& spot : map.spots)
    spots.push_back({{"id", spot.id}, {"x", spot.x}, {"y", spot.y}, {"cost", spot.cost}});
  return {{"call", map.call}, {"spots", spots}};
}

Json json(const Chapter& chapter) {
  Json calls = Json::array();
  for (const Variant& variant : chapter.measured)
    calls.push_back({{"pipe", variant.pipe}, {"prints", variant.calls}});
  Json advice{{"wish", chapter.wish.text},
              {"sentence", chapter.advice.sentence},
              {"granted", chapter.advice.granted}};
  if (const auto chosen = chapter.advice.variant) {
    const Variant& variant = chapter.measured[*chosen];
    advice["variant"] = *chosen;
    advice["pipe"] = variant.pipe;
    advice["check"] = variant.calls.front();
    advice["ec"] = elim::to_string(variant.ec);
  }
  return {{"title", chapter.title},
          {"facts", json(chapter.facts)},
          {"findings", json(chapter.findings)},
          {"orderings", json(chapter.orderings)},
          {"map", json(chapter.map)},
          {"variables", json(chapter.variables)},
          {"cliques", json(chapter.cliques)},
          {"edges", json(chapter.edges)},
          {"variants", json(chapter.variants)},
          {"calls", calls},
          {"first", chapter.calls},
          {"advice", advice},
          {"notes", chapter.notes}};
}

std::string replaced(std::string text, std::string_view what, const std::string& by) {
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// Hundredths of a point are finer than anybody sees.
std::string rounded_down(const std::string& svg) {
  std::string result;
  std::size_t decimals = 0;  // behind a point
  bool number = false;
  for (const char c : svg) {
    const bool digit = c >= '0' && c <= '9';
    if (number && digit && ++decimals > 2) continue;
    number = digit ? number : c == '.';
    if (!digit) decimals = 0;
    result += c;
  }
  return result;
}

// An SVG picture as a part of a page that has several: names of its own, no XML declaration, as wide as there is room.
std::string inlined(std::string svg, std::size_t k) {
  const std::string own = "m" + std::to_string(k) + "-";
  svg.erase(0, svg.find("<svg"));
  svg = replaced(std::move(svg), "id=\"", "id=\"" + own);
  svg = replaced(std::move(svg), "href=\"#", "href=\"#" + own);
  return rounded_down(replaced(std::move(svg), "url(#", "url(#" + own));
}

}  // namespace

std::string page(const std::string& call, std::vector<Chapter> chapters) {
  Json data{{"call", call}, {"policies", Json::object()}, {"graphs", Json::array()}};
  for (const Policy& policy : policies()) data["policies"][policy.name] = policy.what;
  std::string maps;
  for (std::size_t k = 0; k < chapters.size(); ++k) {
    data["graphs"].push_back(json(chapters[k]));
    maps += "<div class=\"drawn\" data-graph=\"" + std::to_string(k) + "\">" +
            inlined(std::move(chapters[k].map.svg), k) + "</div>\n";
  }
  // Within a script only "</" could end it. What is not UTF-8 (a file's name) becomes U+FFFD.
  const std::string text =
      replaced(data.dump(-1, ' ', false, Json::error_handler_t::replace), "</", "<\\/");
  std::string result(html);
  result.replace(result.find(data_place), data_place.size(), text);
  result.replace(result.find(maps_place), maps_place.size(), maps);
  return result;
}

}  // namespace sg::report
