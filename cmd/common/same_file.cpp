#include "cmd/common/same_file.h"

#include <filesystem>

namespace sg::cmd {

bool same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  const auto is_standard = [](const std::string& path) { return path.empty() || path == "-"; };
  const auto whole = [](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path));
  };
  if (is_standard(a) || is_standard(b)) return is_standard(a) && is_standard(b);
  return whole(a) == whole(b) && (!fs::exists(a) || fs::is_regular_file(a));
}

}  // namespace sg::cmd
