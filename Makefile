# fmdsub -- simulation of flexible multibody systems by Newmark sub-cycling
#
# `make help` prints targets and variables: the lines that begin with two hashes, under the headings of this file.

# ---- variables -------------------------------------------------------------------------------

## CC            the compiler (gcc)
ifeq ($(origin CC),default)
CC        = gcc
endif
## BUILD         folder of all that is made (build)
BUILD    ?= build
## OPT           optimisation of the programs and benches; tests are compiled with -O1
OPT      ?= -O2 -ftree-vectorize $(if $(findstring clang,$(CC)),,-fvect-cost-model=dynamic)
WARN      = -Wall -Wextra -Wpedantic -Wshadow -Wswitch-enum -Wmissing-prototypes -Wstrict-prototypes
## CFLAGS        flags of the compiler, added last
CFLAGS   ?=
## LDFLAGS       flags of the linker
LDFLAGS  ?=
## PREFIX        where install puts things (/usr/local); DESTDIR goes before it
PREFIX   ?= /usr/local
## SUNDIALS      folder of SUNDIALS, where the compiler does not find it; none: scheme bdf is left out
## U             names of the unit tests to run: make unit U=newton, make unit U="newton newmark"
## D             decks to run, those whose names contain one of the words: make decks D=chain
## V             V=1 shows commands and names every test
## JOBS          parts of the tests that run at a time (one to a processor)
## NO_INSTALL    NO_INSTALL=1: deps only says what is missing
# The same bits everywhere: no contraction to fused multiply-add, never fast-math.
EXACT     = -ffp-contract=off -fno-math-errno
COVERAGE  = $(if $(findstring coverage,$(CFLAGS)),-DCOVERAGE)
ALL_CFLAGS = -std=c11 -D_GNU_SOURCE -Isrc $(OPT) -g $(WARN) $(EXACT) -MMD -MP $(COVERAGE) $(WITH_CVODE) $(CFLAGS)
LDLIBS    = $(if $(WITH_CVODE),$(CVODE)) -lyaml -lcjson -lm

