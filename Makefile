# Thin: CMake builds, ctest tests, experiments/ holds the experiments.  `make help` lists the targets.
PRESET ?= release
PREFIX ?= /usr/local
WERROR ?=
BUILD   = build/$(PRESET)
BIN     = $(CURDIR)/$(BUILD)/bin
JOBS   ?= $(shell nproc)

# Debian packages, by what they are for.
build_packages := g++ cmake make ninja-build libeigen3-dev libsuitesparse-dev libboost-dev libboost-graph-dev \
	libboost-random-dev libboost-iostreams-dev libmetis-dev libscotch-dev libcli11-dev nlohmann-json3-dev libtbb-dev \
	libcairo2-dev libspectra-dev libjs-d3 pkg-config
python_packages := python3-dev python3-numpy pybind11-dev
test_packages  := catch2 bats mandoc graphviz zstd gzip bzip2 xz-utils $(python_packages)
lint_packages  := clang-format clang-tidy python3 mandoc git
bench_packages := libbenchmark-dev
clang_packages := clang libclang-rt-14-dev
plot_packages  := gnuplot-nox graphviz
blas_packages  := libopenblas0-serial
deb_packages   := dpkg-dev fakeroot lintian

.DEFAULT_GOAL := build
.NOTPARALLEL:  # packages are installed one list after the other
.PHONY: help deps build benchmarks demo check faults python mutants install uninstall deb bare bench fuzz tsan paper orderings outliers front regimes budget starts marginalize sweep scale speed lint format clean picture

help: ## list the targets
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 12

# Packages that are missing are named and installed, as root or through sudo. dpkg is asked once, and again when this file
# changes; daily use asks nobody, nor does a machine without dpkg, where CMake says what it misses.
build/packages/%: Makefile
	@missing=$$(command -v dpkg-query >/dev/null && printf '%s\n' $($*_packages) | grep -vxF "$$( \
	  dpkg-query -W -f '$${db:Status-Status} $${Package}\n' $($*_packages) 2>/dev/null | sed -n 's/^installed //p')"); \
	if [ -n "$$missing" ]; then \
	  sudo=""; [ "$$(id -u)" = 0 ] || sudo=sudo; \
	  echo "installing Debian packages:" $$missing; \
	  $$sudo apt-get update -qq && \
	  $$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing >/dev/null; fi
	@mkdir -p $(@D) && touch $@

deps: ## install what building and testing need from Debian's packages
	@rm -rf build/packages
	@$(MAKE) --no-print-directory build/packages/build build/packages/test

# $(call configure,OPTIONS), anew every time, which takes half a second: WERROR=ON|OFF then reaches a tree that stands
# already. The preset has a default. $(call build,TARGETS)
configure = cmake --preset $(PRESET) -G Ninja $(if $(WERROR),-DSGTOOLS_WERROR=$(WERROR)) $(1) >/dev/null
build = cmake --build $(BUILD) -j $(JOBS) --target $(1)
# A new tree for commands alone does without the tests and their packages.
commands_alone = $(if $(wildcard $(BUILD)/CMakeCache.txt),,-DSGTOOLS_TESTS=OFF)

build: build/packages/build ## build the commands (PRESET=dev|release|asan|tsan)
	@$(call configure,$(commands_alone))
	@$(call build,commands)

demo: build/packages/build ## generate | prune | reorder | score, as one table (GRAPHS="a.g2o b.g2o" adds yours)
	@$(call configure,$(commands_alone))
	@$(call build,sg-gen sg-kf sg-dec sg-rand sg-order sg-ec)
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -f experiments/demo/Makefile GRAPHS="$(GRAPHS)"

check: build/packages/build build/packages/test ## build everything, and run every test
	@$(call configure,-DSGTOOLS_TESTS=ON -DSGTOOLS_PYTHON=ON)
	@$(call build,all)
	@ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)

faults: build ## kill every command at a random moment, take its memory, its disk or its input away (FAULTS=500)
	@tests/faults $(BIN) $(or $(FAULTS),500)

python: build/packages/build build/packages/python ## build the Python package, into build/release/python
	@$(call configure,$(commands_alone) -DSGTOOLS_PYTHON=ON)
	@$(call build,sgtools_python)

mutants: build/packages/build build/packages/test build/packages/lint ## break the sources in 400 places, one at a time, and list what no test notices
	@nice tests/mutants/run --jobs $(JOBS) $(MUTANTS)

install: build ## install commands, man pages, and the library for CMake and pkg-config (PREFIX=...)
	@cmake --install $(BUILD) --prefix $(PREFIX)

