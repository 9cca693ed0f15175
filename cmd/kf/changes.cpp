#include "cmd/kf/changes.h"

#include "cmd/common/prune_options.h"

namespace sg::kf {

formats::Changes changes(const prune::Keyframing& keyframing, Index min_obs) {
  formats::Changes changes =
      cmd::pruned(keyframing.graph, keyframing.poses, min_obs, keyframing.removal);
  changes.late_edge = keyframing.late;
  changes.edge_line = [&keyframing](Index e) -> std::optional<std::string> {
    if (!keyframing.rewritten[e]) return std::nullopt;
    return prune::rewritten_line(keyframing, e);
  };
  return changes;
}

}  // namespace sg::kf
