# make run    builds everything and mills the NAS 979 cone on the AC trunnion machine; the report is in out/
# make test   everything that must hold
PRESET ?= release
BUILD := build/$(PRESET)
TRUNNION := $(BUILD)/bin/trunnion
JOBS := $(shell nproc)

.PHONY: run test build packages unit sanitize fuzz lint format bench clean

run: build
	$(TRUNNION) run ac-table nas979_cone --report out

test: build
	ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)

packages:
	@deploy/install-packages.sh

build: packages
	@mkdir -p build
	@cmake --preset $(PRESET) > $(BUILD)-configure.log || { cat $(BUILD)-configure.log; exit 1; }
	@cmake --build --preset $(PRESET) -- --quiet

# The unit tests under the address and undefined-behaviour sanitizers.
sanitize: packages
	@cmake --preset sanitize > /dev/null
	cmake --build --preset sanitize -- --quiet
	ctest --test-dir build/sanitize --output-on-failure -j $(JOBS) -L unit

# A short run of every fuzzer.
fuzz: packages
	@cmake --preset fuzz > /dev/null
	cmake --build --preset fuzz -- --quiet
	ctest --test-dir build/fuzz --output-on-failure -j $(JOBS) -L fuzz

lint: build
	tools/lint.sh $(BUILD)

format:
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-14 -i

bench: build
	for program in $(BUILD)/bin/*_bench; do $$program || exit 1; done

clean:
	rm -rf build out
