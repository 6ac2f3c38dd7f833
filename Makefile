# make run    builds everything and mills the NAS 979 cone on the AC trunnion machine; the report is in out/
# make test   everything that must hold
PRESET ?= release
BUILD := build/$(PRESET)
TRUNNION := $(BUILD)/bin/trunnion
JOBS := $(shell nproc)

.PHONY: run test build configure packages unit sanitize fuzz lint format bench faults soak clean

run: build
	$(TRUNNION) run ac-table nas979_cone --report out

test: build
	ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)

# `make run` alone needs no package that only tests use.
packages:
	@deploy/install-packages.sh $(if $(filter-out run build,$(or $(MAKECMDGOALS),run)),test,run)

configure: packages
	@mkdir -p build
	@cmake --preset $(PRESET) > $(BUILD)-configure.log || { cat $(BUILD)-configure.log; exit 1; }

build: configure
	@cmake --build --preset $(PRESET) -- --quiet

# The unit tests under the address and undefined-behaviour sanitizers.
sanitize: packages
	@mkdir -p build
	@cmake --preset sanitize > build/sanitize-configure.log || { cat build/sanitize-configure.log; exit 1; }
	cmake --build --preset sanitize -- --quiet
	ctest --test-dir build/sanitize --output-on-failure -j $(JOBS) -L unit

# A short run of every fuzzer.
fuzz: packages
	@mkdir -p build
	@cmake --preset fuzz > build/fuzz-configure.log || { cat build/fuzz-configure.log; exit 1; }
	cmake --build --preset fuzz -- --quiet
	ctest --test-dir build/fuzz --output-on-failure -j $(JOBS) -L fuzz

# Needs the generated headers, not the programs.
lint: configure
	@cmake --build --preset $(PRESET) --target contracts_generated -- --quiet
	tools/lint.sh $(BUILD)

format:
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 -i

bench: build
	for program in $(BUILD)/bin/*_bench; do $$program $(BENCH_OPTIONS) || exit 1; done

# Every cell of the fault matrix, half an hour; goes on where an interrupted run was. FRESH=1 begins anew.
faults: build
	tools/fault_matrix.py --program $(BUILD)/bin/fault_matrix_test --results $(BUILD)/faults $(if $(FRESH),--fresh)

# Programs with a random fault every few seconds. SEED=, MINUTES=
SEED ?= 1
MINUTES ?= 10
soak: build
	TRUNNION_SOAK_SEED=$(SEED) TRUNNION_SOAK_SECONDS=$$(( $(MINUTES) * 60 )) $(BUILD)/bin/fault_soak_test

clean:
	rm -rf build out
