# What a person types. Each target sets up what it needs: packages, configuration, build. How it works: docs/building.md.

JOBS ?= $(shell nproc)
CCACHE := $(shell command -v ccache 2> /dev/null)

configure = cmake --preset $(1) $(if $(CCACHE),-DCMAKE_CXX_COMPILER_LAUNCHER=$(CCACHE))
build = cmake --build build/$(1) --parallel $(JOBS)
run_tests = ctest --test-dir build/$(1) --parallel $(JOBS) --output-on-failure
sanitized = tools/with_sanitizer_options
sources = find $(1) -name '*.cpp' -o -name '*.h'

.DEFAULT_GOAL := help
.PHONY: help packages demo results results-small test test-long test-asan test-tsan test-all validation bench lint clean

help: ## Say what can be made
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-14s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

packages: ## Install the Debian packages that are missing
	@tools/install_packages

demo: packages ## Build, then make the demo's maps and page under out/demo
	$(call configure,release)
	$(call build,release) --target sigmascape_cli
	build/release/apps/sigmascape/sigmascape demo --out out/demo

measure = build/release/apps/sigmascape/sigmascape results

results-small: packages ## Measure how close baked maps come to traced ones, small: a quarter of an hour
	$(call configure,release)
	$(call build,release) --target sigmascape_cli
	$(measure) --small --out out/results_small

# The paper's scene with the paper's materials and with real ones, then real places, whose data SIGMASCAPE_DATA names. RESULTS says what
# is to differ from the full size: RESULTS="--scale 0.2" or RESULTS=--small.
results: packages ## The same at full size, on real places too: many hours, goes on where it was broken off. Writes docs/results
	$(call configure,release)
	$(call build,release) --target sigmascape_cli
	$(measure) $(RESULTS) --out out/results/paper --page docs/results/README.md
	$(measure) $(RESULTS) --itu-materials --out out/results/itu --page docs/results/itu/README.md
	$(measure) $(RESULTS) --scene examples/bilbao/bilbao.toml --around 350 400 --out out/results/bilbao --page docs/results/bilbao/README.md
	$(measure) $(RESULTS) --scene examples/san_francisco/san_francisco.toml --out out/results/san_francisco --page docs/results/san_francisco/README.md

test: packages ## Build and run the tests
	$(call configure,release)
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
	SIGMASCAPE_VALIDATION_RECORDS=$(CURDIR)/out/validation.jsonl $(call run_tests,release) --label-exclude '^(long|python)$$'
	tools/validation_table out/validation.jsonl docs/physics/validation.md

bench: packages ## Measure on this machine, on the paper's scene: tens of minutes. JSON lines under out/bench
	$(call configure,release) -DSIGMASCAPE_BENCHMARKS=ON
	$(call build,release) --target benchmarks --target sigmascape_python_package
	for program in build/release/benchmarks/bench_*; do $$program --out out/bench/$${program##*bench_}.jsonl || exit 1; done
	PYTHONPATH=build/release/python /usr/bin/python3 benchmarks/python/overhead.py --out out/bench/python.jsonl

lint: packages ## Check formatting and run the static analysis
	$(call sources,src apps tests) | xargs clang-format --dry-run -Werror
	$(call configure,release)
	run-clang-tidy -quiet -p build/release -j $(JOBS) '^$(CURDIR)/(src|apps)/'

clean: ## Remove everything that was built or made
	rm -rf build out
