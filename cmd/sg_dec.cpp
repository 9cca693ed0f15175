#include <map>

#include "cmd/common/prune_options.h"
#include "lib/prune/decimate.h"

int main(int argc, char** argv) {
  sg::Command command("sg-dec", "Decimate: keep every R-th observation of each landmark.");
  sg::Input input;
  sg::OutputOptions output;
  std::string kind_name;
  sg::Index rate = 1;
  sg::Index min_obs = 1;
  std::uint64_t seed = 1;
  std::string offset = "first";
  const std::map<std::string, sg::DecimationOffset> offsets{
      {"first", sg::DecimationOffset::first},
      {"aligned", sg::DecimationOffset::aligned},
      {"random", sg::DecimationOffset::random}};
  sg::add_input(command, input);
  command.app.add_option("-r,--rate", rate, "Keep pose index mod R = offset")
      ->type_name("R")
      ->check(sg::at_least_one())
      ->required();
  command.app
      .add_option("--offset", offset,
                  "Of a landmark: first (of its first observation;\n"
                  "the default), aligned (0), random")
      ->type_name("KIND")
      ->check(CLI::IsMember(offsets).description(""));
  command.app.add_option("--seed", seed, "Of random offsets (default: 1)")->type_name("N");
  sg::add_candidates(command, kind_name);
  sg::add_min_obs(command, min_obs);
  sg::add_filter_output(command, output);
  return sg::run(command, argc, argv, [&] {
    const sg::Graph graph = sg::read(input);
    const sg::PoseIndex poses = sg::pose_index(graph);
    const auto candidates =
        sg::candidate_edges(graph, poses, sg::candidates_named(kind_name, graph));
    const auto kept = sg::decimate(graph, poses, candidates, rate, offsets.at(offset), seed);
    sg::Removal removal = sg::removal_of_rest(graph, candidates, kept);
    sg::write_filtered(command, output, graph,
                       sg::pruned(command, graph, poses, min_obs, std::move(removal)));
  });
}
