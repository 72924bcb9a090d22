/* table.c -- a table of numbers beside a deck, read as a road, a force over time and a curve. */
#include "fuzz/deck.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *deck;
    struct arena *life = arena_open();
    struct scene *scene = NULL;
    if (!deck)
        deck = put_text(
            "deck.yaml",
            "fmdsub: 1\n"
            "bodies: {arm: {mass: 1, inertia: 0.1, at: [1, 0]}, car: {mass: 1, inertia: 1, at: [0, 2]}}\n"
            "constraints: {pin: {revolute: [ground, arm], at: [0, 0]}, way: {prismatic: [ground, car], axis: [0, 1]}}\n"
            "drives: {lift: {drive: way, value: {file: table.csv}}}\n"
            "measures: {far: {distance: [arm, car]}}\n"
            "forces: {push: {torque: pin, value: {file: table.csv}}, drag: {curve: far_rate, file: table.csv}}\n"
            "integrate: {scheme: newmark, step: 1.0e-2, until: 1}\n");
    put_bytes("table.csv", data, size);
    (void)(deck_read(&scene, deck, life) == OK);
    arena_close(life);
    return 0;
}
