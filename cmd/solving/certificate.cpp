#include "cmd/solving/certificate.h"

namespace sg::solving {

using solve::Certificate;

const std::vector<cmd::Column<Certificate>> certificate_columns{
    {"certified", "Whether no estimate is better by a thousandth", &solve::is_certified},
    {"chi2", "Chi-square of the graph as it is", &Certificate::chi2},
    {"bound", "No estimate has less", &Certificate::bound},
    {"eigenvalue", "Least one of the certificate's matrix", &Certificate::eigenvalue},
    {"isotropic", "Edges that count in full", &Certificate::isotropic},
    {"in_part", "Edges with information that is not isotropic", &Certificate::in_part},
    {"left_out", "Edges of other types", &Certificate::left_out},
};

void warn_of_model(const cmd::Command& command, const Certificate& certificate) {
  if (solve::is_certified(certificate)) return;
  if (certificate.in_part + certificate.left_out == 0) return;
  cmd::warn(command,
            "the certificate's model is isotropic noise of relative poses: " +
                std::to_string(certificate.in_part) + " edges count in part, " +
                std::to_string(certificate.left_out) +
                " not at all; what is not certified may be the global optimum all the same");
}

}  // namespace sg::solving
