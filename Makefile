# fmdsub -- simulation of flexible multibody systems by Newmark sub-cycling
#
#   make              the programs, build/fmdsub and, with LAPACK and ARPACK, build/fmdsub-reduce
#   make demo         installs what is missing, builds, shows the bar-slider at 1:1, 5:1 and 10:1
#   make test         installs what is missing, builds, runs every test (the same as make check)
#
# Variables: CC, OPT (optimisation), CFLAGS (added last), BUILD (folder), PREFIX, DESTDIR,
# NO_INSTALL=1 (deps only says what is missing), V=1 (test runner names every test).
ifeq ($(origin CC),default)
CC        = gcc
endif
BUILD    ?= build
OPT      ?= -O2 -ftree-vectorize $(if $(findstring clang,$(CC)),,-fvect-cost-model=dynamic)
WARN      = -Wall -Wextra -Wpedantic -Wshadow
CFLAGS   ?=
LDFLAGS  ?=
PREFIX   ?= /usr/local
# The same bits everywhere: no contraction to fused multiply-add, never fast-math.
EXACT     = -ffp-contract=off -fno-math-errno
ALL_CFLAGS = -std=c11 -D_GNU_SOURCE -Isrc $(OPT) -g $(WARN) $(EXACT) -MMD -MP $(CFLAGS)
LDLIBS    = -lyaml -lcjson -lm

