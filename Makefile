# Thin: CMake builds, ctest tests, experiments/ holds the experiments.  `make help` lists the targets.
PRESET ?= release
PREFIX ?= /usr/local
WERROR ?=
BUILD  := build/$(PRESET)
BIN    := $(CURDIR)/$(BUILD)/bin
JOBS   ?= $(shell nproc)

# Debian packages, by what they are for.
BUILD_PACKAGES := g++ cmake make ninja-build libeigen3-dev libsuitesparse-dev libboost-dev libboost-graph-dev \
	libboost-random-dev libboost-iostreams-dev libmetis-dev libscotch-dev libcli11-dev nlohmann-json3-dev libtbb-dev \
	libcairo2-dev libspectra-dev pkg-config
TEST_PACKAGES  := catch2 bats python3 mandoc graphviz zstd gzip
LINT_PACKAGES  := clang-format clang-tidy python3 mandoc git
BENCH_PACKAGES := libbenchmark-dev
FUZZ_PACKAGES  := clang libclang-rt-14-dev
PLOT_PACKAGES  := gnuplot-nox graphviz

.DEFAULT_GOAL := build
.PHONY: help deps build demo check test mutants install bench fuzz paper orderings lint format clean

help: ## list the targets
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 12

# $(call need,PACKAGES): installs those that are missing, as root or through sudo, and says which.
define need
	@missing=""; for p in $(1); do \
	  dpkg-query -W -f '$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; done; \
	if [ -n "$$missing" ]; then \
	  sudo=""; [ "$$(id -u)" = 0 ] || sudo=sudo; \
	  echo "installing Debian packages:$$missing"; \
	  $$sudo apt-get update -qq && \
	  $$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing >/dev/null; fi
endef

deps: ## install what building and testing need from Debian's packages
	$(call need,$(BUILD_PACKAGES) $(TEST_PACKAGES))

# Anew every time, which takes a second: WERROR=ON|OFF then reaches a tree that stands already. The preset has a default.
configure = cmake --preset $(PRESET) -G Ninja $(if $(WERROR),-DSGTOOLS_WERROR=$(WERROR)) >/dev/null

build: deps ## build the commands and the tests (PRESET=dev|release|asan|tsan)
	@$(configure)
	@cmake --build $(BUILD) -j $(JOBS)

demo: build ## generate | prune | reorder | score, as one table (GRAPHS="a.g2o b.g2o" adds yours)
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -f experiments/demo/Makefile GRAPHS="$(GRAPHS)"

check: build test ## set up, build, and run every test

test:
	@ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)

mutants: deps ## break the sources in 400 places, one at a time, and list what no test notices (MUTANTS="--sites 100")
	@nice tests/mutants/run --jobs $(JOBS) $(MUTANTS)

install: build ## install commands, man pages, library and CMake package (PREFIX=...)
	@cmake --install $(BUILD) --prefix $(PREFIX)

bench: deps ## run the benchmarks (BENCH_OPTIONS=--benchmark_filter=...)
	$(call need,$(BENCH_PACKAGES))
	@$(configure) -DSGTOOLS_BENCH=ON
	@cmake --build $(BUILD) -j $(JOBS) --target benchmarks
	@PATH="$(BIN):$$PATH" $(BIN)/benchmarks $(BENCH_OPTIONS)

fuzz: PRESET := fuzz
fuzz: deps ## fuzz every reader for 60 seconds under the sanitizers (FUZZ_SECONDS=60)
	$(call need,$(FUZZ_PACKAGES))
	@$(configure)
	@cmake --build build/fuzz -j $(JOBS) --target fuzzers
	@tests/fuzz/run build/fuzz/bin $(or $(FUZZ_SECONDS),60)

paper: build ## reproduce every figure and table of the paper, into out/paper
	$(call need,$(PLOT_PACKAGES))
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/paper OUT=$(CURDIR)/out/paper

orderings: build ## every ordering on every graph, into out/orderings (GRAPHS="..." adds yours)
	$(call need,$(PLOT_PACKAGES))
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/orderings OUT=$(CURDIR)/out/orderings \
	  GRAPHS="$(abspath $(GRAPHS))"

SOURCES = $(shell git ls-files '*.h' '*.cpp')

format: ## rewrite the sources in the project's style
	$(call need,clang-format git)
	@clang-format -i $(SOURCES)

lint: build ## check style, includes, sources and man pages
	$(call need,$(LINT_PACKAGES))
	@clang-format --dry-run --Werror $(SOURCES)
	@tests/layers
	@tests/lint_tests
	@tests/pages
	@printf '%s\n' $(filter %.cpp,$(SOURCES)) | grep -v '^tests/fuzz\|^tests/bench' | \
	  xargs -P $(JOBS) -n 4 clang-tidy --quiet -p $(BUILD)

clean: ## remove what was built
	rm -rf build out
