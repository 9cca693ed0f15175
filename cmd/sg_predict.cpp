// sg-predict: what pruning at a rate r should cost, by the closed forms of the paper.
#include <cmath>

#include "cmd/common/command.h"
#include "cmd/common/table.h"
#include "lib/elim/predict.h"
#include "lib/text/error.h"

namespace {

const std::vector<std::string_view> columns{"r",  "full",  "kf",     "dec",
                                            "ec", "ec_kf", "ec_kf2", "ec_dec"};

struct Options {
  sg::Input input{"", {}};
  sg::OutputOptions output;
  sg::TableOptions table;
  std::int64_t poses = 0;
  std::int64_t landmarks = 0;
  int pose_dim = 6;
  int landmark_dim = 3;
  std::vector<double> rates;
  double ec = 0;
};

// Which of the things to predict from the call gives.
struct Given {
  bool counts;
  bool ec;
};

sg::Sizes sizes_of(const Options& options, const Given& given) {
  if (given.counts) {
    return {static_cast<double>(options.poses) * options.pose_dim,
            static_cast<double>(options.landmarks) * options.landmark_dim};
  }
  sg::Input input = options.input;
  if (input.path.empty()) input.path = "-";
  const sg::Graph graph = sg::read(input);
  const sg::Sizes sizes = sg::sizes(graph);
  if (sizes.poses == 0) throw sg::input_error(graph.file, 0, "no pose in it to predict from");
  return sizes;
}

void print_rows(const Options& options, const Given& given, sg::Output& output) {
  const bool has_sizes = given.counts || !given.ec || !options.input.path.empty();
  sg::TableOptions table_options = options.table;
  if (table_options.columns.empty()) {
    table_options.columns = {"r"};
    if (has_sizes) table_options.columns.insert(table_options.columns.end(), {"full", "kf", "dec"});
    if (given.ec)
      table_options.columns.insert(table_options.columns.end(),
                                   {"ec", "ec_kf", "ec_kf2", "ec_dec"});
  }
  sg::Table table(table_options, columns, output);
  const sg::Sizes sizes = has_sizes ? sizes_of(options, given) : sg::Sizes{};
  const auto known = [](bool is, double value) { return is ? sg::Cell(value) : sg::Cell(); };
  for (const double r : options.rates) {
    const double ec = options.ec;
    table.row({r, known(has_sizes, sg::predict_full(sizes)),
               known(has_sizes, sg::predict_keyframes(sizes, r)),
               known(has_sizes, sg::predict_decimation(sizes, r)), known(given.ec, ec),
               known(given.ec, ec / (r * r * r)), known(given.ec, ec / (r * r)),
               known(given.ec, 9 * ec / (r * r))});
  }
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-predict", "Predict what pruning saves, by the paper's closed forms.");
  Options options;
  sg::add_input(command, options.input);
  auto& app = command.app;
  auto* file = app.get_option("FILE");
  app.add_option("-r,--rate", options.rates, "Rates of pruning, 1 or more (default: 1)")
      ->option_text("R,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  auto* poses = app.add_option("--poses", options.poses, "Number of poses, instead of a graph")
                    ->option_text("N")
                    ->check(CLI::PositiveNumber)
                    ->excludes(file);
  app.add_option("--landmarks", options.landmarks, "Number of landmarks (default: 0)")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber)
      ->needs(poses);
  app.add_option("--pose-dim", options.pose_dim, "Dimension of a pose (default: 6)")
      ->option_text("D")
      ->check(CLI::PositiveNumber)
      ->needs(poses);
  app.add_option("--landmark-dim", options.landmark_dim, "Dimension of a landmark (default: 3)")
      ->option_text("D")
      ->check(CLI::PositiveNumber)
      ->needs(poses);
  auto* ec = app.add_option("--ec", options.ec, "EC of the unpruned graph, to be scaled")
                 ->option_text("EC")
                 ->check(CLI::PositiveNumber);
  sg::add_output(command, options.output);
  sg::add_table(command, options.table, columns);
  return sg::run(command, argc, argv, [&] {
    if (options.rates.empty()) options.rates = {1};
    for (const double r : options.rates) {
      if (!(r >= 1) || std::isinf(r)) throw sg::usage_error("-r wants a rate of 1 or more");
    }
    sg::Output output(options.output.path);
    print_rows(options, {poses->count() > 0, ec->count() > 0}, output);
    output.commit();
  });
}
