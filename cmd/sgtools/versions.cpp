#include "cmd/sgtools/versions.h"

#include <Spectra/Util/Version.h>
#include <metis.h>
#include <oneapi/tbb/version.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <boost/version.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "lib/solve/front.h"

// Scotch's header needs the C library's before it.
#include <scotch.h>

#include <cstdint>
#include <cstdio>

namespace sg::sgtools {
namespace {

std::string line(std::string name, std::string value) {
  name.append(16 - name.size(), ' ');
  return name + std::move(value) + "\n";
}

std::string dotted(std::initializer_list<long> numbers) {
  std::string text;
  for (const long number : numbers) text += (text.empty() ? "" : ".") + std::to_string(number);
  return text;
}

std::string kernels() {
  std::string there;
  for (const solve::Kernels* kernel : solve::all_kernels())
    there += (there.empty() ? "" : ", ") + std::string(kernel->name);
  return std::string(solve::kernels().name) + " (of " + there + ")";
}

}  // namespace

std::string versions() {
  return "sgtools " SGTOOLS_VERSION "\n" + line("kernels", kernels()) +
         line("compiler", SGTOOLS_COMPILER) +
         line("Boost",
              dotted({BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100})) +
         line("Cairo", SGTOOLS_CAIRO) + line("CLI11", CLI11_VERSION) +
         line("Eigen", dotted({EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION})) +
         line("METIS", dotted({METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR})) +
         line("nlohmann-json", dotted({NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                       NLOHMANN_JSON_VERSION_PATCH})) +
         line("oneTBB", dotted({TBB_VERSION_MAJOR, TBB_VERSION_MINOR, TBB_VERSION_PATCH})) +
         line("Scotch", dotted({SCOTCH_VERSION, SCOTCH_RELEASE, SCOTCH_PATCHLEVEL})) +
         line("Spectra",
              dotted({SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION, SPECTRA_PATCH_VERSION})) +
         line("SuiteSparse", SGTOOLS_SUITESPARSE);
}

}  // namespace sg::sgtools
