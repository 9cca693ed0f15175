#include <cmath>
#include <string>

#include "lib/order/order.h"
#include "lib/text/error.h"
#include "lib/text/words.h"

namespace sg::order {

Budget parse_budget(std::string_view text, std::string_view option) {
  const bool in_tries = !text.empty() && text.back() == 't';
  if (in_tries) {
    if (const auto tries = text::parse<int>(text.substr(0, text.size() - 1));
        tries && *tries >= 0) {
      return {*tries, 0};
    }
  } else if (const auto seconds = text::parse<double>(text); seconds && *seconds > 0) {
    if (std::isfinite(*seconds)) return {0, *seconds};
  }
  throw text::usage_error(std::string(option) +
                          " wants seconds, as in 2.5, or tries, as in 500t, not '" +
                          std::string(text) + "'");
}

}  // namespace sg::order
