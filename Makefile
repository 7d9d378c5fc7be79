# The commands of the README. Each does its own set-up; see setup/packages for what is installed.
.PHONY: demo build test bench fuzz format lint install picture setup-run setup-test release asan fuzzers clean

FUZZ_SECONDS ?= 600
PREFIX ?= /usr/local
corpuscle = build/release/corpuscle

demo: build
	@$(corpuscle) respond press --afferent sa1 --afferent fa1 --out out/press --report
	@echo "Spikes: out/press/spikes.csv   Page to look at: out/press/report.html"

build: setup-run
	@cmake --preset release > /dev/null
	@cmake --build --preset release --target corpuscle-cli

test: release asan
	ctest --test-dir build/release --output-on-failure -j 2
	ctest --test-dir build/asan --output-on-failure -j 2 -LE once
	$(MAKE) fuzz FUZZ_SECONDS=5

release: setup-test
	cmake --preset release -D CORPUSCLE_TESTS=ON
	cmake --build --preset release

asan: setup-test
	cmake --preset asan
	cmake --build --preset asan

fuzzers: setup-test
	cmake --preset fuzz
	cmake --build --preset fuzz --target fuzzers

fuzz: fuzzers
	test/fuzz/run build/fuzz $(FUZZ_SECONDS)

bench: release
	bench/run build/release

format: setup-test
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-19 -i

lint: release
	git ls-files 'src/*.cpp' 'apps/*.cpp' | xargs -P 2 -n 4 clang-tidy-19 -p build/release --quiet --extra-arg=-Wno-unknown-warning-option

install: build
	cmake --install build/release --prefix $(PREFIX)

picture: release
	/usr/bin/python3 doc/picture.py $(corpuscle) doc/press.png

setup-run:
	@setup/install run

setup-test:
	@setup/install run test

clean:
	rm -rf build out
