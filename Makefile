# SPDX-License-Identifier: Apache-2.0
# make run    builds everything and mills the NAS 979 cone on the AC trunnion machine; the report is in out/
# make check  while one works: build, format, lint and unit tests of what changed
# make test   everything that must hold
# make nightly  what takes longer: whole lint, sanitizers, fuzzers, faults, recordings, soak (tools/nightly.sh)
PRESET ?= release
BUILD := build/$(PRESET)
TRUNNION := $(BUILD)/bin/trunnion
JOBS := $(shell nproc)
# Tests that start a cluster wait for more than a third of their time.
TESTS_AT_ONCE := $(shell expr $$(nproc) + 1)
FUZZ_SECONDS ?= 6

# Ninja shows how many of how many steps are done, and for how long it has been at it.
export NINJA_STATUS := [%f/%t, %es]$(subst ,, )

.PHONY: run check test build product configure packages sanitize threads fuzz lint format generate bench faults soak hostile hostile_bus recordings histories rests \
  oscat corpus linuxcnc-tests nightly coverage package clean

run: product
	$(TRUNNION) run ac-table nas979_cone --report out

# Tests in real time come last, one at a time.
test: build
	ctest --test-dir $(BUILD) --output-on-failure -j $(TESTS_AT_ONCE) -LE realtime
	ctest --test-dir $(BUILD) --output-on-failure -L realtime

# What is remembered as good with the same content (tools/memory.py) is not done again.
check: configure
	@cmake --build --preset check
	tools/lint.py $(BUILD)
	tools/run_tests.py $(BUILD) unit -L unit

# `make run` alone needs no package that only tests use.
packages:
	@deploy/install-packages.sh test

configure: packages
	@$(call cmake_configure,$(PRESET))

build: configure
	@cmake --build --preset $(PRESET)

# The programs and the page only: what `make run` needs, without the large packages of the tests.
product:
	@deploy/install-packages.sh run
	@$(call cmake_configure,$(PRESET))
	@cmake --build --preset product

# $(call cmake_configure,PRESET)
cmake_configure = mkdir -p build; echo "Configuring build/$(1)"; \
  cmake --preset $(1) -DTRUNNION_FUZZ_SECONDS=$(FUZZ_SECONDS) > build/$(1)-configure.log || { cat build/$(1)-configure.log; exit 1; }

# The unit tests under the address and undefined-behaviour sanitizers. PART=foreign: those of what reads bytes that others have
# written - programs, configuration, files of the state directory, recordings, the network.
foreign := access bus commands gateway_core http_client language machine machine_state measurement parameter_store \
  plc plc_language plc_modbus plc_online program_store programs recorder recording service snapshot storage text truth \
  verification volumetric_compensation
sanitize: packages
	@$(call cmake_configure,sanitize)
	cmake --build --preset sanitize $(if $(PART),--target $(addsuffix _test,$($(PART))))
	tools/run_tests.py build/sanitize sanitize -L unit $(if $(PART),-R '^($(subst $() ,|,$(strip $($(PART)))))_test$$')

# The tests of bus, service shell, stream and Modbus under the thread sanitizer. The DDS libraries are not instrumented, so
# what they do among themselves cannot be judged.
threads: packages
	@$(call cmake_configure,threads)
	cmake --build --preset threads
	TSAN_OPTIONS=ignore_noninstrumented_modules=1 tools/run_tests.py build/threads threads -R '^(bus|service|stream|plc_modbus)_test$$'

# A run of FUZZ_SECONDS of every fuzzer, in the same build directory: the libraries are compiled once for both.
fuzz: packages
	@$(call cmake_configure,sanitize)
	cmake --build --preset fuzz
	tools/run_tests.py build/sanitize fuzz -L fuzz

# Needs the generated headers, not the programs. WITHIN=seconds: no file is begun after that time.
lint: configure
	@cmake --build --preset $(PRESET) --target contracts_generated constants_generated
	tools/lint.py $(BUILD) $(if $(WITHIN),--within $(WITHIN))

format:
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 -i

