// The table of sg-solve --certify.
#pragma once

#include "cmd/common/table.h"
#include "lib/solve/certificate.h"

namespace sg::solving {

extern const std::vector<cmd::Column<solve::Certificate>> certificate_columns;

// What the table does not say: which edges keep the bound from being tight.
void warn_of_model(const cmd::Command& command, const solve::Certificate& certificate);

}  // namespace sg::solving
