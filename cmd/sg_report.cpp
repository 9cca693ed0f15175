// sg-report: one page that says what a graph costs, what could be done about it, and what that would lose.
#include <oneapi/tbb/info.h>

#include "cmd/check/findings.h"
#include "cmd/common/complete.h"
#include "cmd/common/options.h"
#include "cmd/info/facts.h"
#include "cmd/plot/words.h"
#include "cmd/report/page.h"
#include "lib/solve/front.h"
#include "lib/text/nearest.h"

using namespace sg;

namespace {

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  std::string want;
  double budget = 120;
  cmd::MethodOptions methods{{"colamd", "amd", "metis", "scotch", "wmf"}};
  std::vector<std::string> policies;
  std::vector<Index> rates{2, 4, 8};
  std::optional<Index> min_obs;
  std::string reference;
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  auto& app = command.app;
  app.add_option("--want", options.want,
                 "faster=TIMES, ate=ERROR or sigma-part=TIMES\n(default: sigma-part=1.05)")
      ->option_text("WISH");
  app.add_option("--budget", options.budget, "Measure for N seconds a graph (default: 120)")
      ->option_text("N")
      ->check(cmd::above_zero());
  app.add_option("-m,--method", options.methods.names,
                 "Orderings to compare (default: the file's own,\ncolamd, amd, metis, scotch, wmf)")
      ->option_text("METHOD,...")
      ->delimiter(',')
      ->check(cmd::suggests(text::names_of(order::orderings())))
      ->allow_extra_args(false);
  cmd::add_seed(app, options.methods.seed, "Seed of orderings that draw");
  const std::vector<std::string> names = text::names_of(report::policies());
  app.add_option("--policies", options.policies,
                 cmd::wrapped_list("Besides the whole graph, some of ", names, ", "))
      ->option_text("NAME,...")
      ->delimiter(',')
      ->check(cmd::one_of(names))
      ->allow_extra_args(false);
  app.add_option("-r,--rates", options.rates, "Rates of policies (default: 2,4,8)")
      ->option_text("R,...")
      ->delimiter(',')
      ->transform(cmd::whole(2))
      ->allow_extra_args(false);
  app.add_option("--min-obs", options.min_obs,
                 "Landmarks that keep fewer observations go (default:\n3 where one does not place "
                 "a landmark, else 1)")
      ->option_text("M")
      ->transform(cmd::whole(1));
  app.add_option("--reference", options.reference,
                 "Errors are those against this graph or trajectory\n(default: the graph, solved)")
      ->option_text("FILE");
  cmd::add_output(app, options.output, "Write to FILE.html, whole or not at all",
                  cmd::Writes::other);
}

report::Sheet facts_sheet(const report::Study& study, std::string_view format) {
  info::Row row{study.graph, format, graph::summarize(study.graph), {}};
  report::Sheet result;
  result.call = call(study.source, "sg-info");
  result.columns = {{"key", "A fact's name", ""}, {"value", "What it is", ""}, {"what", "", ""}};
  for (const auto& fact : info::facts) {
    if (fact.name != "file")
      result.rows.push_back({fact.name, cmd::text(fact.cell(row)), fact.what});
  }
  return result;
}

report::Sheet findings_sheet(report::Study& study, std::string_view format) {
  constexpr std::size_t most = 100;
  report::Sheet result;
  result.call = call(study.source, "sg-check");
  const auto columns = report::some(check::columns, {"severity", "line", "cause"});
  result.columns = cmd::headings(columns);
  std::vector<check::Message> findings = check::findings(study.graph, format, {});
  for (check::Message& finding : findings) {
    if (result.rows.size() < most) result.rows.push_back(report::cells(columns, finding));
  }
  if (findings.size() > most)
    study.notes.push_back("of " + std::to_string(findings.size()) + " findings the first " +
                          std::to_string(most));
  return result;
}