SOURCES  := $(sort $(filter-out src/reduce/%,$(wildcard src/*/*.c)))
# fmdsub-reduce, where LAPACK and ARPACK are found.
FORTRAN   = -larpack -llapack -lblas
REDUCES  := $(sort $(wildcard src/reduce/*.c))
REDUCED  := $(REDUCES:src/%.c=$(BUILD)/obj/%.o)
REDUCER  := $(BUILD)/fmdsub-reduce
HAVE     := $(shell echo 'int main(void) { return 0; }' | $(CC) -x c - $(FORTRAN) -o /dev/null 2>/dev/null && echo yes)
FOUND    := $(if $(HAVE),$(REDUCER))
OBJECTS  := $(SOURCES:src/%.c=$(BUILD)/obj/%.o)
LIBRARY   = $(BUILD)/libfmdsub.a
PROGRAM   = $(BUILD)/fmdsub
UNITS    := $(patsubst tests/unit/t-%.c,$(BUILD)/unit/t-%,$(sort $(wildcard tests/unit/t-*.c)))
REDUNITS := $(if $(HAVE),$(patsubst tests/reduce/t-%.c,$(BUILD)/reduce/t-%,$(sort $(wildcard tests/reduce/t-*.c))))
TOOLS    := $(BUILD)/tools/compare $(BUILD)/tools/cputime $(BUILD)/tools/badwrite.so
BENCHES  := $(patsubst tests/bench/%.c,$(BUILD)/bench/%,$(sort $(wildcard tests/bench/*.c)))
PAGES    := $(sort $(wildcard man/*.[157]))
EXAMPLES := $(sort $(wildcard decks/*.*))
AIRSCREW := $(sort $(wildcard decks/airscrew/*))
FORMATTED = $(sort $(wildcard src/*/*.[ch] tests/unit/*.[ch] tests/reduce/*.c tests/tools/*.c tests/bench/*.c))
ASAN      = -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
RUN       = BUILD=$(BUILD) V=$(V) tests/run

# Commands are shown with V=1.
Q         = $(if $(V),,@)
say       = $(if $(V),,@echo "  $(1)  $(@:$(BUILD)/%=%)")

all: $(PROGRAM) $(FOUND)

$(BUILD)/obj/%.o: src/%.c
	@mkdir -p $(@D)
	$(call say,CC)
	$(Q)$(CC) $(ALL_CFLAGS) -c -o $@ $<

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

$(BUILD)/reduce/%: tests/reduce/%.c $(BUILD)/libreduce.a $(LIBRARY)
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) -Itests $(LDFLAGS) -o $@ $< $(BUILD)/libreduce.a $(LIBRARY) -lcmocka $(FORTRAN) $(LDLIBS)

$(BUILD)/unit/%: tests/unit/%.c $(LIBRARY)
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) -Itests $(LDFLAGS) -o $@ $< $(LIBRARY) -lcmocka $(LDLIBS)

# Helpers of the tests stand alone: they share no code with what they judge.
$(BUILD)/tools/%: tests/tools/%.c
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $< -lm

# Put between a program and the C library.
$(BUILD)/tools/%.so: tests/tools/%.c
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) -shared -fPIC -o $@ $< -ldl

$(BUILD)/bench/%: tests/bench/%.c $(LIBRARY)
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(CC) $(ALL_CFLAGS) $(LDFLAGS) -o $@ $< $(LIBRARY) $(LDLIBS)

# ---- tests -----------------------------------------------------------------------------------

# Set-up comes first and alone; the second make sees the headers it brought.
test check: deps-test
	@$(MAKE) --no-print-directory -j2 all tests-built
	@$(RUN) unit decks bad faults man order study airscrew hard reduce

tests-built: $(UNITS) $(REDUNITS) $(TOOLS) $(BENCHES)

unit: $(UNITS)
	@$(RUN) unit

decks bad faults man-examples order study airscrew hard reduce: $(PROGRAM) $(FOUND) $(REDUNITS) $(TOOLS)
	@$(RUN) $(@:man-examples=man)

asan:
	@$(MAKE) --no-print-directory -j2 BUILD=$(BUILD)/asan OPT=-O1 CFLAGS="$(CFLAGS) $(ASAN)" all tests-built
	@ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 BUILD=$(BUILD)/asan V=$(V) tests/run unit decks bad

# Golden records: shows what would change, column by column; WRITE=1 then rewrites them.
golden: $(PROGRAM) $(TOOLS)
	@BUILD=$(BUILD) WRITE=$(WRITE) sh tests/tools/golden.sh

bench: $(PROGRAM) $(TOOLS) $(BENCHES)
	@BUILD=$(BUILD) sh tests/bench/run.sh

# ---- the look of the code --------------------------------------------------------------------

layers:
	@sh tests/tools/layers.sh

eqs:
	@sh tests/tools/eqs.sh

format:
	clang-format --style=file:.ci/clang-format -i $(FORMATTED)

format-check:
	@if command -v clang-format >/dev/null; then \
	    clang-format --style=file:.ci/clang-format --dry-run -Werror $(FORMATTED); \
	else echo "format-check: skipped, clang-format is not installed"; fi

lint: layers format-check
	@CC="$(CC)" sh .ci/lint

man:
	@if command -v mandoc >/dev/null; then mandoc -T lint -W warning $(PAGES) && echo "man: $(words $(PAGES)) pages clean"; \
	else echo "man: skipped, mandoc is not installed"; fi

# ---- set-up ----------------------------------------------------------------------------------

deps:
	@NO_INSTALL=$(NO_INSTALL) CC="$(CC)" sh .ci/deps run

deps-test:
	@NO_INSTALL=$(NO_INSTALL) CC="$(CC)" sh .ci/deps run test

# Orders down to 1e-8 instead of 1e-6: minutes.
order-tight: $(PROGRAM) $(TOOLS)
	@TIGHT=1 $(RUN) order

demo: deps
	@$(MAKE) --no-print-directory -j2 all tools
	@BUILD=$(BUILD) sh tests/tools/demo.sh

tools: $(TOOLS)

install: $(PROGRAM) $(FOUND)
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/doc/fmdsub/decks/airscrew
	install -m 755 $(PROGRAM) $(FOUND) $(DESTDIR)$(PREFIX)/bin
	install -m 644 $(EXAMPLES) $(DESTDIR)$(PREFIX)/share/doc/fmdsub/decks
	install -m 644 $(AIRSCREW) $(DESTDIR)$(PREFIX)/share/doc/fmdsub/decks/airscrew
	install -m 644 README.md LICENSE $(DESTDIR)$(PREFIX)/share/doc/fmdsub
	for page in $(PAGES); do s=$${page##*.}; d=$(DESTDIR)$(PREFIX)/share/man/man$$s; \
	    install -d $$d && install -m 644 $$page $$d || exit 1; done

uninstall:
	rm -f $(DESTDIR)$(PREFIX)/bin/fmdsub $(DESTDIR)$(PREFIX)/bin/fmdsub-reduce
	rm -rf $(DESTDIR)$(PREFIX)/share/doc/fmdsub
	for page in $(PAGES); do rm -f $(DESTDIR)$(PREFIX)/share/man/man$${page##*.}/$${page##*/}; done

clean:
	rm -rf $(BUILD)

-include $(OBJECTS:.o=.d) $(REDUCED:.o=.d) $(UNITS:=.d) $(REDUNITS:=.d) $(addsuffix .d,$(basename $(TOOLS))) $(BENCHES:=.d)
.PHONY: all test check unit decks bad faults reduce man-examples order study airscrew hard order-tight asan golden bench layers eqs format format-check lint man \
        deps deps-test demo tools tests-built install uninstall clean
