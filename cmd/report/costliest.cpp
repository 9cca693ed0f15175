#include "cmd/report/costliest.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "cmd/bayes/tree.h"
#include "cmd/ec/columns.h"
#include "cmd/plot/heat.h"
#include "cmd/plot/picture.h"
#include "cmd/plot/scenes.h"

namespace sg::report {
namespace {

constexpr plot::PageSize page_size{720, 540};

// The first of the rows by what they cost, of equal ones in the order given; `call` prints all of them, cost first.
template <class Row>
Sheet costliest(const std::vector<cmd::Column<Row>>& columns, std::vector<Row> rows,
                const auto& cost, const std::string& call) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t k) { return cost(rows[k]); });
  order.resize(std::min(order.size(), most_listed));
  Sheet result;
  result.call = call + " | sort -s -g -r -k 1,1 | sed -n 1," + std::to_string(most_listed) + "p";
  result.columns = cmd::headings(columns);
  for (const std::size_t k : order) result.rows.push_back(cells(columns, rows[k]));
  return result;
}

}  // namespace

Sheet costliest_variables(const Study& study, const cmd::Method& method) {
  const auto columns =
      some(ec::vertex_columns, {"cost", "share", "id", "tag", "role", "position", "d_f", "d_s"});
  const ec::Subject of = subject(study, method);
  std::vector<ec::VertexRow> rows;
  ec::vertex_rows(of, [&](const ec::VertexRow& row) { rows.push_back(row); });
  return costliest(
      columns, std::move(rows), [](const ec::VertexRow& row) { return row.cost(); },
      call(study.source,
           "sg-ec -m " + method.label + " --per-vertex --no-header -f " + names(columns)));
}

Sheet costliest_cliques(const Study& study, const cmd::Method& method) {
  const auto columns = some(bayes::columns, {"cost", "clique", "depth", "d_f", "d_s", "frontal"});
  bayes::NamedTree named = bayes::named_tree(study.methods, study.graph, method);
  std::vector<bayes::Row> rows;
  rows.reserve(named.tree.cliques());
  for (Index c = 0; c < named.tree.cliques(); ++c) rows.push_back({named, c});
  return costliest(
      columns, std::move(rows),
      [](const bayes::Row& row) {
        return elim::elimination_cost(row.frontal_dim(), row.total_dim());
      },
      call(study.source, "sg-bayes -m " + method.label + " --no-header -f " + names(columns)));
}

Sheet costliest_edges(const Study& study, const cmd::Method& method) {
  const auto columns = some(ec::edge_columns, {"price", "share", "ids", "tag", "role"});
  const ec::Subject of = subject(study, method);
  std::vector<ec::EdgeRow> rows;
  ec::edge_rows(of, [&](const ec::EdgeRow& row) { rows.push_back(row); });
  return costliest(
      columns, std::move(rows), [](const ec::EdgeRow& row) { return row.price; },
      call(study.source,
           "sg-ec -m " + method.label + " --per-edge --no-header -f " + names(columns)));
}

Map map(Study& study, const cmd::Method& method, const graph::Order& order) {
  Map result;
  result.call = call(study.source, "sg-plot map --cost -m " + method.label + " --width " +
                                       cmd::text(page_size.width) + " --height " +
                                       cmd::text(page_size.height));
  try {
    const plot::View view = plot::best_view(study.graph);
    const plot::Costs costs = plot::costs(study.variables, order);
    const plot::Heading heading = plot::cost_heading(study.graph, costs, method.label);
    result.svg = plot::picture(
        plot::PictureFormat::svg, page_size.width, page_size.height, [&](cairo_t* page) {
          plot::draw_cost_map(page, page_size, study.graph, view, costs, heading);
        });
    const std::vector<plot::Point> at = plot::places(study.graph, view, page_size);
    const auto& ascending = costs.ascending;
    for (std::size_t k = 0; k < std::min<std::size_t>(ascending.size(), 200); ++k) {
      const Index v = ascending[ascending.size() - 1 - k];
      result.spots.push_back({study.graph.id[v], at[v].x, at[v].y, cmd::text(costs.vertex[v])});
    }
  } catch (const text::Error& error) {
    study.notes.push_back("no map: " + text::message(error));
  }
  return result;
}

}  // namespace sg::report
