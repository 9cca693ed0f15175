// sg-predict: what pruning at a rate r should cost, by the closed forms of the paper.
#include "cmd/common/command.h"
#include "cmd/common/options.h"
#include "cmd/common/table.h"
#include "lib/elim/predict.h"
#include "lib/text/error.h"
#include "lib/text/words.h"

using namespace sg;

namespace {

constexpr std::int64_t most_counted = 1'000'000'000'000;

struct Options {
  cmd::Inputs inputs{{}, {}};
  cmd::OutputOptions output;
  cmd::TableOptions table;
  std::optional<std::int64_t> poses;
  std::int64_t landmarks = 0;
  int pose_dim = 6;
  int landmark_dim = 3;
  std::vector<double> rates{1};
  std::optional<double> ec;
};

struct Row {
  std::string file;
  double r;
  std::optional<elim::Sizes> sizes;
  std::optional<double> ec;

  std::optional<double> by(double (*formula)(const elim::Sizes&, double)) const {
    return sizes ? std::optional(formula(*sizes, r)) : std::nullopt;
  }
  std::optional<double> scaled(double times, double divisor) const {
    return ec ? std::optional(times * *ec / divisor) : std::nullopt;
  }
};

double full(const elim::Sizes& sizes, double /*r*/) {
  return elim::predict_full(sizes);
}

const std::vector<cmd::Column<Row>> columns{
    {"file", "The file", &Row::file, "several files"},
    {"r", "The rate: one pose, or one observation, in r is kept", &Row::r},
    {"full", "(L + X) X^2: without pruning", [](Row& row) { return row.by(full); },
     "a graph or counts"},
    {"kf", "(L + X/r) (X/r)^2: keyframes", [](Row& row) { return row.by(elim::predict_keyframes); },
     "a graph or counts"},
    {"dec", "(L + 9 X) (X/r)^2: decimation",
     [](Row& row) { return row.by(elim::predict_decimation); }, "a graph or counts"},
    {"ec", "The given one", &Row::ec, "--ec"},
    {"ec_kf", "By 1/r^3, what keyframes come close to",
     [](Row& row) { return row.scaled(1, row.r * row.r * row.r); }, "--ec"},
    {"ec_kf2", "By 1/r^2, the least that keyframes save",
     [](Row& row) { return row.scaled(1, row.r * row.r); }, "--ec"},
    {"ec_dec", "By 9/r^2, for decimation", [](Row& row) { return row.scaled(9, row.r * row.r); },
     "--ec"},
};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  auto& app = command.app;
  app.add_option("-r,--rate", options.rates, "Rates of pruning, 1 or more (default: 1)")
      ->option_text("R,...")
      ->delimiter(',')
      ->check(cmd::number(1))
      ->allow_extra_args(false);
  app.add_option("--poses", options.poses, "Number of poses, instead of a graph")
      ->option_text("N")
      ->transform(cmd::whole(1, most_counted));
  app.add_option("--landmarks", options.landmarks, "Number of landmarks (default: 0)")
      ->option_text("N")
      ->transform(cmd::whole(0, most_counted));
  const auto add_dim = [&](const std::string& name, int& dim, const std::string& of) {
    app.add_option(name, dim, "Dimension of a " + of + " (default: " + std::to_string(dim) + ")")
        ->option_text("D")
        ->transform(cmd::whole(1));
  };
  add_dim("--pose-dim", options.pose_dim, "pose");
  add_dim("--landmark-dim", options.landmark_dim, "landmark");
  app.add_option("--ec", options.ec, "EC of the unpruned graph, to be scaled")
      ->option_text("EC")
      ->check(cmd::above_zero());
  cmd::add_output(command, options.output);
  cmd::add_table(command, options.table, columns);
}

// Nothing, and a word why, of a graph that the forms say nothing of.
std::optional<elim::Sizes> sizes_of(const cmd::Command& command, const Graph& graph) {
  const elim::Sizes sizes = elim::sizes(graph);
  if (sizes.poses == 0) throw text::input_error(graph.file, 0, "no pose in it to predict from");
  const double sighted = elim::sighted(graph);
  if (sighted >= elim::least_sighted) return sizes;
  cmd::warn(command, graph.file +
                         ": no prediction: the closed forms are of graphs in which every pose sees "
                         "every landmark, " +
                         (sighted > 0 ? "and here a landmark is seen from " +
                                            text::format_number(std::round(1000 * sighted) / 10) +
                                            " % of the poses, where they want " +
                                            text::format_number(100 * elim::least_sighted) + " %"
                                      : std::string("and here there is none")));
  return std::nullopt;
}

void predict(const cmd::Command& command, const Options& options) {
  const CLI::App& app = command.app;
  cmd::check_form(app);
  cmd::at_most_one(app, {{"--poses", "counts without a graph"}, {"FILE", "is a graph"}});
  if (!options.poses)
    cmd::refuse(app, {"--landmarks", "--pose-dim", "--landmark-dim"}, "without --poses");
  std::vector<std::string> paths = options.inputs.paths;
  if (paths.empty() && !options.poses && !options.ec) paths = {"-"};
  if (paths.empty())
    cmd::refuse(app, {"--from", "--vertex", "--edge", "--params", "--alias", "--skip-unknown"},
                "where no graph is read");
  cmd::Output output(options.output.path);
  cmd::Table table(options.table, columns,
                   {{"several files", paths.size() > 1},
                    {"a graph or counts", options.poses || !paths.empty()},
                    {"--ec", options.ec.has_value()}},
                   output);
  const auto rows = [&](const std::string& file, const std::optional<elim::Sizes>& sizes) {
    cmd::stage("predict");
    for (const double r : options.rates) table.row({file, r, sizes, options.ec});
  };
  if (options.poses)
    rows("", elim::Sizes{static_cast<double>(*options.poses) * options.pose_dim,
                         static_cast<double>(options.landmarks) * options.landmark_dim});
  else if (paths.empty())
    rows("", std::nullopt);
  for (const std::string& path : paths)
    rows(path, sizes_of(command, cmd::read(options.inputs, path)));
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(
      cmd::Command("sg-predict", "Predict what pruning saves, by the paper's closed forms."), argc,
      argv, add_options, predict);
}
