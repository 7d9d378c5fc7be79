# The commands of the README. Each installs the packages it needs (setup/packages).
.PHONY: demo build page test test-under-load page-and-readers bench fuzz format lint install pictures notebooks reproduction deb setup-run setup-page setup-test setup-tests setup-bench setup-python setup-deb release asan asan-readers sanitize clean

# A job per processor. A third one on two processors makes a build 5 % longer and the tests 10 %.
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(shell nproc)
export CTEST_PARALLEL_LEVEL ?= $(shell nproc)

FUZZ_SECONDS ?= 600
PREFIX ?= /usr/local
corpuscle = build/release/corpuscle
# The two afferents of the thesis, each as equations and as a chip.
touched = press --afferent sa1 --afferent sa1-circuit --afferent fa1 --afferent fa1-circuit

demo:
	@start=$$(date +%s); $(MAKE) --no-print-directory build && built=$$(date +%s) && \
	$(corpuscle) respond $(touched) --out out/press --report && \
	$(corpuscle) respond texture --population hand --quiet --out out/hand --report && done=$$(date +%s) && \
	echo "Built $(corpuscle) in $$((built - start)) s, and ran it twice in $$((done - built)) s. Open these pages in a browser:" && \
	echo "out/press/report.html  a press, and the spikes of two afferents as equations and as chips" && \
	echo "out/hand/report.html   a finger that strokes a hand with a rough surface, and what 17,000 afferents feel"

build: setup-run
	@cmake --preset release > /dev/null
	@cmake --build --preset release --target corpuscle-cli

# The live page: a skin to press in a browser, with the engine as WebAssembly.
page: setup-page
	@$(priority) web/build build
	@echo "Open build/page/press.html in a browser."

# The sanitizers name files and lines if the programs have debug information. `make test` does without it (lines=), because it takes an eighth of
# their build: after a failure, `make asan-readers` builds them again with it.
lines ?= -g1
configure_asan = cmake --preset asan -D CMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 $(lines) -DNDEBUG"

# Under the sanitizers the tests of everything that reads files, messages and links, and all fuzzers; `make sanitize` runs all tests.
# The test of the page server under load takes a minute in which the processors are almost idle: they build the page and the sanitized programs
# meanwhile, at the lowest priority, so that the delays that it measures are not theirs. If it fails, the other tests still run.
test: setup-tests release
	$(MAKE) --jobs=2 priority='nice -n 19' lines= test-under-load page-and-readers; first=$$?; \
	ctest --test-dir build/release --output-on-failure -LE load && \
	ctest --test-dir build/asan --output-on-failure -LE once -R '^reader-tests' && \
	$(MAKE) lines= fuzz FUZZ_SECONDS=2 && exit $$first

test-under-load:
	ctest --test-dir build/release --output-on-failure -L load

# One after the other, because each has a job for every processor.
page-and-readers:
	$(MAKE) page; page=$$?; $(MAKE) asan-readers && exit $$page

sanitize: asan
	ctest --test-dir build/asan --output-on-failure -LE once

asan-readers: setup-test
	$(configure_asan)
	$(priority) cmake --build --preset asan --target reader-tests corpuscle-hdf5 corpuscle-sound fuzzers

release: setup-test setup-python
	cmake --preset release -D CORPUSCLE_TESTS=ON -D CORPUSCLE_PYTHON=ON
	cmake --build --preset release

asan: setup-test
	$(configure_asan)
	cmake --build --preset asan

fuzz: setup-test
	$(configure_asan)
	cmake --build --preset asan --target fuzzers
	test/fuzz/run build/asan $(FUZZ_SECONDS)

bench: setup-bench release
	cmake --build --preset release --target benchmarks
	bench/run build/release

format: setup-test
	git ls-files '*.cpp' '*.hpp' | xargs clang-format-19 -i

lint: setup-test
	cmake -B build/lint -G Ninja -D CORPUSCLE_TESTS=ON -D CORPUSCLE_PCH=OFF -D CORPUSCLE_UNITY=OFF
	git ls-files 'src/*.cpp' 'apps/*.cpp' | xargs -P 2 -n 4 clang-tidy-19 -p build/lint --quiet --extra-arg=-Wno-unknown-warning-option