uninstall: ## remove what make install put there
	@cmake -DMANIFEST=$(BUILD)/install_manifest.txt -P cmake/uninstall.cmake

deb: build python build/packages/deb ## make Debian packages, and prove that they install and go
	@rm -rf $(BUILD)/packages
	@cd $(BUILD) && cpack -G DEB >/dev/null
	@tests/install/deb $(BUILD)/packages

bare: deb ## try these packages on a bare Debian 12 (root, debootstrap, a network)
	@tests/install/bare $(BUILD)/packages

picture: build ## draw the picture of the README
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -f experiments/demo/Makefile picture

benchmarks: build/packages/build build/packages/bench build/packages/blas
	@$(call configure,$(commands_alone) -DSGTOOLS_BENCH=ON)
	@$(call build,benchmarks)

bench: benchmarks ## run the benchmarks (BENCH_OPTIONS=--benchmark_filter=...)
	@OPENBLAS_NUM_THREADS=1 $(BIN)/benchmarks $(BENCH_OPTIONS)

speed: benchmarks ## the same as a page: what was wanted, and how near the machine's limits, into out/speed
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/speed OUT=$(CURDIR)/out/speed

fuzz: PRESET := fuzz
fuzz: build/packages/build build/packages/clang ## fuzz every reader, and the calls of every command, for 60 seconds each under the sanitizers (FUZZ_SECONDS=60)
	@$(call configure,$(commands_alone))
	@$(call build,fuzzers)
	@tests/fuzz/run build/fuzz/bin $(or $(FUZZ_SECONDS),60) $(JOBS)

tsan: PRESET := tsan
tsan: build/packages/build build/packages/test build/packages/clang ## run what is parallel under the thread sanitizer
	@$(call configure,-DSGTOOLS_TESTS=ON)
	@$(call build,unit_tests)
	@TSAN_OPTIONS="suppressions=$(CURDIR)/tests/tsan.supp" $(BUILD)/tests/unit_tests "[parallel]"

paper: build build/packages/plot ## reproduce every figure and table of the paper, into out/paper
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/paper OUT=$(CURDIR)/out/paper

orderings: build build/packages/plot build/packages/blas ## every ordering on every graph, into out/orderings (GRAPHS="..." adds yours)
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/orderings OUT=$(CURDIR)/out/orderings \
	  GRAPHS="$(abspath $(GRAPHS))"

outliers: build ## which false edges sg-solve --gnc finds, and what they cost, into out/outliers
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/outliers OUT=$(CURDIR)/out/outliers

front: build build/packages/plot ## what every policy keeps and loses at many budgets, into out/front (GRAPHS="..." adds yours)
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/front OUT=$(CURDIR)/out/front \
	  GRAPHS="$(abspath $(GRAPHS))"

regimes: build build/packages/plot ## where pruning pays and which policy, on a grid of worlds, into out/regimes
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/regimes OUT=$(CURDIR)/out/regimes

budget: build build/packages/plot ## what a budget of EC buys online, into out/budget
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/budget OUT=$(CURDIR)/out/budget

starts: build ## every start of sg-solve on every graph, into out/starts (GRAPHS="..." adds yours)
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/starts OUT=$(CURDIR)/out/starts \
	  GRAPHS="$(abspath $(GRAPHS))"

marginalize: build ## what topologies of marginalized poses cost and lose, into out/marginalize (GRAPHS="..." adds yours)
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/marginalize OUT=$(CURDIR)/out/marginalize \
	  GRAPHS="$(abspath $(GRAPHS))"

sweep: build ## worlds x policies x rates x seeds x orderings, into out/sweep (SWEEP=make|parallel|slurm, WORLDS=..., SEEDS=...)
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/sweep sweep OUT=$(CURDIR)/out/sweep JOBS=$(JOBS)

scale: build ## what pipes over large graphs take, a command and a stage at a time, into out/scale (POSES=1000000)
	@PATH="$(BIN):$$PATH" $(MAKE) --no-print-directory -C experiments/scale OUT=$(CURDIR)/out/scale

SOURCES = $(shell git ls-files '*.h' '*.cpp')

format: build/packages/lint ## rewrite the sources in the project's style
	@clang-format -i $(SOURCES)

lint: build/packages/build build/packages/test build/packages/lint ## check style, includes, sources and man pages
	@$(call configure,-DSGTOOLS_TESTS=ON)
	@clang-format --dry-run --Werror $(SOURCES)
	@tests/layers
	@tests/lint_tests
	@tests/pages
	@tests/tidy $(BUILD) $(JOBS)

clean: ## remove what was built
	rm -rf build out
