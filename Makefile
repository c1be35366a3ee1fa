# What a person types. Each target sets up what it needs: packages, configuration, build. How it works: docs/building.md.

JOBS ?= $(shell nproc)
CCACHE := $(shell command -v ccache 2> /dev/null)

# All is said each time, for CMake remembers what it was told last. What includes precompiled headers is not kept by ccache,
# and several sources compiled as one are seldom the same again. Under the sanitizers each is compiled by itself, too.
# The second word: whether benchmarks are built; the third: whether tests are, of which those that build without them lack the packages.
configure = cmake --preset $(1) -DSIGMASCAPE_BENCHMARKS=$(or $(2),OFF) -DSIGMASCAPE_TESTS=$(or $(3),ON) \
	-DCMAKE_CXX_COMPILER_LAUNCHER=$(CCACHE) -DCMAKE_DISABLE_PRECOMPILE_HEADERS=$(if $(CCACHE),ON,OFF) \
	-DCMAKE_UNITY_BUILD=$(if $(CCACHE),OFF,$(if $(filter release,$(1)),ON,OFF))
build = cmake --build build/$(1) --parallel $(JOBS)
run_tests = ctest --test-dir build/$(1) --parallel $(JOBS) --output-on-failure
sanitized = tools/with_sanitizer_options
sources = find $(1) -name '*.cpp' -o -name '*.h'

.DEFAULT_GOAL := help
# Targets share folders, and each uses all cores by itself.
.NOTPARALLEL:
.PHONY: help packages packages-build demo results results-small test test-long test-asan test-tsan test-all validation bench lint clean

help: ## Say what can be made
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-14s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

packages: ## Install the Debian packages that are missing
	@tools/install_packages

packages-build:
	@tools/install_packages build

demo: packages-build ## Build, then make the demo's maps and page under out/demo
	$(call configure,release,OFF,OFF)
	$(call build,release) --target sigmascape_cli
	build/release/apps/sigmascape/sigmascape demo --out out/demo

measure = build/release/apps/sigmascape/sigmascape results

results-small: packages-build ## Measure how close baked maps come to traced ones, small: a quarter of an hour on two cores
	$(call configure,release,OFF,OFF)
	$(call build,release) --target sigmascape_cli
	$(measure) --small --out out/results_small

# What docs/results is made with: the paper's scene with the paper's materials and with real ones, then real places, whose data
# SIGMASCAPE_DATA names. RESULTS_PAPER= and so on measure otherwise; left empty, on 1 km².
RESULTS_PAPER ?= --scale 0.2 --held-out 24 --on-grid 3 --repeated 1 --samples 100 --traced-samples 1024 --most-traced-samples 3072 --finer-samples 3072
RESULTS_ITU ?= --scale 0.2 --held-out 24 --on-grid 4 --repeated 1 --samples 64 --traced-samples 512 --most-traced-samples 1536 --finer-samples 768
RESULTS_BILBAO ?= --no-finest-grid --scale 0.2 --held-out 24 --on-grid 4 --repeated 1 --samples 64 --traced-samples 768 --most-traced-samples 1536 --finer-samples 768
RESULTS_SAN_FRANCISCO ?= --small --scale 0.2 --held-out 24 --on-grid 3 --repeated 1 --samples 32 --traced-samples 256 --finer-samples 256

results: packages-build ## Measure as docs/results was, on real places too, and write it anew: about sixteen hours on two cores, 30 of processor time, goes on where it was broken off
	$(call configure,release,OFF,OFF)
	$(call build,release) --target sigmascape_cli
	$(measure) $(RESULTS_PAPER) --out out/results/paper --page docs/results/README.md
	$(measure) --itu-materials $(RESULTS_ITU) --out out/results/itu --page docs/results/itu/README.md
	$(measure) --scene examples/bilbao/bilbao.toml --around 350 400 $(RESULTS_BILBAO) --out out/results/bilbao --page docs/results/bilbao/README.md
	$(measure) --scene examples/san_francisco/san_francisco.toml --around 250 250 $(RESULTS_SAN_FRANCISCO) --out out/results/san_francisco --page docs/results/san_francisco/README.md
	$(measure) $(RESULTS_PAPER) --out out/results/paper --page docs/results/README.md # from what is kept, for its table of all scenes

# Benchmarks are built with them, lest they cease to compile unnoticed.
test: packages ## Build and run the tests
	$(call configure,release,ON)
	$(call build,release)
	$(call run_tests,release) --no-tests=error --label-exclude '^long$$'

test-long: packages ## Run the tests that take long
	$(call configure,release)
	$(call build,release)
	$(call run_tests,release) --label-regex '^long$$'

test-asan: ## Run the tests under the address and undefined-behaviour sanitizers
test-tsan: ## Run the tests under the thread sanitizer
test-asan test-tsan: test-%: packages
	$(call configure,$*)
	$(sanitized) $(call build,$*)
	$(sanitized) $(call run_tests,$*) --no-tests=error --label-exclude '^long$$'

test-all: test test-asan test-tsan test-long ## Run all tests, also under the sanitizers and those that take long

validation: packages ## Write docs/physics/validation.md: every case, expected and measured
	$(call configure,release)
	$(call build,release)
	mkdir -p out && rm -f out/validation.jsonl
	SIGMASCAPE_VALIDATION_RECORDS="$(CURDIR)/out/validation.jsonl" $(call run_tests,release) --label-exclude '^(long|python)$$'
	tools/validation_table out/validation.jsonl docs/physics/validation.md

bench: packages-build ## Measure on this machine, on the paper's scene: hours. JSON lines under out/bench
	$(call configure,release,ON,OFF)
	$(call build,release) --target benchmarks --target sigmascape_python_package
	for program in build/release/benchmarks/bench_*; do $$program --out out/bench/$${program##*bench_}.jsonl || exit 1; done
	PYTHONPATH=build/release/python /usr/bin/python3 benchmarks/python/overhead.py --out out/bench/python.jsonl

lint: packages ## Check formatting and run the static analysis
	$(call sources,src apps python benchmarks examples tests) | xargs clang-format --dry-run -Werror
	cmake --preset release -B build/lint -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
	run-clang-tidy -quiet -p build/lint -j $(JOBS) '/(src|apps)/sigmascape/'

clean: ## Remove everything that was built or made
	rm -rf build out
