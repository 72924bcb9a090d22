# fmdsub -- simulation of flexible multibody systems by Newmark sub-cycling
CC       ?= gcc
BUILD    ?= build
OPT      ?= -O2 -ftree-vectorize -fvect-cost-model=dynamic
WARN      = -Wall -Wextra -Wpedantic -Wshadow
CFLAGS   ?=
ALL_CFLAGS = -std=c11 -D_GNU_SOURCE -Isrc $(OPT) -g $(WARN) -ffp-contract=off -fno-math-errno -MMD -MP $(CFLAGS)
LDLIBS    = -lyaml -lcjson -lm

SOURCES  := $(sort $(wildcard src/*/*.c))
OBJECTS  := $(SOURCES:src/%.c=$(BUILD)/obj/%.o)
LIBRARY   = $(BUILD)/libfmdsub.a
PROGRAM   = $(BUILD)/fmdsub
UNITS    := $(patsubst tests/unit/t-%.c,$(BUILD)/unit/t-%,$(sort $(wildcard tests/unit/t-*.c)))

all: $(PROGRAM)

$(BUILD)/obj/%.o: src/%.c
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -c -o $@ $<

$(LIBRARY): $(filter-out $(BUILD)/obj/cli/main.o,$(OBJECTS))
	@rm -f $@
	ar rcD $@ $^

$(PROGRAM): $(BUILD)/obj/cli/main.o $(LIBRARY)
	$(CC) $(ALL_CFLAGS) -o $@ $^ $(LDLIBS)

$(BUILD)/unit/%: tests/unit/%.c $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(ALL_CFLAGS) -Itests -o $@ $< $(LIBRARY) -lcmocka $(LDLIBS)

unit: $(UNITS)
	@for u in $(UNITS); do echo "== $$u"; $$u || exit 1; done

clean:
	rm -rf $(BUILD)

-include $(OBJECTS:.o=.d) $(UNITS:=.d)
.PHONY: all unit clean