SOURCES  := $(sort $(filter-out src/reduce/%,$(wildcard src/*/*.c)))
# fmdsub-reduce, where LAPACK and ARPACK are found.
FORTRAN   = -larpack -llapack -lblas
REDUCES  := $(sort $(wildcard src/reduce/*.c))
REDUCED  := $(REDUCES:src/%.c=$(BUILD)/obj/%.o)
REDUCER  := $(BUILD)/fmdsub-reduce
HAVE     := $(shell echo 'int main(void) { return 0; }' | $(CC) -x c - $(FORTRAN) -o /dev/null 2>/dev/null && echo yes)
FOUND    := $(if $(HAVE),$(REDUCER))
# The scheme bdf, where CVODE of SUNDIALS 6 is found.
comma    := ,
CVODE    := $(SUNDIALS:%=-L%/lib) $(SUNDIALS:%=-Wl$(comma)-rpath$(comma)%/lib) -lsundials_cvode
WITH_CVODE := $(if $(filter none,$(SUNDIALS)),,$(shell echo 'int main(void) { int six[SUNDIALS_VERSION_MAJOR == 6 ? 1 : -1]; return CVode(0, 0, 0, 0, sizeof six); }' | \
                $(CC) $(SUNDIALS:%=-isystem %/include) -include cvode/cvode.h -x c - $(CVODE) -o /dev/null 2>/dev/null && echo -DCVODE $(SUNDIALS:%=-isystem %/include)))
OBJECTS  := $(SOURCES:src/%.c=$(BUILD)/obj/%.o)
LIBRARY   = $(BUILD)/libfmdsub.a
PROGRAM   = $(BUILD)/fmdsub
UNITS    := $(patsubst tests/unit/t-%.c,%,$(sort $(wildcard tests/unit/t-*.c)))
ifdef U
near      = $(shell printf '%s\n' $(UNITS) | grep -e '$(1)' -e "^$$(echo '$(1)' | cut -c 1-2)")
UNITS    := $(foreach u,$(patsubst t-%,%,$(subst $(comma), ,$(U))),$(or $(filter $(u),$(UNITS)),$(error no unit test '$(u)'; near it: $(call near,$(u)))))
endif
UNITS    := $(UNITS:%=$(BUILD)/unit/t-%)
REDUNITS := $(if $(HAVE),$(patsubst tests/reduce/t-%.c,$(BUILD)/reduce/t-%,$(sort $(wildcard tests/reduce/t-*.c))))
TOOLS    := $(BUILD)/tools/compare $(BUILD)/tools/cputime $(BUILD)/tools/badwrite.so $(BUILD)/tools/badsine.so $(BUILD)/tools/reach.so \
            $(BUILD)/tools/badalloc.so $(BUILD)/tools/everyalloc $(BUILD)/tools/bytes
RANDOM   := $(BUILD)/random/mechanism $(BUILD)/random/judge
FUZZED   := deck expression table body
FUZZES    = $(FUZZED:%=$(BUILD)/fuzz/%)
BENCHES  := $(patsubst tests/bench/%.c,$(BUILD)/bench/%,$(sort $(wildcard tests/bench/*.c)))
DIST      = fmdsub-$(shell sed -n 's/.define FMDSUB_VERSION "\(.*\)"/\1/p' src/cli/cli.h)
COMPLETIONS = $(addprefix $(DESTDIR)$(PREFIX)/share/,bash-completion/completions/fmdsub zsh/site-functions/_fmdsub fish/vendor_completions.d/fmdsub.fish)
PAGES    := $(sort $(wildcard man/*.[157]))
EXAMPLES := $(sort $(wildcard decks/*.*))
AIRSCREW := $(sort $(wildcard decks/airscrew/*))
FORMATTED = $(sort $(wildcard src/*/*.[ch] tests/unit/*.[ch] tests/reduce/*.c tests/tools/*.c tests/random/*.[ch] tests/fuzz/*.[ch] tests/bench/*.c))
ASAN      = -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
RUN       = BUILD=$(BUILD) UNITS="$(notdir $(UNITS))" D="$(D)" V=$(V) tests/run

# Commands are shown with V=1.
Q         = $(if $(V),,@)
say       = $(if $(V),,@echo "  $(1)  $(@:$(BUILD)/%=%)")

# ---- programs --------------------------------------------------------------------------------

## all           build/fmdsub and, with LAPACK and ARPACK, build/fmdsub-reduce
all: $(PROGRAM) $(FOUND)

$(BUILD)/obj/%.o: src/%.c
	@mkdir -p $(@D)
	$(call say,CC)
	$(Q)$(CC) $(ALL_CFLAGS) -c -o $@ $<

# Compiled anew where CVODE has come or gone.
$(BUILD)/obj/engine/bdf.o $(BUILD)/obj/engine/bdf_cvode.o $(BUILD)/obj/multirate/schemes.o: $(BUILD)/with$(firstword $(WITH_CVODE))
$(BUILD)/with $(BUILD)/with-DCVODE:
	@mkdir -p $(@D)
	@rm -f $(BUILD)/with $(BUILD)/with-DCVODE
	@touch $@

$(LIBRARY): $(filter-out $(BUILD)/obj/cli/main.o,$(OBJECTS))
	@mkdir -p $(@D)
	@rm -f $@
	$(call say,AR)
	$(Q)ar rcD $@ $^

$(PROGRAM): $(BUILD)/obj/cli/main.o $(LIBRARY)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS)

$(BUILD)/libreduce.a: $(filter-out $(BUILD)/obj/reduce/main.o,$(REDUCED))
	@rm -f $@
	$(call say,AR)
	$(Q)ar rcD $@ $^

$(REDUCER): $(BUILD)/obj/reduce/main.o $(BUILD)/libreduce.a $(LIBRARY)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $^ $(FORTRAN) $(LDLIBS)

# Tests need no speed.
$(UNITS:=.o) $(REDUNITS:=.o): OPT = -O1

$(BUILD)/%.o: tests/%.c
	@mkdir -p $(@D)
	$(call say,CC)
	$(Q)$(CC) $(ALL_CFLAGS) -Itests -c -o $@ $<

$(UNITS): %: %.o $(LIBRARY)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $< $(LIBRARY) -lcmocka $(LDLIBS)

$(REDUNITS): %: %.o $(BUILD)/libreduce.a $(LIBRARY)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $< $(BUILD)/libreduce.a $(LIBRARY) -lcmocka $(FORTRAN) $(LDLIBS)

$(BENCHES): %: %.o $(LIBRARY)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $< $(LIBRARY) $(LDLIBS)

# Helpers of the tests stand alone: they share no code with what they judge.
$(BUILD)/tools/%: tests/tools/%.c
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $< -lm

$(BUILD)/random/%: tests/random/%.c tests/random/draw.c tests/random/write.c tests/random/mechanism.h
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(CC) $(filter-out -MMD -MP,$(ALL_CFLAGS)) $(LDFLAGS) -o $@ $(filter %.c,$^) -lm

# What reads files of any bytes, and the library that it reads them with.
$(FUZZES): %: %.o $(BUILD)/fuzz/fuzz.o $(if $(LIBFUZZER),,$(BUILD)/fuzz/replay.o) $(LIBRARY)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) $(LIBFUZZER) -o $@ $^ $(LDLIBS)

# Put between a program and the C library.
$(BUILD)/tools/%.so: tests/tools/%.c
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) -shared -fPIC -o $@ $< -ldl

# ---- tests -----------------------------------------------------------------------------------

## test          installs what is missing, builds, runs every test (the same as check)
# Set-up comes first and alone; the second make sees the headers it brought.
test check: deps-test
	@$(MAKE) --no-print-directory -j$$(nproc) all tests-built
	@$(RUN)

## tests-built   builds every test, runs none
tests-built: $(UNITS) $(REDUNITS) $(TOOLS) $(RANDOM) $(FUZZES) $(BENCHES)

## unit          unit tests; U=newton runs one
unit: $(UNITS)
	@$(RUN) unit

## decks         decks against golden records and reference solutions; D=chain runs some
## bad           wrong decks: what is said of them
## faults        arguments, files, signals, limits
## man-examples  what the manual shows, run
## order         orders of the schemes
## study         what the study finds
## plot          pictures by gnuplot
## diff          two records compared
## sweep         many points, in parts, on as many machines
## animate       moving pictures
## install-test  what is installed, the tarball
install-test: $(PROGRAM) $(FOUND) $(TOOLS)
	@$(RUN) install

## readme        what the README and the demo print, typed
## airscrew      the numbers of decks/airscrew/README
## effects       what effects that are left out change
## hard          cases that break simulators, with the table of hard-table
## long          more of faults, hard and study: minutes
## users         scenes as users bring them, each with numbers checked by hand
## reduce        fmdsub-reduce
decks bad faults man-examples order study plot diff sweep animate readme airscrew effects long users reduce: $(PROGRAM) $(FOUND) $(REDUNITS) $(TOOLS)
	@$(RUN) $(@:man-examples=man)

hard: $(PROGRAM) $(FOUND) $(TOOLS)
	@$(RUN) hard; status=$$?; $(MAKE) --no-print-directory hard-table && exit $$status

## random        mechanisms drawn at random, N of them (30) from SEED (1) on: orders, invariances, restarts
random: $(PROGRAM) $(TOOLS) $(RANDOM)
	@N=$(N) SEED=$(SEED) $(RUN) random

## memory        every allocation of every verb refused, one a run: minutes
memory: $(PROGRAM) $(FOUND) $(TOOLS)
	@MOST=1000000 BUILD=$(BUILD) sh tests/faults/memory.sh | tee $(BUILD)/memory.log
	@awk '/^ok/ { p++ } /^not ok/ { f++ } END { printf "%d passed, %d failed\n", p, f; exit f > 0 }' $(BUILD)/memory.log

## hard-table    hard cases judged by number, as a table, which goes into man/fmdsub-hard.7; fails where one is silent
hard-table: $(PROGRAM) $(TOOLS)
	@D=$(D) BUILD=$(BUILD) sh tests/gallery/run.sh >$(BUILD)/hard.txt; status=$$?; cat $(BUILD)/hard.txt; \
	[ -n "$(D)" ] || sh man/hard.sh $(BUILD)/hard.txt tests/gallery/*.sh >man/fmdsub-hard.7; exit $$status

## kills         runs that are killed at random N (200) times, from SEED (1) on, and go on from their checkpoints: the same bytes
kills: $(PROGRAM) $(TOOLS)
	@KILLS=$(or $(N),200) SEED=$(or $(SEED),1) BUILD=$(BUILD) sh tests/faults/resume.sh | tee $(BUILD)/kills.log
	@awk '/^ok/ { p++ } /^not ok/ { f++ } END { printf "%d passed, %d failed\n", p, f; exit f > 0 }' $(BUILD)/kills.log

## bytes         N (20000) decks with one byte changed, from SEED (1) on: each is checked, no signal, no hang
bytes: $(PROGRAM) $(TOOLS)
	@mkdir -p $(BUILD)/bytes
	@N=$(or $(N),20000) SEED=$(or $(SEED),1) KEEP=$(BUILD)/bytes BUILD=$(BUILD) sh tests/faults/bytes.sh | tee $(BUILD)/bytes.log
	@awk '/^ok/ { p++ } /^not ok/ { f++ } END { printf "%d passed, %d failed\n", p, f; exit f > 0 }' $(BUILD)/bytes.log

## fuzz          clang's libFuzzer on decks, expressions, tables and reduced bodies, FOR (60) seconds each; FUZZED=deck one of them
# A list of nothing may be NULL and a step of 0 from it: no finding.
fuzz: $(PROGRAM)
	@command -v clang >/dev/null || { echo "fuzz: clang and its libFuzzer are missing (Debian: clang libclang-rt-dev)" >&2; exit 2; }
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/clang CC="$(if $(findstring ccache,$(CC)),ccache )clang" OPT=-O1 \
	    CFLAGS="$(ASAN) -fno-sanitize=pointer-overflow -fsanitize=fuzzer-no-link" LIBFUZZER=-fsanitize=fuzzer fuzzers
	@PROGRAM=$(PROGRAM) BUILD=$(BUILD)/clang FOR=$(or $(FOR),60) MERGE=$(MERGE) sh tests/tools/fuzz.sh $(FUZZED)

fuzzers: $(FUZZES)

## replay        the files that fuzzing has kept, by the same harnesses without clang
replay: $(FUZZES)
	@$(RUN) fuzz

## vacuous       tests that pass with an empty program in place of ours
vacuous: tests-built $(PROGRAM) $(FOUND)
	@BUILD=$(BUILD) sh tests/tools/vacuous.sh | tee $(BUILD)/vacuous.log
	@awk '/^ok/ { p++ } /^not ok/ { f++ } END { printf "%d passed, %d failed\n", p, f; exit f > 0 }' $(BUILD)/vacuous.log

## advice        what the advice of check promises beside what is found, on all decks: minutes
advice: $(PROGRAM)
	@BUILD=$(BUILD) sh tests/tools/advice.sh

## trust         the error that run estimates beside the one that is found, on shipped decks
trust: $(PROGRAM) $(BUILD)/random/mechanism
	@BUILD=$(BUILD) sh tests/tools/trust.sh

## tolerance     is a requested tolerance met: errors in tolerances, schemes by decks; minutes
tolerance: $(PROGRAM)
	@BUILD=$(BUILD) LONGEST=$(or $(LONGEST),60) sh tests/tools/tolerance.sh

## modes         `modes: auto` beside all modes, on shipped decks at three tolerances
modes: $(PROGRAM)
	@BUILD=$(BUILD) sh tests/tools/modes.sh

## pick          a run by study --pick beside the best of the grid at that error, seven decks; minutes
pick: $(PROGRAM)
	@BUILD=$(BUILD) sh tests/tools/pick.sh

## watched       shares that run reports of effects turned off, beside what turning them on changes
.PHONY: watched
watched: $(PROGRAM)
	@BUILD=$(BUILD) sh tests/tools/watched.sh

## mutants       N (60) random one-token mutants of src from SEED (1) on: at least 85 percent are noticed by a test
mutants: counted
	@$(MAKE) --no-print-directory -j2 BUILD=$(BUILD)/mutants OPT=-O1 CFLAGS="-fPIC -g0" mutable
	@BUILD=$(BUILD)/mutants COUNTED=$(BUILD)/coverage CC="$(CC)" N=$(or $(N),60) SEED=$(or $(SEED),1) sh tests/tools/mutants.sh

mutable: $(OBJECTS) $(UNITS:=.o) $(if $(HAVE),$(REDUCED) $(REDUNITS:=.o)) $(TOOLS) $(RANDOM)

## pictures      those of the README, drawn anew
pictures: $(PROGRAM)
	@$(PROGRAM) animate -q --until 0.049 -o decks/figures/flexible-crank.svg decks/flexible-crank.yaml
	@$(PROGRAM) study -q --repeats 0 --budget 20 --plot decks/figures/work-precision.svg decks/flexible-crank.yaml >$(BUILD)/pictures.csv

## pages         (also: gallery) build/pages/index.html: every shipped deck with a picture, a sentence and what it costs
pages gallery: $(PROGRAM)
	@BUILD=$(BUILD) sh tests/tools/pages.sh

## figures       figures 3 to 6 and the times of the paper, drawn anew into decks/figures
figures: $(PROGRAM)
	@BUILD=$(BUILD) sh decks/figures/figures.sh

## validation    published figures of ADAMS and Dymola beside ours, a table
validation: $(PROGRAM)
	@BUILD=$(BUILD) sh tests/validation/table.sh

## order-tight   orders down to 1e-8 instead of 1e-6: minutes
order-tight: $(PROGRAM) $(TOOLS)
	@TIGHT=1 $(RUN) order

## asan          unit, decks and bad under the sanitizers
asan:
	@$(MAKE) --no-print-directory -j2 BUILD=$(BUILD)/asan OPT=-O1 CFLAGS="$(CFLAGS) $(ASAN)" all tests-built
	@ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 BUILD=$(BUILD)/asan V=$(V) \
	    UNIT_SECONDS=900 DECK_SECONDS=600 CHECK_SECONDS=300 BAD_SECONDS=60 tests/run unit decks bad fuzz

## coverage      lines and branches of src that make test reaches, by folder: at least 97 and 87 percent
COUNTED   = --coverage -include tests/tools/counted.h
coverage: counted
	@BUILD=$(BUILD)/coverage sh tests/tools/coverage.sh

counted:
	@$(MAKE) --no-print-directory -j2 BUILD=$(BUILD)/coverage OPT=-O0 CFLAGS="$(CFLAGS) $(COUNTED)" all tests-built
	@BUILD=$(BUILD)/coverage sh tests/tools/reached.sh

## golden        what would change in the golden records, column by column; WRITE=1 rewrites them
golden: $(PROGRAM) $(TOOLS)
	@BUILD=$(BUILD) WRITE=$(WRITE) sh tests/tools/golden.sh

## sweeps        two sweeps of subcycle against its Newton to 1e-12, on random mechanisms
sweeps: $(PROGRAM) $(BUILD)/random/mechanism
	@BUILD=$(BUILD) sh tests/bench/sweeps.sh

## auto          what scheme: auto takes, against the cheapest of one rate, on every deck
auto: $(PROGRAM)
	@BUILD=$(BUILD) sh tests/bench/auto.sh
	@BUILD=$(BUILD) sh tests/bench/partition.sh

## bench         CPU times of a step
bench: $(PROGRAM) $(TOOLS) $(BENCHES)
	@BUILD=$(BUILD) sh tests/bench/run.sh

## prices        instructions of the kernels of a step against the table of explain DECK; WRITE=1 writes the table
prices: $(PROGRAM)
	@BUILD=$(BUILD) WRITE=$(WRITE) sh tests/bench/prices.sh

# ---- against another program -----------------------------------------------------------------

## REF           the other program
## REV           or the commit to build it from: make same REV=HEAD~3
ifdef REV
REF      := $(BUILD)/same/$(shell git rev-parse $(REV))/build/fmdsub
$(REF):
	@mkdir -p $(@D)
	@git archive $(REV) | tar -x -C $(@D)/..
	@$(MAKE) --no-print-directory -C $(@D)/.. BUILD=build REV= build/fmdsub
endif

## same          whether both say the same of every deck under every scheme, byte for byte; D=chain of some
same: $(PROGRAM) $(REF)
	@BUILD=$(BUILD) D="$(D)" sh tests/tools/same.sh $(REF)

## counts        instructions of a step of both, by callgrind; fails above LIMIT=1.02
counts: $(PROGRAM) $(REF)
	@BUILD=$(BUILD) LIMIT=$(LIMIT) sh tests/tools/counts.sh $(REF)

# ---- the look of the code --------------------------------------------------------------------

## layers        includes that point the wrong way
layers: $(PROGRAM)
	@sh tests/tools/layers.sh

## eqs           where each equation stands
eqs:
	@sh tests/tools/eqs.sh

## format        clang-format on every source
format:
	clang-format --style=file:.ci/clang-format -i $(FORMATTED)

## format-check  says what format would change
format-check:
	@if command -v clang-format >/dev/null; then \
	    clang-format --style=file:.ci/clang-format --dry-run -Werror $(FORMATTED); \
	else echo "format-check: skipped, clang-format is not installed"; fi

## lint          layers, format-check, cppcheck and clang-tidy
lint: layers format-check
	@CC="$(CC)" sh .ci/lint

## man           the manual pages through mandoc's lint
man:
	@if command -v mandoc >/dev/null; then mandoc -T lint -W warning $(PAGES) && echo "man: $(words $(PAGES)) pages clean"; \
	else echo "man: skipped, mandoc is not installed"; fi

# ---- set-up ----------------------------------------------------------------------------------

## deps          installs what the build needs; deps-test: and the tests
deps:
	@NO_INSTALL=$(NO_INSTALL) CC="$(CC)" sh .ci/deps run

deps-test:
	@NO_INSTALL=$(NO_INSTALL) CC="$(CC)" sh .ci/deps run test

## demo          installs what is missing, builds, shows the bar-slider at 1:1, 5:1 and 10:1
demo:
	@BARE=1 NO_INSTALL=$(NO_INSTALL) CC="$(CC)" sh .ci/deps run
	@$(MAKE) --no-print-directory -j$$(nproc) $(PROGRAM) $(BUILD)/tools/compare
	@BUILD=$(BUILD) sh tests/tools/demo.sh

tools: $(TOOLS)

## dist          the sources as build/fmdsub-VERSION.tar.gz, which builds without git
dist:
	@mkdir -p $(BUILD)
	@git archive --prefix=$(DIST)/ HEAD | gzip -9n >$(BUILD)/$(DIST).tar.gz
	@echo "$(BUILD)/$(DIST).tar.gz"

## deb           a Debian package of all that is installed: build/fmdsub_VERSION_ARCH.deb; MAINTAINER="Name <address>" answers for it
deb:
	@BUILD=$(BUILD) CC="$(CC)" MAINTAINER="$(MAINTAINER)" .ci/deb

## deb-check     that package twice, the second from the tarball in another folder: the same bytes; lintian, where it is installed
deb-check: deb dist
	@BUILD=$(BUILD) CC="$(CC)" MAINTAINER="$(MAINTAINER)" sh tests/tools/deb.sh

## cluster       a sweep by GNU parallel and by a real Slurm of one node: the same bytes as here
cluster: $(PROGRAM)
	@BUILD=$(BUILD) sh tests/tools/cluster.sh

## film          animations read back by VTK and, with GLTF=FOLDER of an npm install gltf-validator, by the validator of glTF
film: $(PROGRAM)
	@BUILD=$(BUILD) GLTF=$(GLTF) sh tests/tools/film.sh

## install       programs, manual, schema, completion of shells and decks to PREFIX; uninstall takes them away
install: $(PROGRAM) $(FOUND)
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/doc/fmdsub/decks/airscrew
	install -m 755 $(PROGRAM) $(FOUND) $(DESTDIR)$(PREFIX)/bin
	install -m 644 $(EXAMPLES) $(DESTDIR)$(PREFIX)/share/doc/fmdsub/decks
	install -m 644 $(AIRSCREW) $(DESTDIR)$(PREFIX)/share/doc/fmdsub/decks/airscrew
	install -m 644 README.md LICENSE man/CHANGELOG $(DESTDIR)$(PREFIX)/share/doc/fmdsub
	install -d $(DESTDIR)$(PREFIX)/share/fmdsub $(dir $(COMPLETIONS))
	$(PROGRAM) schema >$(DESTDIR)$(PREFIX)/share/fmdsub/deck.schema.json
	$(PROGRAM) list completion bash >$(word 1,$(COMPLETIONS))
	$(PROGRAM) list completion zsh >$(word 2,$(COMPLETIONS))
	$(PROGRAM) list completion fish >$(word 3,$(COMPLETIONS))
	for page in $(PAGES); do s=$${page##*.}; d=$(DESTDIR)$(PREFIX)/share/man/man$$s; \
	    install -d $$d && install -m 644 $$page $$d || exit 1; done

uninstall:
	rm -f $(DESTDIR)$(PREFIX)/bin/fmdsub $(DESTDIR)$(PREFIX)/bin/fmdsub-reduce
	rm -rf $(DESTDIR)$(PREFIX)/share/doc/fmdsub $(DESTDIR)$(PREFIX)/share/fmdsub
	rm -f $(COMPLETIONS)
	for page in $(PAGES); do rm -f $(DESTDIR)$(PREFIX)/share/man/man$${page##*.}/$${page##*/}; done

## clean         removes the build folder
clean:
	rm -rf $(BUILD)

## help          this list
help:
	@awk '/^# -+ .* -+$$/ { gsub(/^# -+ | -+$$/, ""); heading = $$0; next } \
	    /^## / { if (heading != "") print heading ":"; heading = ""; print "  " substr($$0, 4) }' $(firstword $(MAKEFILE_LIST))

-include $(OBJECTS:.o=.d) $(REDUCED:.o=.d) $(UNITS:=.d) $(REDUNITS:=.d) $(addsuffix .d,$(basename $(TOOLS))) $(FUZZES:=.d) $(BENCHES:=.d)
.PHONY: long prices pick sweeps auto film deb deb-check pictures pages gallery readme cluster hard-table kills advice trust tolerance figures coverage counted vacuous mutants mutable fuzz fuzzers replay all test check unit decks bad faults random memory bytes reduce man-examples order study plot diff sweep animate airscrew hard effects order-tight asan golden bench same counts layers eqs format format-check lint man validation users modes \
        help deps deps-test demo tools tests-built dist install-test install uninstall clean