# All that is generated and committed.
generate: configure
	@cmake --build --preset $(PRESET) --target contracts_generated operator_commands_generated
	cp $(BUILD)/generated/contracts/topics.md $(BUILD)/generated/commands/operator-commands.md docs/
	tools/generate_docs.py
	tools/generate_api.py

bench: build
	for program in $(BUILD)/bin/*_bench; do $$program $(BENCH_OPTIONS) || exit 1; done

# Every cell of the fault matrix, half an hour; goes on where an interrupted run was. FRESH=1 begins anew. Then every fault of
# a measurement of the kinematics, ten minutes.
faults: build
	tools/fault_matrix.py --program $(BUILD)/bin/fault_matrix_test --results $(BUILD)/faults $(if $(FRESH),--fresh)
	$(BUILD)/bin/measurement_faults_test --gtest_filter='*MeasurementFaults*' --gtest_also_run_disabled_tests

# Programs with a random fault every few seconds. SEED=, MINUTES=
SEED ?= 1
MINUTES ?= 10
soak: build
	TRUNNION_SOAK_SEED=$(SEED) TRUNNION_SOAK_SECONDS=$$(( $(MINUTES) * 60 )) $(BUILD)/bin/fault_soak_test

# A foreign process writes every topic of a running cluster for a minute. SEED=
hostile_bus: build
	TRUNNION_HOSTILE_SEED=$(SEED) TRUNNION_HOSTILE_SECONDS=60 $(BUILD)/bin/hostile_bus_test

# Attacks over HTTP, WebSocket, MTConnect and Modbus on a cluster of its own, SECONDS each, in real time and over 127.0.0.1 only.
# ATTACK=name: that one.
SECONDS ?= 5
hostile: product
	integration_tests/hostile.py --trunnion $(TRUNNION) --seconds $(SECONDS) $(addprefix --attack ,$(ATTACK))

# Recordings of every machine in every state of use, on other vendors and in real time, verified. Half an hour.
recordings: build
	TRUNNION_ALL_RECORDINGS=1 $(BUILD)/bin/recordings_test

# Recordings from random moments of random histories, verified; four a minute. SEED=, HISTORIES=
HISTORIES ?= 200
histories: build
	TRUNNION_SEED=$(SEED) TRUNNION_HISTORIES=$(HISTORIES) $(BUILD)/bin/history_test

# Every service swapped and killed at every kind of rest, also long ones.
rests: build
	TRUNNION_ALL_RESTS=1 $(BUILD)/bin/rests_test

# OSCAT=DIR: the exports of OSCAT Basic, which is not a part of this repository. Compiles it and checks results of its functions.
oscat: product
	OSCAT='$(OSCAT)' tools/oscat/check_oscat.py $(TRUNNION)

# CORPUS=DIR: real part programs of others, which are not a part of this repository (docs/corpus.md). Checks them and compares
# the verdicts with those of the table; tools/corpus.py --fetch downloads them.
corpus: product
	CORPUS='$(CORPUS)' tools/corpus.py $(TRUNNION) --jobs $(JOBS)

# LINUXCNC=DIR: the sources of LinuxCNC, which are not a part of this repository. Compares the paths of its own test programs with
# those of its interpreter, and prints the share that agrees.
linuxcnc-tests: product
	LINUXCNC='$(LINUXCNC)' tools/linuxcnc/compare_paths.py $(TRUNNION)

# Continues where an interrupted run of the same commit was.
nightly:
	tools/nightly.sh

# Line coverage of the unit tests, by source: build/coverage.txt.
coverage:
	@deploy/install-packages.sh nightly
	@$(call cmake_configure,coverage)
	cmake --build --preset coverage
	ctest --test-dir build/coverage --output-on-failure -j $(JOBS) -L unit
	gcovr --root . --object-directory build/coverage --filter 'libs/|services/|gateway/|deploy/' --exclude '.*/(test|bench)/.*' \
	  -j $(JOBS) --print-summary --output build/coverage.txt

# Debian packages, in build/release/packages.
package: build
	cd $(BUILD) && cpack --config CPackConfig.cmake

clean:
	rm -rf build out
