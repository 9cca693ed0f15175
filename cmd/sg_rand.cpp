#include "cmd/common/prune_options.h"
#include "lib/prune/sample.h"

int main(int argc, char** argv) {
  sg::Command command("sg-rand", "Prune observations or loop closures at random.");
  sg::Input input;
  sg::OutputOptions output;
  sg::Amount amount;
  std::string kind_name;
  sg::Index min_obs = 1;
  std::uint64_t seed = 1;
  sg::add_input(command, input);
  sg::add_amount(command, amount);
  command.app.add_option("--seed", seed, "Of the choice (default: 1)")->type_name("N");
  sg::add_candidates(command, kind_name);
  sg::add_min_obs(command, min_obs);
  sg::add_filter_output(command, output);
  return sg::run(command, argc, argv, [&] {
    const sg::Graph graph = sg::read(input);
    const sg::PoseIndex poses = sg::pose_index(graph);
    const sg::Candidates kind = sg::candidates_named(kind_name, graph);
    const auto candidates = sg::candidate_edges(graph, poses, kind);
    const auto count = sg::kept_count(amount, candidates.size(), kind, input.options);
    const auto kept = sg::sample(candidates.size(), count, seed);
    sg::Removal removal = sg::removal_of_rest(graph, candidates, kept);
    sg::write_filtered(command, output, graph,
                       sg::pruned(command, graph, poses, min_obs, std::move(removal)));
  });
}
