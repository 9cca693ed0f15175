// The table of sg-solve --certify.
#pragma once

#include "cmd/common/table.h"
#include "lib/solve/certificate.h"

namespace sg::solve {

extern const std::vector<cmd::Column<Certificate>> certificate_columns;

// What the table does not say: which edges keep the bound from being tight.
void warn_of_model(const cmd::Command& command, const Certificate& certificate);

}  // namespace sg::solve