# Every figure and table of the thesis, computed and published values side by side: a page, and the numbers as text.
reproduction: setup-run
	@cmake --preset release > /dev/null
	@cmake --build --preset release --target corpuscle-cli corpuscle-study
	@mkdir -p out
	$(corpuscle) study all --quiet --report out/reproduction.html --markdown reproduction/reproduction.md
	if [ -d $(CORPUSCLE_DATA)/fbg_eskin_press ] && [ -d $(CORPUSCLE_DATA)/fabric_slide_cpm ]; then CORPUSCLE_DATA=$(CORPUSCLE_DATA) $(corpuscle) study eskin-press texture --quiet --markdown reproduction/recorded.md; \
	else echo "reproduction/recorded.md was not updated: it needs the recordings fbg_eskin_press and fabric_slide_cpm in $(CORPUSCLE_DATA)"; fi

install: build
	@cmake --preset release -D CMAKE_INSTALL_PREFIX=$(PREFIX) > /dev/null  # programs that link the library look for the helper programs there
	@cmake --build --preset release --target corpuscle-cli corpuscle-study corpuscle_shared man-corpuscle-cli man-corpuscle-study
	cmake --install build/release --prefix $(PREFIX)

# Debian packages of this release of Debian, in build/deb.
deb: setup-deb
	@setup/deb

# The pictures of README and doc/. Those of real recordings need the recordings in the directory CORPUSCLE_DATA.
CORPUSCLE_DATA ?= ../shared/data
draw = /usr/bin/python3 doc/picture.py $(corpuscle)
# Those of doc/schematics.md; on Debian 12 they also need: apt-get install xvfb xauth
schematics = sa1 $(addprefix parts/, transducer amplifier bias invb invc ccvs high_pass rectifier_sa rectifier_fa summer oscillator trigger currents)
# The blocks of the chips; those of FA-I that SA-I has, too, are drawn once.
sa1_blocks = bias fsr transducer ccvs hpb hpc rectb rectc summer cco
fa1_blocks = rect cco
draw_blocks = for block in $(2); do $(corpuscle) export $(1)-circuit --for svg --block $$block --overwrite -o doc/pictures/schematics/drawn-$(1)-$$block.svg || exit 1; done
pictures: release page
	$(draw) doc/press.png $(touched)
	/usr/bin/python3 doc/picture.py build/page/press.html doc/pictures/live-page.png
	$(draw) doc/pictures/range.png study range "supply by temperature"
	$(draw) doc/pictures/touch.png examples/data/touch.csv
	$(draw) doc/pictures/touch-chips.png examples/data/touch.csv --afferent sa1,sa1-circuit,fa1,fa1-circuit
	$(draw) doc/pictures/hand.png texture --population hand
	$(draw) doc/pictures/grip.png $(CORPUSCLE_DATA)/grip_force_ati/grip_02_raw.csv --channel Fz --rate 242.64Hz --scale 0.002 --range 1..3500 --despike 1000 --notch 50Hz
	$(draw) doc/pictures/insole.png $(CORPUSCLE_DATA)/gait_insole_vgrf/GaCo01_01.txt --layout examples/layouts/insole.csv --scale 0.008
	$(draw) doc/pictures/eskin.png $(CORPUSCLE_DATA)/fbg_eskin_press/fbg_press_S6_T16.csv --rate 100Hz --scale 40 --layout $(CORPUSCLE_DATA)/fbg_eskin_press/sensor_positions.csv
	$(draw) doc/pictures/fabric.png $(CORPUSCLE_DATA)/fabric_slide_cpm/Board10mm_F150_V-5mmps_0.csv --time-unit ms --channel 3-18 --scale 0.01
	for cell in $(schematics); do /usr/bin/python3 doc/schematic_picture.py circuits/schematics/$$cell.sch doc/pictures/schematics/$$(basename $$cell).svg || exit 1; done
	for chip in sa1 fa1; do $(corpuscle) export $$chip-circuit --for svg --overwrite -o doc/pictures/schematics/drawn-$$chip.svg || exit 1; done
	$(call draw_blocks,sa1,$(sa1_blocks))
	$(call draw_blocks,fa1,$(fa1_blocks))

# The notebooks with their pictures, in out/notebooks. `make test` runs two of them.
notebooks: release
	CORPUSCLE_NOTEBOOKS=all CORPUSCLE_NOTEBOOKS_OUT=$(CURDIR)/out/notebooks ctest --test-dir build/release --output-on-failure -R Python.example_notebooks
	@echo "Open the pages in out/notebooks, or the notebooks themselves in Jupyter."

setup-run:
	@setup/install run

setup-page:
	@setup/install run page

setup-test:
	@setup/install run test

# All that `make test` needs: apt-get reads its lists and ends an installation once instead of three times.
setup-tests:
	@setup/install run test page python

setup-bench:
	@setup/install run test bench

setup-python:
	@setup/install run python

setup-deb:
	@setup/install run deb

clean:
	rm -rf build out