// Whether some observation has fewer numbers than the landmark that it sees.
bool sees_rays(const Graph& graph) {
  const auto roles = graph::edge_roles(graph, graph::pose_index(graph));
  for (Index e = 0; e < graph.edges(); ++e) {
    if (roles[e] != graph::EdgeRole::observation) continue;
    for (const Index v : graph.edge(e)) {
      if (graph.role(v) == graph::Role::landmark && graph.type_of_edge(e).dim < graph.dim(v))
        return true;
    }
  }
  return false;
}

report::Choice choice(const Options& options, const Graph& graph) {
  report::Choice result{{}, options.rates, options.min_obs.value_or(sees_rays(graph) ? 3 : 1)};
  for (const report::Policy& policy : report::policies()) {
    const bool whole = &policy == &report::policies().front();
    if (whole || options.policies.empty() ||
        std::ranges::find(options.policies, policy.name) != options.policies.end())
      result.policies.push_back(&policy);
  }
  return result;
}

// What trajectories are compared with, and what calls name it.
struct Reference {
  std::optional<scoring::Reference> given;
  std::string file = "solved.g2o";
};

report::Chapter chapter(const cmd::Command& command, const Options& options,
                        const Reference& reference, const std::string& path) {
  const report::Deadline deadline{.seconds = options.budget};
  const cmd::Input input{path, options.inputs.options};
  text::Text text = cmd::read_text(input);
  const std::string_view format = formats::find_format(input.options, text.view).name;
  const Graph graph = cmd::read(input, std::move(text));
  report::Study study{command,
                      graph,
                      options.inputs.options,
                      report::source(path, options.inputs.options),
                      options.methods,
                      oneapi::tbb::info::default_concurrency()};
  report::Chapter result;
  result.title = plot::counted(graph);
  result.wish = options.want.empty() ? report::Wish{} : report::parse_wish(options.want);
  cmd::stage("check");
  result.facts = facts_sheet(study, format);
  result.findings = findings_sheet(study, format);
  cmd::stage("order");
  const std::vector<report::Ordered> orderings =
      report::orderings(study, report::part(deadline, 0.3));
  result.orderings = report::sheet(study, orderings);
  cmd::stage("price");
  const cmd::Method& first = orderings.front().method;
  result.variables = report::costliest_variables(study, first);
  result.cliques = report::costliest_cliques(study, first);
  result.edges = report::costliest_edges(study, first);
  result.map = report::map(study, first, orderings.front().order);
  result.measured = report::variants(study, choice(options, graph), orderings, reference.given,
                                     reference.file, deadline);
  result.variants = report::sheet(result.measured);
  if (!reference.given)
    result.calls.push_back(call(study.source, "sg-solve") + " -o " + reference.file);
  result.advice = report::advise(result.wish, result.measured);
  result.notes = std::move(study.notes);
  return result;
}

void check_call(const Options& options) {
  cmd::check(options.methods);
  if (!options.want.empty()) report::parse_wish(options.want);
  const std::string& path = options.output.path;
  const auto dot = path.rfind('.');
  const bool ends = dot != path.npos && path.find('/', dot) == path.npos;
  if (ends && !path.ends_with(".html") && !path.ends_with(".htm"))
    throw text::usage_error("a page's name ends in .html; not so '" + path + "'");
}

void run(const cmd::Command& command, const Options& options) {
  check_call(options);
  solve::kernels();
  Reference reference;
  if (!options.reference.empty()) {
    cmd::begin_reading(options.reference);
    reference = {scoring::Reference{formats::read_graph(options.reference)}, options.reference};
  }
  cmd::Output output(options.output.path);
  cmd::finish_first();
  std::vector<report::Chapter> chapters;
  for (const std::string& path : options.inputs.paths)
    chapters.push_back(chapter(command, options, reference, path));
  cmd::stage("write");
  output.write(report::page(command.call, std::move(chapters)));
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(
      cmd::Command("sg-report", "One page: what a graph costs, what to do, what is lost."), argc,
      argv, add_options, run);
}
